use affine_runtime::affine_model;

#[affine_model(
    dim = 2,
    kinetic(casimir2 = 0.2, body_inertia = diag(1, 1e-300*1e-12*a + 1)),
    potential = 1e-200*1e-200*q^2 + a*q^4,
)]
struct Model {
    a: f64,
}

fn main() {}
