use affine_runtime::affine_model;

#[affine_model(dim = 2, constraint = isochoric, kinetic(dalembert = 1), potential = tr(G)/2, emit(nystrom))]
struct Model;

fn main() {}
