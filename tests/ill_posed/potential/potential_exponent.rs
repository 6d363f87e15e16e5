use affine_runtime::affine_model;

#[affine_model(dim = 3, kinetic(casimir2 = 1), potential = det^(-2/3)*tr(G))]
struct Model;

fn main() {}
