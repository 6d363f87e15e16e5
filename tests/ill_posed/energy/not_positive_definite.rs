use affine_runtime::affine_model;

#[affine_model(dim = 3, require(positive_definite), kinetic(casimir2 = 2, body_inertia = 1))]
struct Model;

fn main() {}
