use affine_runtime::affine_model;

#[affine_model(dim = 2, kinetic(body_tensor = [[a, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]))]
struct Model {
    a: f64,
}

fn main() {}
