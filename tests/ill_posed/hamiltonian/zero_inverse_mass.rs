use affine_runtime::affine_model;

#[affine_model(dim = 3, hamiltonian(casimir2 = 1, body_translation = 1 - 1))]
struct Model;

fn main() {}
