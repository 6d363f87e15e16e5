use affine_runtime::affine_model;

#[affine_model(dim = 2, kinetic(casimir2 = a^65))]
struct Model {
    a: f64,
}

fn main() {}
