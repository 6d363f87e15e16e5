use affine_runtime::affine_model;

#[affine_model(dim = 2, kinetic(body_inertia = diag(1, 4), casimir2 = 2))]
struct Model;

fn main() {}
