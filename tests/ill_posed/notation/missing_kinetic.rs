use affine_runtime::affine_model;

#[affine_model(dim = 2)]
struct Model;

fn main() {}
