use affine_runtime::affine_model;

#[affine_model(dim = 2, kinetic(casimir2 = 1), require())]
struct Model;

fn main() {}
