use affine_runtime::affine_model;

#[affine_model(dim = 2, kinetic(casimir2 = 1), potential = G[1,2]^2 + G[1,3]^2)]
struct Model;

fn main() {}
