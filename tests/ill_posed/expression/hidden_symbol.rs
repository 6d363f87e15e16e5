use affine_runtime::affine_model;

#[affine_model(dim = 2, kinetic(casimir2 = 1))]
struct Model {
    n: f64,
}

fn main() {}
