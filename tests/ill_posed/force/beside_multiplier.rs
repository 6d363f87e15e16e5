use affine_runtime::affine_model;

#[affine_model(dim = 3, constraint = isochoric, kinetic(dalembert = 1), forces = custom(field, spatial))]
struct Model {
    field: f64,
}

fn main() {}
