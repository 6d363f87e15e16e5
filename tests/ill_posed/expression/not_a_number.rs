use affine_runtime::affine_model;

#[affine_model(dim = 2, kinetic(casimir2 = 0x10))]
struct Model;

fn main() {}
