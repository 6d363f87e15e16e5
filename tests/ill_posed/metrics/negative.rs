use affine_runtime::affine_model;

#[affine_model(
    dim = 2,
    metrics(space = [[2, 1], [1, 3]]),
    kinetic(space_inertia = 1),
    dissipation(space_inertia = [[1, 2], [2, 3]])
)]
struct Model;

fn main() {}
