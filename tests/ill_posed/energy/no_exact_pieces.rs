use affine_runtime::affine_model;

#[affine_model(dim = 3, kinetic(casimir2 = 0.2, body_inertia = diag(1, 1.5, 2)), emit(taylor, splitting))]
struct Model;

fn main() {}
