use affine_runtime::prelude::*;

#[affine_model(dim = 2, kinetic(casimir2 = j))]
struct Model {
    j: [[f64; 2]; 2],
}

fn main() {}
