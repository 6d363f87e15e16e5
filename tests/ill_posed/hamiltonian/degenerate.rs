use affine_runtime::affine_model;

#[affine_model(dim = 3, hamiltonian(casimir2 = 0.2, vorticity_squared = 0.1))]
struct Model;

fn main() {}
