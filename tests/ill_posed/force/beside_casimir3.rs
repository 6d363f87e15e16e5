use affine_runtime::affine_model;

#[affine_model(dim = 3, hamiltonian(casimir2 = 1, casimir3 = 1), dissipation(body_inertia = 1))]
struct Model;

fn main() {}
