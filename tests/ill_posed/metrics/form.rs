use affine_runtime::affine_model;

#[affine_model(dim = 2, kinetic(casimir2 = 1), metrics(space = diag(1, 2)), potential = tr(G) + G[1,2] + tr(G*Ct))]
struct Model;

fn main() {}
