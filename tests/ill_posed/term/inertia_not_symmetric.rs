use affine_runtime::affine_model;

#[affine_model(dim = 2, kinetic(dalembert = [[1, 0.5], [1/3, 1]]))]
struct Model;

fn main() {}
