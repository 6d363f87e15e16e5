use affine_runtime::affine_model;

#[affine_model(dim = 2, kinetic(casimir2 = 1), potential = q^2 + if q > 0 { q } else { 0 })]
struct Disc;

fn main() {}
