use affine_runtime::affine_model;

#[affine_model(dim = 2, kinetic(casimir2 = 1), group = unitary)]
struct Model;

fn main() {}
