use affine_runtime::affine_model;

#[affine_model(dim = 2, metrics(space = diag(1, 2)), kinetic(dalembert = 1, body_inertia = 1))]
struct Model;

fn main() {}
