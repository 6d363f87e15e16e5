use affine_runtime::affine_model;

#[affine_model(dim = 3, constraint = conformal, kinetic(dalembert = diag(1, 2, 3)))]
struct Model;

fn main() {}
