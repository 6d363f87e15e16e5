//! Closed-form trajectories (Slawianowski et al., section 5; Martin and Neff, arXiv:1409.7849).

use crate::frames::{Matrix, Vector};

/// A trajectory in closed form.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Geodesic<const N: usize> {
    /// Time of the start.
    pub t0: f64,
    /// The motion of the placement.
    pub motion: Motion<N>,
    /// Constant velocity of the centre of mass; zero for a body at rest.
    pub drift: Vector<N>,
}

/// How the placement moves along a closed-form trajectory, `t` counted from the start.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Motion<const N: usize> {
    /// `phi(t) = phi0 exp(t stretch) exp(t whirl)`: spatially affine models; `whirl` is skew, `None` where it
    /// vanishes.
    Body {
        /// `Sigma_hat0/alpha + tr(Sigma_hat0)/beta`.
        stretch: Matrix<N>,
        /// `-Vort/mu`.
        whirl: Option<Matrix<N>>,
    },
    /// `phi(t) = exp(t whirl) exp(t stretch) phi0`: materially affine models; `whirl` is skew, `None` where it
    /// vanishes.
    Space {
        /// `Sigma0/alpha + tr(Sigma0)/beta`.
        stretch: Matrix<N>,
        /// `-S/mu`.
        whirl: Option<Matrix<N>>,
    },
    /// `phi(t) = phi0 + t phi_dot0`: d'Alembert models.
    Straight {
        /// `phi_dot0`.
        velocity: Matrix<N>,
    },
}
