use affine_runtime::affine_model;

#[affine_model(dim = 2, kinetic(casimir2 = 1), potential = self_gravity(2))]
struct Model;

fn main() {}
