use affine_runtime::affine_model;

#[affine_model(dim = 3, kinetic(casimir2 = 1), dissipation(body_inertia = 0.1, casimir2 = 0.2))]
struct Model;

fn main() {}
