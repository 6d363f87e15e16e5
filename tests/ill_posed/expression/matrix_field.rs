use affine_runtime::prelude::*;

#[affine_model(dim = 2, kinetic(dalembert = 2*j))]
struct Model {
    j: Matrix<2>,
}

fn main() {}
