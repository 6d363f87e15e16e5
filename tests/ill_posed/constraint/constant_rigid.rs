use affine_runtime::affine_model;

#[affine_model(dim = 3, constraint = rigid, kinetic(body_inertia = 1), potential = neo_hookean(0.5) + G[1,2]^2)]
struct Model;

fn main() {}
