use affine_runtime::prelude::*;

#[affine_model(dim = 2, kinetic(casimir2 = 1), metrics(space = g))]
struct Model {
    g: Matrix<3>,
}

fn main() {}
