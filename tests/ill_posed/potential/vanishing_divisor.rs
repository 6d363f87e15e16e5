use affine_runtime::affine_model;

#[affine_model(dim = 2, kinetic(casimir2 = 1), potential = I1 + q^2/(ln(D) - q))]
struct Model;

fn main() {}
