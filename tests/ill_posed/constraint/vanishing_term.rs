use affine_runtime::affine_model;

#[affine_model(dim = 3, constraint = isochoric, kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1))]
struct Model;

fn main() {}
