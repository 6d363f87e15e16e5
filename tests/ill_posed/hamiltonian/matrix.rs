use affine_runtime::affine_model;

#[affine_model(dim = 2, hamiltonian(casimir2 = diag(1, 2)))]
struct Model;

fn main() {}
