use affine_runtime::affine_model;

#[affine_model(dim = 2, kinetic(body_inertia = 1), dissipation(body_inertia = 1), emit(taylor))]
struct Model;

fn main() {}
