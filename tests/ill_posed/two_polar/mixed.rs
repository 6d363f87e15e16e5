use affine_runtime::affine_model;

#[affine_model(dim = 2, kinetic(body_inertia = 1, space_inertia = 2), emit(two_polar))]
struct Model;

fn main() {}
