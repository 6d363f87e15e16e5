use affine_runtime::affine_model;

#[affine_model(dim = 2, kinetic(casimir2 = 1, body_inertia = 2), emit(ratios))]
struct Model;

fn main() {}
