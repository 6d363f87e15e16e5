use affine_runtime::affine_model;

#[affine_model(dim = 3, kinetic(casimir2 = 1), potential = kapa*q^2)]
struct Model {
    kappa: f64,
}

fn main() {}
