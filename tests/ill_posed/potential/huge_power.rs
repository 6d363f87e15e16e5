use affine_runtime::affine_model;

#[affine_model(dim = 2, kinetic(casimir2 = 1), potential = q^-99999999999999999999)]
struct Model;

fn main() {}
