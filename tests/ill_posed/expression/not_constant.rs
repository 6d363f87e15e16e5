use affine_runtime::affine_model;

#[affine_model(dim = 2, kinetic(casimir2 = 1), dissipation(body_inertia = 0.1*t))]
struct Disc;

fn main() {}
