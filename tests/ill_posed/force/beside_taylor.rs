use affine_runtime::affine_model;

#[affine_model(dim = 2, kinetic(body_inertia = 1), forces = custom(field, spatial), emit(taylor))]
struct Model {
    field: f64,
}

fn main() {}
