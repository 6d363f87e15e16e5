use affine_runtime::affine_model;

#[affine_model(dim = 2, constraint = rigid, kinetic(body_inertia = diag(1, 2)), emit(tangent))]
struct Model;

fn main() {}
