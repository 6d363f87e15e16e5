use affine_runtime::affine_model;

#[affine_model(dim = 2, symmetry(space = affine, body = affine), kinetic(casimir2 = 1, body_translation = 1))]
struct Model;

fn main() {}
