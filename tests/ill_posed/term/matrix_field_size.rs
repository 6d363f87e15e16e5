use affine_runtime::prelude::*;

#[affine_model(dim = 3, kinetic(body_tensor = k))]
struct Model {
    k: Matrix<4>,
}

fn main() {}
