use affine_runtime::affine_model;

#[affine_model(dim = 2, kinetic(casimir2 = self.a), potential = 3*(det - 1).powi(2))]
struct Model {
    a: f64,
}

fn main() {}
