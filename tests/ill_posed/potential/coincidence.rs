use affine_runtime::affine_model;

#[affine_model(dim = 3, kinetic(casimir2 = 1), potential = q^2 + pairs(sqrt(cosh(d) - 1)))]
struct Model;

fn main() {}
