use affine_runtime::affine_model;

#[affine_model(dim = 2, kinetic(dalembert = diag(1, 2)), metrics(space = diag(1, 2)))]
struct Model;

fn main() {}
