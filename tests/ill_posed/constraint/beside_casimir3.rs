use affine_runtime::affine_model;

#[affine_model(dim = 3, constraint = isochoric, hamiltonian(casimir2 = 1, casimir3 = 2))]
struct Model;

fn main() {}
