use affine_runtime::affine_model;

#[affine_model(dim = 3, kinetic(casimir2 = 1), potential = q^2 - self_gravity(2))]
struct Model;

fn main() {}
