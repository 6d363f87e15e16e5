//! The energy of a point, and the sizes that it is held against.

use super::mechanics::Mechanics;
use crate::inner::{larger, norm};
use crate::state::Phase;

/// The energy of a point, with what it is made of.
#[derive(Clone, Copy, Debug)]
pub(super) struct Energy {
    /// `H`.
    pub(super) value: f64,
    /// `(|Pi| |phi_dot| + |p| |x_dot|)/2` in orthonormal bases, which is at least `|T|`.
    bound: f64,
    /// `T = (tr(Pi phi_dot) + p . x_dot)/2` of a quadratic energy.
    kinetic: f64,
}

impl Energy {
    pub(super) fn at<const N: usize, P: Phase<N>>(model: &dyn Mechanics<N, P>, t: f64, point: &P) -> Self {
        let value = model.hamiltonian(t, point);
        let bases = model.bases();
        let velocity = model.velocity(point);
        let velocity = bases.as_ref().map_or(velocity, |bases| bases.velocity(&velocity));
        let point = point.in_orthonormal(bases.as_ref());
        let (pi, p) = (point.pi().0.0, point.p());
        let internal = norm(pi.as_slice()) * norm(velocity.phi_dot.as_slice());
        let translational = norm(p.as_slice()) * norm(velocity.x_dot.as_slice());
        let kinetic = pi.transpose().dot(&velocity.phi_dot) + p.dot(&velocity.x_dot);
        Self { value, bound: 0.5 * (internal + translational), kinetic: 0.5 * kinetic }
    }

    /// Of which nothing else is known, for what takes a size that is at least so large.
    pub(super) fn of_value(value: f64) -> Self {
        Self { value, bound: 0.0, kinetic: 0.0 }
    }

    /// What an error of the energy is measured against: `|H|`, or the bound of `|T|`.
    pub(super) fn scale(&self) -> f64 {
        larger(self.value.abs(), self.bound)
    }

    /// `|T| + |U|`, with a bound of `|T|` that an indefinite kinetic energy has too.
    pub(super) fn size(&self) -> f64 {
        self.bound + (self.value - self.kinetic).abs()
    }
}
