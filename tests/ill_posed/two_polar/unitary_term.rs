use affine_runtime::affine_model;

#[affine_model(dim = 3, kinetic(casimir2 = 0.2, body_inertia = 1), group = unitary)]
struct Model;

fn main() {}
