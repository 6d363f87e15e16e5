use affine_runtime::affine_model;

#[affine_model(dim = 3, hamiltonian(body_translation = 1))]
struct Model;

fn main() {}
