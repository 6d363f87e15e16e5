use affine_runtime::affine_model;

#[affine_model(dim = 2, kinetic(casimir2 = 1), forces = custom(wind))]
struct Model {
    wind: f64,
}

fn main() {}
