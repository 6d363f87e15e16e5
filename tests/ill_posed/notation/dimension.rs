use affine_runtime::affine_model;

#[affine_model(dim = 4, kinetic(casimir2 = 1))]
struct Model;

fn main() {}
