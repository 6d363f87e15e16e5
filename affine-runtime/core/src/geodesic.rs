//! Closed-form trajectories (Slawianowski et al., section 5; Martin and Neff, arXiv:1409.7849).
//!
//! Every instant is computed from the start, with at most two exponentials: output times may come in any
//! order, and errors do not add up from one to the next.

mod collapse;

use crate::decompose::exponential::{exponential, skew_exponential};
use crate::frames::{Matrix, Vector};
use crate::norm::norm;
use crate::state::Phase;

/// A trajectory in closed form.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Geodesic<const N: usize> {
    /// Time of the start.
    pub t0: f64,
    /// The motion of the placement.
    pub motion: Orbit<N>,
    /// Constant velocity of the centre of mass; zero for a body at rest.
    pub drift: Vector<N>,
}

/// How the placement moves along a closed-form trajectory, on an orbit of one-parameter groups; `t` is counted from the start.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Orbit<const N: usize> {
    /// `phi(t) = phi0 exp(t stretch) exp(t whirl)`: spatially affine models; `whirl` is skew, `None` where it
    /// vanishes.
    Body {
        /// `Sigma_hat0/alpha + tr(Sigma_hat0)/beta`, and `c Sigma_hat0^2` for `c/3 C(3)` in the Hamiltonian.
        stretch: Matrix<N>,
        /// `-Vort/mu`.
        whirl: Option<Matrix<N>>,
    },
    /// `phi(t) = exp(t whirl) exp(t stretch) phi0`: materially affine models; `whirl` is skew, `None` where it
    /// vanishes.
    Space {
        /// `Sigma0/alpha + tr(Sigma0)/beta`, and `c Sigma0^2` for `c/3 C(3)` in the Hamiltonian.
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

impl<const N: usize> Geodesic<N> {
    /// The phase point at time `t` of the trajectory that passes through `start` at `t0`.
    #[must_use]
    pub fn point<P: Phase<N>>(&self, t: f64, start: &P) -> P {
        let (x, phi) = (self.position(t, &start.x()), self.placement(t, start.phi()));
        start.moved(x, phi, |spin| self.spin(t, spin))
    }

    /// `|stretch| + |whirl|` in Frobenius norms: angles and log-stretches of the motion grow at most so fast. From an
    /// elapsed time of `1/(eps rate)` on, the rounding of time and generators alone may turn the body by a radian. Zero
    /// for straight motions, which have neither.
    #[must_use]
    pub fn rate(&self) -> f64 {
        match &self.motion {
            Orbit::Body { stretch, whirl } | Orbit::Space { stretch, whirl } => {
                norm(stretch.as_slice()) + whirl.as_ref().map_or(0.0, |whirl| norm(whirl.as_slice()))
            }
            Orbit::Straight { .. } => 0.0,
        }
    }

    /// `phi(t)` of the trajectory with `phi(t0) = start`.
    #[must_use]
    pub fn placement(&self, t: f64, start: &Matrix<N>) -> Matrix<N> {
        self.motion.placement(t - self.t0, start)
    }

    /// `x(t) = x0 + (t - t0) drift` of the trajectory with `x(t0) = start`.
    #[must_use]
    pub fn position(&self, t: f64, start: &Vector<N>) -> Vector<N> {
        start + self.drift * (t - self.t0)
    }

    /// The affine spin at time `t` of the trajectory that has the spin `start` at `t0`, in the frame of the
    /// motion: see [`Orbit::spin`].
    #[must_use]
    pub fn spin(&self, t: f64, start: &Matrix<N>) -> Matrix<N> {
        self.motion.spin(t - self.t0, start)
    }
}

impl<const N: usize> Orbit<N> {
    /// The placement after the time `elapsed`, from the placement `start`; the formula stands with each
    /// variant.
    #[must_use]
    pub fn placement(&self, elapsed: f64, start: &Matrix<N>) -> Matrix<N> {
        match self {
            Self::Body { stretch, whirl } => {
                let stretched = start * exponential(&(stretch * elapsed));
                turned(whirl, elapsed).map_or(stretched, |turn| stretched * turn)
            }
            Self::Space { stretch, whirl } => {
                let stretched = exponential(&(stretch * elapsed)) * start;
                turned(whirl, elapsed).map_or(stretched, |turn| turn * stretched)
            }
            Self::Straight { velocity } => start + velocity * elapsed,
        }
    }

    /// The affine spin after the time `elapsed`, from the spin `start`, in the frame of the motion.
    ///
    /// ```text
    /// Body:      Sigma_hat(t) = exp(-t whirl) Sigma_hat0 exp(t whirl)     (Sigma and Vort are constant)
    /// Space:     Sigma(t)     = exp(t whirl) Sigma0 exp(-t whirl)         (Sigma_hat and S are constant)
    /// Straight:  Pi(t)        = Pi0
    /// ```
    #[must_use]
    pub fn spin(&self, elapsed: f64, start: &Matrix<N>) -> Matrix<N> {
        match self {
            Self::Body { whirl, .. } => {
                turned(whirl, elapsed).map_or(*start, |turn| turn.transpose() * start * turn)
            }
            Self::Space { whirl, .. } => {
                turned(whirl, elapsed).map_or(*start, |turn| turn * start * turn.transpose())
            }
            Self::Straight { .. } => *start,
        }
    }
}

/// `exp(elapsed whirl)`; `None` stands for the identity.
fn turned<const N: usize>(whirl: &Option<Matrix<N>>, elapsed: f64) -> Option<Matrix<N>> {
    whirl.as_ref().map(|skew| skew_exponential(&(skew * elapsed)))
}
