//! The models of these tests.

use affine_runtime::analysis::RelativeEquilibrium;
use affine_runtime::model::Model;
use affine_runtime::prelude::*;

/// A planar body with d'Alembert's inertia.
#[affine_model(dim = 2, kinetic(dalembert = i), potential = hyperbolic_dilatation(kappa) + neo_hookean(c1))]
pub(crate) struct Disc {
    pub(crate) i: f64,
    pub(crate) kappa: f64,
    pub(crate) c1: f64,
}

/// A symmetric top: `u phi_33` is the height of its centre of mass.
#[affine_model(dim = 3, constraint = rigid, kinetic(dalembert = diag(j1, j1, j3)), potential = u*phi[3,3])]
pub(crate) struct Top {
    pub(crate) j1: f64,
    pub(crate) j3: f64,
    pub(crate) u: f64,
}

/// A top that nothing turns.
#[affine_model(dim = 3, constraint = rigid, kinetic(dalembert = diag(1, 1.5, 2)))]
pub(crate) struct FreeTop;

/// A soft body of inertia `diag(j)`, of Saint Venant's material.
#[affine_model(dim = 3, kinetic(dalembert = diag(1, 1.5, 2)), potential = saint_venant_kirchhoff(1, 5))]
pub(crate) struct Soft;

/// Left-invariant in space, isotropic in the body, which flies as well.
#[affine_model(
    dim = 3,
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, body_translation = 1),
    potential = hyperbolic_dilatation(10) + neo_hookean(0.5)
)]
pub(crate) struct Missile;

/// A model whose energy is invariant in space and anisotropic in the body.
#[affine_model(dim = 3, kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = diag(1, 1.5, 2)))]
pub(crate) struct Geodesic;

/// The same in the plane.
#[affine_model(dim = 2, kinetic(casimir2 = 0.3, body_inertia = diag(1, 3)))]
pub(crate) struct FlatGeodesic;

/// Geodesics that are invariant in space, and in the body.
#[affine_model(dim = 3, kinetic(casimir2 = a, casimir1_squared = b, body_inertia = i))]
pub(crate) struct Left {
    pub(crate) i: f64,
    pub(crate) a: f64,
    pub(crate) b: f64,
}
#[affine_model(dim = 3, kinetic(casimir2 = a, casimir1_squared = b, space_inertia = i))]
pub(crate) struct RightGeodesic {
    pub(crate) i: f64,
    pub(crate) a: f64,
    pub(crate) b: f64,
}

/// What flies in the plane.
#[affine_model(
    dim = 2,
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, body_translation = 2),
    potential = hyperbolic_dilatation(10) + neo_hookean(0.5)
)]
pub(crate) struct FlatMissile;

/// A disc whose dilatation is a harmonic oscillator.
#[affine_model(dim = 2, kinetic(dalembert = i), potential = kappa/2*q^2 + neo_hookean(kappa/2))]
pub(crate) struct Logarithmic {
    pub(crate) i: f64,
    pub(crate) kappa: f64,
}

/// A top of which all axes differ.
#[affine_model(dim = 3, constraint = rigid, kinetic(dalembert = diag(1, 1.5, 2)), potential = 0.7*phi[3,3])]
pub(crate) struct Hanging;

pub(crate) fn turning<const N: usize>(omega: f64) -> Matrix<N> {
    let mut turn = Matrix::<N>::zeros();
    (turn[(1, 0)], turn[(0, 1)]) = (omega, -omega);
    turn
}

/// `exp(matrix)`, by squaring.
pub(crate) fn exponential<const N: usize>(matrix: Matrix<N>) -> Matrix<N> {
    let (mut sum, mut term) = (Matrix::<N>::identity(), Matrix::<N>::identity());
    for k in 1..12 {
        term = term * matrix / (1024.0 * f64::from(k));
        sum += term;
    }
    (0..10).fold(sum, |power, _| power * power)
}

/// The largest distance of a motion from `exp(t zeta)`, over a time, in orthonormal bases.
pub(crate) fn unrest<const N: usize, M: Model<N>>(
    model: &M,
    turn: &RelativeEquilibrium<N, M::Point<f64>>,
    time: f64,
) -> f64 {
    let run =
        Simulation::new(model, turn.point).until(time).every(time / 8.0).tolerance(1e-13).run().unwrap();
    let (zeta, start) = (&turn.zeta, *model.orthonormal(&turn.point).phi());
    let error = |(t, point): (f64, &M::Point<f64>)| {
        let moved = exponential(zeta.space * t) * start * exponential(zeta.body * t);
        (model.orthonormal(point).phi() - moved).norm()
    };
    run.iter().map(error).fold(0.0, f64::max)
}

/// A soft body of Saint Venant's material, the same in all directions.
#[affine_model(dim = 3, kinetic(dalembert = 1), potential = lam/8*(tr(G) - 3)^2 + mu/4*(tr(G^2) - 2*tr(G) + 3))]
pub(crate) struct Round {
    pub(crate) lam: f64,
    pub(crate) mu: f64,
}

/// Left-invariant in space, isotropic in the body.
#[affine_model(
    dim = 3,
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1),
    potential = hyperbolic_dilatation(10) + neo_hookean(0.5)
)]
pub(crate) struct Vibrating;

/// The same in the plane.
#[affine_model(
    dim = 2,
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1),
    potential = hyperbolic_dilatation(10) + neo_hookean(0.5)
)]
pub(crate) struct Flat;
