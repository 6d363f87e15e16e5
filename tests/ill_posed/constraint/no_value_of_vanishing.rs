use affine_runtime::affine_model;

#[affine_model(dim = 3, constraint = isochoric, kinetic(body_inertia = 1), potential = phi[3,3] + ln(q1 + q2 + q3))]
struct Model;

fn main() {}
