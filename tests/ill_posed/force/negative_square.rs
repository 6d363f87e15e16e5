use affine_runtime::affine_model;

#[affine_model(dim = 2, kinetic(casimir2 = 1), dissipation(space_inertia = [[1, 2], [2, 1]]))]
struct Model;

fn main() {}
