//! A momentum is given in a frame, and is no velocity.
use affine_runtime::prelude::*;

#[affine_model(dim = 3, kinetic(casimir2 = 0.2, body_inertia = 1))]
struct Body;

fn bare(phi: Matrix<3>, sigma: Matrix<3>) {
    let _ = Body.at_momentum(phi, sigma);
}

fn of_the_plane(phi: Matrix<3>, sigma: Matrix<2>) {
    let _ = Body.at_momentum(phi, Comoving(sigma));
}

fn main() {}
