use affine_runtime::affine_model;

#[affine_model(dim = 2, kinetic(body_tensor = [[1, 0, 0, 2], [0, 1, 0, 0], [0, 0, 1, 0], [1/3, 0, 0, 1]]))]
struct Model;

fn main() {}
