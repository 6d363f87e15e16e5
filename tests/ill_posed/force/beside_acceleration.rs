use affine_runtime::affine_model;

#[affine_model(dim = 2, kinetic(casimir2 = 1, space_translation = 1), forces = custom(field, translation), emit(acceleration))]
struct Model {
    field: f64,
}

fn main() {}
