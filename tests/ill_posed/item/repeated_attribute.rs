use affine_runtime::affine_model;

#[affine_model(dim = 2, kinetic(casimir2 = 1))]
#[affine_model(dim = 2, kinetic(casimir2 = 1))]
struct Model;

fn main() {
}
