use affine_runtime::affine_model;

#[affine_model(dim = 2, kinetic(body_translation = 1))]
struct Model;

fn main() {}
