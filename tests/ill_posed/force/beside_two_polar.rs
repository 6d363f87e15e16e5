use affine_runtime::affine_model;

#[affine_model(dim = 2, kinetic(casimir2 = 1), potential = custom(field, isotropic), emit(two_polar))]
struct Model {
    field: f64,
}

fn main() {}
