use affine_runtime::affine_model;

#[affine_model(dim = 3, kinetic(casimir2 = 0.2, body_inertia = diag(1, 1, 2)), emit(two_polar))]
struct Model;

fn main() {}
