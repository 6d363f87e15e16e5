use affine_runtime::affine_model;

#[affine_model(
    dim = 2,
    constraint = isochoric,
    kinetic(dalembert = 1, body_translation = 2),
    emit(balance)
)]
struct Model;

fn main() {}
