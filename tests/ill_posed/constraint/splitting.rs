use affine_runtime::affine_model;

#[affine_model(dim = 2, constraint = isochoric, kinetic(dalembert = 1), potential = tr(G)/2, emit(splitting))]
struct OfMasses;

#[affine_model(dim = 2, constraint = conformal, kinetic(dalembert = 1), potential = q^2, emit(splitting))]
struct Weighted;

fn main() {}
