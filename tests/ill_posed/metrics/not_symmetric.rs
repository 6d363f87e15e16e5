use affine_runtime::affine_model;

#[affine_model(dim = 2, kinetic(casimir2 = 1), metrics(space = [[1, 0.5], [0.25, 1]]))]
struct Model;

fn main() {}
