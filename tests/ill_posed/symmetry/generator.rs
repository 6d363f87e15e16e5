use affine_runtime::affine_model;

#[affine_model(dim = 3, symmetry(space = affine, body = affine), kinetic(casimir2 = 0.2, body_inertia = 1))]
struct Model;

fn main() {}
