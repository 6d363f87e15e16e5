use affine_runtime::affine_model;

#[affine_model(dim = 2, kinetc(casimir2 = 1))]
struct Model;

fn main() {}
