use affine_runtime::affine_model;

#[affine_model(dim = 2; kinetic(dalembert = 1))]
struct Model;

fn main() {}
