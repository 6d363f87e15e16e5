use affine_runtime::affine_model;

#[affine_model(dim = 2, constraint = isochoric, kinetic(body_inertia = 1), dissipation(body_inertia = 1, casimir1_squared = 1))]
struct Model;

fn main() {}
