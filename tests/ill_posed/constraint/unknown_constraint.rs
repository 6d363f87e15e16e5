use affine_runtime::affine_model;

#[affine_model(dim = 3, constraint = isochorc, kinetic(body_inertia = 1))]
struct Model;

fn main() {}
