use affine_runtime::affine_model;

#[affine_model(dim = 2, kinetic(casimir2 = 1, space_translation = 0.1 + 0.2 - 0.3))]
struct Model;

fn main() {}
