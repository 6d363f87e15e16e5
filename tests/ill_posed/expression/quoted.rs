use affine_runtime::affine_model;

#[affine_model(dim = 2, kinetic(dalembert = 1), potential = "tr(G)")]
struct Model;

fn main() {}
