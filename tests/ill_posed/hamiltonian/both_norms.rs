use affine_runtime::affine_model;

#[affine_model(dim = 3, hamiltonian(casimir2 = 1, vorticity_squared = 2, spin_squared = 3))]
struct Model;

fn main() {}
