use affine_runtime::affine_model;

#[affine_model(dim = 3, constraint = rigid, kinetic(body_inertia = 1), dissipation(body_inertia = 1))]
struct Model;

fn main() {}
