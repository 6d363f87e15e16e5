use affine_runtime::affine_model;

#[affine_model(dim = 2, constraint = rigid, kinetic(body_inertia = 1), metrics(space = diag(1, 4)))]
struct Model;

fn main() {}
