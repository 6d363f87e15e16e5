use affine_runtime::affine_model;

#[affine_model(dim = 2, kinetic(casimir2 = 0.2f64))]
struct Model;

fn main() {}
