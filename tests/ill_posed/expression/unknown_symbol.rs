use affine_runtime::affine_model;

#[affine_model(dim = 2, kinetic(casimir2 = mass))]
struct Model {
    mas: f64,
}

fn main() {}
