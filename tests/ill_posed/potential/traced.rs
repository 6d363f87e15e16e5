use affine_runtime::affine_model;

#[affine_model(dim = 3, kinetic(casimir2 = 1), potential = tr(phi^T*phi))]
struct Model;

fn main() {}
