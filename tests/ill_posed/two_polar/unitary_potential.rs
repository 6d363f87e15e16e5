use affine_runtime::affine_model;

#[affine_model(dim = 2, kinetic(casimir2 = 0.2), group = unitary, potential = tr(G))]
struct Model;

fn main() {}
