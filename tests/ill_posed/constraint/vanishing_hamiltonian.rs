use affine_runtime::affine_model;

#[affine_model(dim = 3, constraint = isochoric, hamiltonian(casimir2 = 1, casimir1_squared = 2, vorticity_squared = 3))]
struct Model;

fn main() {}
