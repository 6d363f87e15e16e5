use affine_runtime::affine_model;

#[affine_model(dim = 3, constraint = rigid, kinetic(casimir2 = 1, body_inertia = 1))]
struct Model;

fn main() {}
