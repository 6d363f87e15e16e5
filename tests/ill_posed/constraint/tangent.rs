use affine_runtime::affine_model;

#[affine_model(dim = 2, constraint = isochoric, kinetic(dalembert = diag(1, 2)), emit(tangent))]
struct Model;

fn main() {}
