use affine_runtime::prelude::*;

#[affine_model(dim = 3, symmetry(space = affine, body = metric), kinetic(body_inertia = j, casimir2 = 0.1))]
struct Model {
    j: Matrix<3>,
}

fn main() {}
