use affine_runtime::affine_model;

#[affine_model(dim = 2, kinetic(flat_tensor = [[1, 0, 0, 1], [0, 1, 0, 0], [0, 0, 1, 0], [1, 0, 0, 1]]))]
struct Model;

fn main() {}
