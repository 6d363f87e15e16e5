use affine_runtime::affine_model;

#[affine_model(dim = 2, kinetic(casimir2 = 1), potential = q^2 + ln(tr(Ct) - tr(G)))]
struct Model;

fn main() {}
