use affine_runtime::affine_model;

#[affine_model(dim = 2, metrics(body = diag(1, 2)), kinetic(body_inertia = 1), potential = custom(field, isotropic))]
struct Model {
    field: f64,
}

fn main() {}
