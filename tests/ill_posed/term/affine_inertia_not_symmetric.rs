use affine_runtime::affine_model;

#[affine_model(dim = 2, kinetic(body_inertia = [[1, 0.5], [1/3, 1]]))]
struct Model;

fn main() {}
