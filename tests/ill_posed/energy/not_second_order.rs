use affine_runtime::affine_model;

#[affine_model(dim = 3, kinetic(casimir2 = 0.2, body_inertia = 1), potential = tr(G)/2, emit(nystrom))]
struct Model;

fn main() {}
