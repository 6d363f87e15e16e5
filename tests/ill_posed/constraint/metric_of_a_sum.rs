use affine_runtime::affine_model;

#[affine_model(dim = 2, constraint = isochoric, kinetic(dalembert = 1, body_inertia = diag(1, 2)), emit(metric))]
struct Model;

fn main() {}
