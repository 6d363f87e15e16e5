use affine_runtime::affine_model;

#[affine_model(dim = 2, kinetic(casimir2 = 0.2, body_inertia = std::f64::consts::PI))]
struct Model;

fn main() {}
