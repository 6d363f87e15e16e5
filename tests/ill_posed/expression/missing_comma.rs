use affine_runtime::affine_model;

#[affine_model(dim = 3, kinetic(body_inertia = [[1, 0, 0] [0, 1, 0], [0, 0, 1]]))]
struct Model;

fn main() {}
