use affine_runtime::affine_model;

#[affine_model(dim = 3, constraint = isochoric, kinetic(body_inertia = 1), potential = hyperbolic_dilatation(10))]
struct Model;

fn main() {}
