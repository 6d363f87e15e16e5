use affine_runtime::affine_model;

#[affine_model(dim = 3, kinetic(casimir2 = 1), potential = q1^2 + q2^2 + 2*q3^2)]
struct Model;

fn main() {}
