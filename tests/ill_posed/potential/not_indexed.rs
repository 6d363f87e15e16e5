use affine_runtime::affine_model;

#[affine_model(dim = 3, kinetic(casimir2 = 1), potential = k[1]*q^2)]
struct Model {
    k: f64,
}

fn main() {}
