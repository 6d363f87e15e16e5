use affine_runtime::affine_model;

#[affine_model(
    dim = 2,
    constraint = isochoric,
    kinetic(dalembert = 1),
    potential = tr(G)*cos(t) + pairs(tanh(d)^2),
    emit(taylor)
)]
struct Model;

fn main() {}
