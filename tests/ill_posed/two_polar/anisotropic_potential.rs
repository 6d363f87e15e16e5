use affine_runtime::affine_model;

#[affine_model(dim = 2, kinetic(casimir2 = 1), potential = G[1,1], emit(two_polar))]
struct Model;

fn main() {}
