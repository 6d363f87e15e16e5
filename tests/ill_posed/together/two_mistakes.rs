use affine_runtime::affine_model;

#[affine_model(dim = 3, kinetic(casimir2 = missing, body_inertia = 1/0))]
struct Model;

fn main() {}
