use affine_runtime::affine_model;

#[affine_model(dim = 2, constraint = isochoric, kinetic(flat_tensor = [[2, 0, 0, 1], [0, 3, 0, 0], [0, 0, 1, 0], [1, 0, 0, 4]]))]
struct Model;

fn main() {}
