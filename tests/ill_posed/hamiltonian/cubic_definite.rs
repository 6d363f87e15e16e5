use affine_runtime::affine_model;

#[affine_model(dim = 3, require(positive_definite), hamiltonian(casimir2 = 1, vorticity_squared = 2, casimir3 = 1))]
struct Model;

fn main() {}
