use affine_runtime::affine_model;

#[affine_model(dim = 2, kinetic(casimir2 = 1, body_translation = 2), emit(two_polar))]
struct Model;

fn main() {}
