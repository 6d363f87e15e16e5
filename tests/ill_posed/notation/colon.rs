use affine_runtime::affine_model;

#[affine_model(dim: 3, kinetic(casimir2 = 1))]
struct Model;

fn main() {}
