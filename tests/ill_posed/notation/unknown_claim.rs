use affine_runtime::affine_model;

#[affine_model(dim = 2, symmetry(space = afine), kinetic(casimir2 = 1))]
struct Model;

fn main() {}
