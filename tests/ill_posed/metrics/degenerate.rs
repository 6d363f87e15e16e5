use affine_runtime::affine_model;

// J^AB = eta^AB: I - A = 0, on the velocities that are skew for eta.
#[affine_model(
    dim = 2,
    metrics(body = [[1, -0.5], [-0.5, 3]]),
    kinetic(casimir2 = 1, body_inertia = [[12/11, 2/11], [2/11, 4/11]])
)]
struct Model;

fn main() {}
