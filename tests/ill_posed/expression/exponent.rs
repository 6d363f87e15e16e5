use affine_runtime::affine_model;

#[affine_model(dim = 2, kinetic(casimir2 = 2^a))]
struct Model {
    a: f64,
}

fn main() {}
