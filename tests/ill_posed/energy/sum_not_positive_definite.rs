use affine_runtime::affine_model;

#[affine_model(dim = 2, kinetic(dalembert = 1, casimir2 = 1), require(positive_definite))]
struct Model;

fn main() {}
