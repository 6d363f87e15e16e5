use affine_runtime::affine_model;

#[affine_model(dim = 3, constraint = isochoric, kinetic(body_inertia = 1), potential = tr(G) + ln(q))]
struct Model;

fn main() {}
