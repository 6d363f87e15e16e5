use affine_runtime::affine_model;

#[affine_model(dim = 3, kinetic(casimir2 = 1), potential = (q1 - q2)^2)]
struct Model;

fn main() {}
