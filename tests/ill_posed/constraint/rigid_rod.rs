use affine_runtime::affine_model;

#[affine_model(dim = 3, constraint = rigid, kinetic(dalembert = diag(0, 0, 1)))]
struct Model;

fn main() {}
