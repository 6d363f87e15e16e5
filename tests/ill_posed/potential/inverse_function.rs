use affine_runtime::affine_model;

#[affine_model(dim = 2, kinetic(casimir2 = 1), potential = atan(det))]
struct Model;

fn main() {}
