use affine_runtime::affine_model;

#[affine_model(dim = 2, group = unitary, kinetic(casimir2 = 1), dissipation(casimir1_squared = 1))]
struct Model;

fn main() {}
