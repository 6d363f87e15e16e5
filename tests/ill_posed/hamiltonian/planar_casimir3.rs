use affine_runtime::affine_model;

#[affine_model(dim = 2, hamiltonian(casimir2 = 1, casimir3 = 1))]
struct Model;

fn main() {}
