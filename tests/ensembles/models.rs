//! The models, and starts around those of the benchmark problems.

use affine_oracle::Random;
use affine_runtime::capability::InLanes;
use affine_runtime::force::{Force, Motion, Translation};
use affine_runtime::prelude::*;
use affine_runtime::scalar::Scalar;

/// Problem P1, whose constants turn space and hold momenta.
#[affine_model(
    dim = 3,
    symmetry(space = affine, body = metric),
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, body_translation = 1),
    emit(lanes),
)]
pub(crate) struct DrunkMissile;

/// Problem P2: the dilatation moves in closed form.
#[affine_model(
    dim = 3,
    symmetry(space = affine, body = metric),
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1),
    potential = hyperbolic_dilatation(kappa) + neo_hookean(c1),
    emit(lanes),
)]
#[derive(Clone)]
pub(crate) struct Vibrating {
    pub(crate) kappa: f64,
    pub(crate) c1: f64,
}

/// Problem P3: canonical variables, with `1/D` carried along.
#[affine_model(
    dim = 3,
    kinetic(dalembert = diag(1, 1.5, 2)),
    potential = hyperbolic_dilatation(10) + neo_hookean(0.5),
    emit(taylor, lanes),
)]
pub(crate) struct Elastic;

/// No potential protects it from a collapse, and elementary functions stand in its equations.
#[affine_model(
    dim = 2,
    kinetic(dalembert = 1, space_translation = 1),
    potential = 0.3*tr(G) + sin(x[1])*cosh(x[2]),
    emit(lanes),
)]
pub(crate) struct Unprotected;

/// Blows with a strength of its own, which is no coefficient.
#[derive(Clone)]
pub(crate) struct Wind(pub(crate) f64);

impl Force<2> for Wind {
    type Form = Translation;
    fn force<T: Scalar>(&self, motion: &Motion<2, T>) -> Vector<2, T> {
        Vector::<2, T>::new(T::constant(self.0, 0.0), motion.phi[(0, 0)] * motion.x_dot[1])
    }
}

/// Fields that are numbers, one that is a basis, and one that is asked where the body is.
#[affine_model(
    dim = 2,
    metrics(body = eta),
    kinetic(dalembert = j, space_translation = 1),
    potential = s*(tr(G) - 2)^2 + hyperbolic_dilatation(1),
    forces = custom(wind, translation),
    emit(lanes),
)]
#[derive(Clone)]
pub(crate) struct Blown {
    pub(crate) eta: Matrix<2>,
    pub(crate) j: f64,
    pub(crate) s: f64,
    pub(crate) wind: Wind,
}

/// A free top.
#[affine_model(dim = 3, constraint = rigid, kinetic(dalembert = diag(1, 1, 0.5)), potential = 0.7*phi[3,3], emit(lanes))]
pub(crate) struct Top;

/// A number between two others, each digit at random.
pub(crate) fn between(random: &mut Random, low: f64, high: f64) -> f64 {
    low + (high - low) * (random.bits() >> 11) as f64 / 2_f64.powi(53)
}

pub(crate) fn matrix<const N: usize>(random: &mut Random, size: f64) -> Matrix<N> {
    Matrix::<N>::from_fn(|_, _| size * between(random, -1.0, 1.0))
}

/// Bodies around the benchmark problems.
pub(crate) trait Sampled<const N: usize>: InLanes<N> + Sync {
    fn sample(&self, random: &mut Random) -> Self::Point<f64>;

    fn samples(&self, count: usize, seed: u64) -> Vec<Self::Point<f64>> {
        let mut random = Random::new(seed);
        (0..count).map(|_| self.sample(&mut random)).collect()
    }
}

impl Sampled<3> for DrunkMissile {
    fn sample(&self, random: &mut Random) -> Self::Point<f64> {
        let x = Vector::<3>::zeros();
        let phi = Matrix::<3>::identity() + matrix::<3>(random, 0.2);
        let p = matrix::<3>(random, 0.5).column(0).into_owned();
        self.at_momentum(x, phi, p, Comoving(matrix::<3>(random, 0.4))).unwrap()
    }
}

/// Of problem P2.
pub(crate) fn vibrating() -> PreparedVibrating {
    Vibrating { kappa: 10.0, c1: 0.5 }.prepare().unwrap()
}

impl Sampled<3> for PreparedVibrating {
    fn sample(&self, random: &mut Random) -> Self::Point<f64> {
        let phi = Matrix::<3>::identity() + matrix::<3>(random, 0.2);
        self.at_momentum(phi, Comoving(matrix::<3>(random, 0.4))).unwrap()
    }
}

impl Sampled<3> for Elastic {
    fn sample(&self, random: &mut Random) -> Self::Point<f64> {
        let phi = Matrix::<3>::identity() + matrix::<3>(random, 0.2);
        self.at_momentum(phi, TwoPoint(matrix::<3>(random, 0.4))).unwrap()
    }
}

impl Sampled<2> for Unprotected {
    fn sample(&self, random: &mut Random) -> Self::Point<f64> {
        let phi = Matrix::<2>::identity() + matrix::<2>(random, 0.2);
        let (x, p) = (Vector::<2>::new(0.1, 0.2), matrix::<2>(random, 0.3).column(0).into_owned());
        self.at_momentum(x, phi, p, TwoPoint(matrix::<2>(random, 0.2))).unwrap()
    }
}

/// A force that is in the range of numbers where the energy is not.
#[affine_model(
    dim = 2,
    kinetic(dalembert = 1, space_translation = 1),
    potential = tr(G)/2 + 1e300*x[1],
    emit(lanes),
)]
pub(crate) struct Heavy;
