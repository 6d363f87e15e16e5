use affine_runtime::affine_model;

#[affine_model(dim = 2, symmetry(space = metric), kinetic(space_tensor = [[3, -1/2, 1/2, 0], [-1/2, 3, 0, -1/2], [1/2, 0, 3, 1/2], [0, -1/2, 1/2, 3]]))]
struct Model;

fn main() {}
