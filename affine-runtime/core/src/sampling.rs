//! Samples of placements and motions, the same in every run: what [`force::check`](crate::force::check) and
//! [`potential::check`](crate::potential::check) look at.

use crate::force::Motion;
use crate::frames::{Matrix, Vector};
use crate::potential::Place;
use crate::random::{numbers, rotation};
use crate::scalar::Scalar;

/// `count` placements with `det phi > 0`, stretched and turned by amounts of order 1, and positions and times.
pub fn places<const N: usize>(count: usize) -> impl Iterator<Item = Place<N>> {
    (0..count).map(|k| {
        let mut number = numbers(k);
        let mut stretched = Matrix::<N>::zeros();
        for a in 0..N {
            stretched[(a, a)] = Scalar::exp(0.6 * number());
        }
        let x = Vector::<N>::from_fn(|_, _| 2.0 * number());
        Place { t: number(), x, phi: rotation::<N>(2 * k) * stretched * rotation::<N>(2 * k + 1) }
    })
}

/// The same placements with velocities of order 1.
pub fn motions<const N: usize>(count: usize) -> impl Iterator<Item = Motion<N>> {
    places::<N>(count).enumerate().map(move |(k, Place { t, x, phi })| {
        let mut number = numbers(count + k);
        let x_dot = Vector::<N>::from_fn(|_, _| number());
        let phi_dot = Matrix::<N>::from_fn(|_, _| number());
        Motion { t, x, phi, x_dot, phi_dot }
    })
}
