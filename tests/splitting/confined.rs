//! Motions on groups: exponentials stay on them, and kicks are projected.

use affine_runtime::decompose::Polar;
use affine_runtime::prelude::*;

use crate::models::{phi3, spin3};
use crate::motions::assert_kept;

/// A heavy top: rotations about its principal axes.
#[affine_model(
    dim = 3,
    constraint = rigid,
    kinetic(dalembert = diag(1, 1.5, 2)),
    potential = 2*phi[3,3] + phi[3,1]/2,
    emit(splitting)
)]
pub(crate) struct Top;

#[affine_model(
    dim = 3,
    constraint = rigid,
    kinetic(body_inertia = j, space_translation = 2),
    potential = phi[3,3]*x[1] + norm(x)^2/2,
    emit(splitting)
)]
pub(crate) struct Tethered {
    pub(crate) j: Matrix<3>,
}

#[affine_model(
    dim = 3,
    constraint = isochoric,
    kinetic(casimir2 = 0.2, body_inertia = 1, body_translation = 2),
    potential = tr(G)/2 + norm(x)^2/2,
    emit(splitting),
)]
pub(crate) struct Incompressible;

/// The vorticity turns along its exponential.
#[affine_model(
    dim = 3,
    constraint = isochoric,
    kinetic(casimir2 = 0.2, body_inertia = 1),
    potential = tr(G)/2 + G[1,1]^2/4,
    emit(splitting)
)]
pub(crate) struct Fibred;

#[affine_model(
    dim = 2,
    constraint = isochoric,
    kinetic(casimir2 = 0.2, body_inertia = diag(1, i)),
    potential = tr(G)/2,
    emit(splitting)
)]
pub(crate) struct Planar {
    pub(crate) i: f64,
}

#[affine_model(
    dim = 3,
    constraint = isochoric,
    kinetic(space_inertia = diag(1, 1.5, 2)),
    potential = tr(G)/2 + Ct[1,2]/4,
    emit(splitting)
)]
pub(crate) struct Spatial3;

#[affine_model(
    dim = 3,
    constraint = conformal,
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = diag(1, 1.5, 2)),
    potential = q^2 + phi[3,3]/2,
    emit(splitting)
)]
pub(crate) struct Conformal;

pub(crate) fn oblique() -> Matrix<3> {
    Matrix::<3>::new(1.5, 0.25, 0.0, 0.25, 2.0, -0.5, 0.0, -0.5, 1.25)
}

/// In the dual of the algebra: traceless, skew, or skew and a multiple of the identity.
pub(crate) fn traceless<const N: usize>(spin: Matrix<N>) -> Matrix<N> {
    spin - Matrix::<N>::identity() * (spin.trace() / N as f64)
}

pub(crate) fn skew() -> Matrix<3> {
    (spin3() - spin3().transpose()) / 2.0
}

pub(crate) fn rotation() -> Matrix<3> {
    Polar::of(&phi3()).unwrap().rotation
}

/// Calls a macro with each model, its dimension and its start.
macro_rules! each_confined {
    ($visit:ident) => {{
        use crate::confined::*;
        let start = Top.at_momentum(rotation(), Comoving(skew())).unwrap();
        $visit!("top", 3, &Top, start);
        let model = Tethered { j: oblique() }.prepare().unwrap();
        let start = model.at_momentum(x3(), rotation(), p3(), Comoving(skew())).unwrap();
        $visit!("tethered", 3, &model, start);
        let start = Incompressible
            .at_momentum(x3(), phi3().isochoric_part(), p3(), Comoving(traceless(spin3())))
            .unwrap();
        $visit!("incompressible", 3, &Incompressible, start);
        let start = Fibred.at_momentum(phi3().isochoric_part(), Comoving(traceless(spin3()))).unwrap();
        $visit!("fibred", 3, &Fibred, start);
        let model = Planar { i: 2.0 }.prepare().unwrap();
        let start = model.at_momentum(phi2().isochoric_part(), Comoving(traceless(spin2()))).unwrap();
        $visit!("planar", 2, &model, start);
        let start = Spatial3.at_momentum(phi3().isochoric_part(), Spatial(traceless(spin3()))).unwrap();
        $visit!("spatial", 3, &Spatial3, start);
        let start = Conformal
            .at_momentum(1.2 * rotation(), Comoving(skew() + 0.3 * Matrix::<3>::identity()))
            .unwrap();
        $visit!("conformal", 3, &Conformal, start);
    }};
}
pub(crate) use each_confined;

#[test]
fn a_hundred_thousand_steps_on_groups() {
    let start = Top.at_momentum(rotation(), Comoving(skew())).unwrap();
    let run = Simulation::new(&Top, start).until(1.0).method(Method::Splitting { order: 4, step: 0.1 });
    let why = run.run().unwrap().why().to_string();
    assert!(why.contains("the flows that move phi are exponentials"), "{why}");
    let end = assert_kept("top", &Top, start, (2, 0.02), 2e-4);
    let off = (end.phi().transpose() * end.phi() - Matrix::<3>::identity()).norm();
    assert!(off < 1e-13, "off SO(3) by {off:e}");
}
