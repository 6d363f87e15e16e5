use affine_runtime::affine_model;

#[affine_model(dim = 2, kinetic(casimir2 = 1), potential = (-8)^(1/3)*det)]
struct Model;

fn main() {}
