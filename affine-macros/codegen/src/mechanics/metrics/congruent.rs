//! A kinetic energy in rational bases.

use crate::algebra::ring::Square;
use crate::algebra::{Polynomial, Rational};

/// The energy of a [kinetic energy](crate::mechanics::kinetic::Kinetic) in rational bases in which the metrics are diagonal: what is decided about it is decided
/// there, exactly.
#[derive(Clone, Debug)]
pub struct Congruent {
    /// The energy; its velocities have the symbols of those in orthonormal bases.
    pub energy: Polynomial,
    /// `w_k w_l` for entries `k`, `l` of the velocity, row-major: an entry in orthonormal bases is `w_k` times that here.
    pub weights: Square<Rational>,
    /// `w_k`.
    pub roots: Vec<Rational>,
    /// Are the `w_k w_l` rational where the form does not vanish?
    pub exact: bool,
    /// For each entry the velocity that it is in the user's bases: row-major places and weights.
    pub velocities: Vec<Vec<(usize, Rational)>>,
}
