use affine_runtime::affine_model;

#[affine_model(dim = 2, kinetic(casimir2 = 1), metrics(space = diag(1, a)))]
struct Model {
    a: f64,
}

fn main() {}
