use affine_runtime::affine_model;

#[affine_model(dim = 3, kinetic(dalembert = 1), potential = q^2, emit(ratios))]
struct Model;

fn main() {}
