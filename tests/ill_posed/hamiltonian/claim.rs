use affine_runtime::affine_model;

#[affine_model(dim = 3, symmetry(space = affine, body = affine), hamiltonian(casimir2 = 1, vorticity_squared = 2))]
struct Model;

fn main() {}
