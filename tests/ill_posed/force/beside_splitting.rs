use affine_runtime::affine_model;

#[affine_model(dim = 2, kinetic(dalembert = 1), forces = custom(wind, spatial), emit(splitting))]
struct Model {
    wind: Wind,
}

struct Wind;

fn main() {}
