use affine_runtime::affine_model;

#[affine_model(kinetic(casimir2 = 1))]
struct Model;

fn main() {}
