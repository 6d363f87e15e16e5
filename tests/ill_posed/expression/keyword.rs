use affine_runtime::affine_model;

#[affine_model(dim = 2, kinetic(body_inertia = true))]
struct Model;

#[affine_model(dim = 2, kinetic(body_inertia = 1), potential = loop*q)]
struct OfPotential;

fn main() {}
