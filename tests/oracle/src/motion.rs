//! Motion through a point: the canonical vector field and derivatives along it.

mod constrained;

use num_rational::BigRational;

use crate::differential::Differential;
use crate::error::Error;
use crate::kinetic::Kinetic;
use crate::matrix::Matrix;
use crate::observable::Observable;
use crate::potential::{Place, Slopes};
use crate::ring::{exact, rounded};
use crate::state::State;

pub use constrained::Constraint;

/// The canonical vector field of a kinetic energy at one point.
#[derive(Clone, Debug)]
pub struct Motion<'a> {
    kinetic: &'a Kinetic,
    state: State,
    rate: State,
    energy: BigRational,
}

impl Kinetic {
    /// Hamilton's equations at `state`: `x_dot, phi_dot = dH/dP = M^-1 P`; `Pi_dot = -dH/dphi = dT/dphi` at fixed
    /// velocities, by dual numbers through `T`; `p_dot = -dH/dx = 0`, since no term of `T` contains `x`.
    ///
    /// # Errors
    /// As [`Kinetic::velocity`].
    pub fn motion(&self, state: &State) -> Result<Motion<'_>, Error> {
        let n = self.dimension();
        let (x_dot, phi_dot) = self.velocity(state)?;
        let energy = self.energy(&state.phi, &x_dot, &phi_dot)?.entry(0, 0);
        let pi_dot = self.slope_of_placement(&state.phi, &x_dot, &phi_dot)?;
        let rate = State { x: x_dot, phi: phi_dot, p: Matrix::zeros(n, 1), pi: pi_dot };
        Ok(Motion { kinetic: self, state: state.clone(), rate, energy })
    }

    /// `(dT/dphi)^T` at fixed velocities, by dual numbers through `T`.
    fn slope_of_placement(&self, phi: &Matrix, x_dot: &Matrix, phi_dot: &Matrix) -> Result<Matrix, Error> {
        let n = self.dimension();
        let mut slopes = Vec::with_capacity(n * n);
        // Row-major in (A, i), as Pi is.
        for place in 0..n * n {
            let direction = Matrix::unit(n, place % n, place / n);
            let energy = self.energy(
                &Matrix::along(phi, &direction),
                &Matrix::constant(x_dot),
                &Matrix::constant(phi_dot),
            )?;
            slopes.push(energy.slope().entry(0, 0));
        }
        Ok(Matrix::from_rationals(n, n, &slopes))
    }

    /// Everything about one point, each number exact until it is rounded at the end.
    ///
    /// # Errors
    /// As [`Kinetic::velocity`].
    pub fn expected(&self, state: &State) -> Result<Expected, Error> {
        self.motion(state)?.expected()
    }
}

impl Motion<'_> {
    /// The same point with a potential `U(t, x, phi)` added to the energy: `p_dot -= dU/dx`, `Pi_dot -= (dU/dphi)^T`,
    /// `H += U`. Coordinates and gradient are `f64`, the rest stays exact.
    ///
    /// # Errors
    /// [`Error::NotFinite`] where the potential or its gradient is.
    pub fn under(mut self, t: f64, potential: &dyn Fn(&Place) -> Differential) -> Result<Self, Error> {
        let n = self.state.dimension();
        let slopes = Slopes::of(potential, t, &self.state.x.to_f64(), &self.state.phi.to_f64());
        let force = Matrix::from_f64("dU/dphi", n, n, &slopes.phi)?;
        self.rate.p = &self.rate.p - &Matrix::from_f64("dU/dx", n, 1, &slopes.x)?;
        self.rate.pi = &self.rate.pi - &force.transpose();
        self.energy += exact(slopes.value).ok_or(Error::NotFinite { quantity: "U" })?;
        Ok(self)
    }

    /// The same point with the forces of a dissipation function `R(phi; x_dot, phi_dot)`, given as a kinetic energy is:
    /// `p_dot -= dR/dx_dot`, `Pi_dot -= (dR/dphi_dot)^T` (Lagrange's equations with Rayleigh's function), the slopes by
    /// dual numbers through `R`.
    ///
    /// # Errors
    /// As [`Kinetic::energy`].
    pub fn damped(mut self, dissipation: &Kinetic) -> Result<Self, Error> {
        let n = self.state.dimension();
        let phi = Matrix::constant(&self.state.phi);
        let slope = |x_direction: &Matrix, phi_direction: &Matrix| {
            let x_dot = Matrix::along(&self.rate.x, x_direction);
            let phi_dot = Matrix::along(&self.rate.phi, phi_direction);
            Ok::<_, Error>(dissipation.energy(&phi, &x_dot, &phi_dot)?.slope().entry(0, 0))
        };
        let (mut on_p, mut on_pi) = (Vec::with_capacity(n), Vec::with_capacity(n * n));
        for i in 0..n {
            on_p.push(slope(&Matrix::unit(n, 0, i).rows(0, 1).transpose(), &Matrix::zeros(n, n))?);
        }
        // Row-major in (A, i), as Pi is.
        for place in 0..n * n {
            on_pi.push(slope(&Matrix::zeros(n, 1), &Matrix::unit(n, place % n, place / n))?);
        }
        if self.kinetic.has_translation() {
            self.rate.p = &self.rate.p - &Matrix::from_rationals(n, 1, &on_p);
        }
        self.rate.pi = &self.rate.pi - &Matrix::from_rationals(n, n, &on_pi);
        Ok(self)
    }

    /// The same point with forces on the canonical momenta: `p_dot += on_p`, `Pi_dot += on_pi` (row-major in `(A, i)`).
    ///
    /// # Errors
    /// [`Error::Shape`], [`Error::NotFinite`].
    pub fn pushed(mut self, on_p: &[f64], on_pi: &[f64]) -> Result<Self, Error> {
        let n = self.state.dimension();
        self.rate.p = &self.rate.p + &Matrix::from_f64("the force on p", n, 1, on_p)?;
        self.rate.pi = &self.rate.pi + &Matrix::from_f64("the force on Pi", n, n, on_pi)?;
        Ok(self)
    }

    /// The point.
    pub fn state(&self) -> &State {
        &self.state
    }

    /// `(x_dot, phi_dot; p_dot, Pi_dot)`.
    pub fn rate(&self) -> &State {
        &self.rate
    }

    /// The kinetic energy of the velocities and the potential, equal to `H`.
    pub fn energy(&self) -> &BigRational {
        &self.energy
    }

    /// `{F, H}`, the derivative of `F` along the motion; exactly 0 where `F` is conserved to first order at the point.
    /// [`Observable::Energy`] is the kinetic energy alone: its derivative under a potential is the power of the forces.
    ///
    /// # Errors
    /// As [`Kinetic::velocity`], for [`Observable::Energy`] only.
    pub fn bracket(&self, observable: Observable) -> Result<Matrix, Error> {
        Ok(observable.value(self.kinetic, &self.state.along(&self.rate))?.slope())
    }

    /// The motion in `f64`.
    ///
    /// # Errors
    /// As [`Motion::bracket`].
    pub fn expected(&self) -> Result<Expected, Error> {
        Ok(Expected {
            hamiltonian: rounded(&self.energy),
            x_dot: self.rate.x.to_f64(),
            phi_dot: self.rate.phi.to_f64(),
            p_dot: self.rate.p.to_f64(),
            pi_dot: self.rate.pi.to_f64(),
            sigma_dot: self.bracket(Observable::AffineSpin)?.to_f64(),
            sigma_hat_dot: self.bracket(Observable::ComovingAffineSpin)?.to_f64(),
            p_hat_dot: self.bracket(Observable::ComovingLinearMomentum)?.to_f64(),
        })
    }
}

/// Energy and derivatives at one point, each correctly rounded from the exact value; matrices row-major.
#[derive(Clone, Debug, PartialEq)]
pub struct Expected {
    /// `H`.
    pub hamiltonian: f64,
    /// `x_dot`; zero without translation.
    pub x_dot: Vec<f64>,
    /// `phi_dot[i][A]`.
    pub phi_dot: Vec<f64>,
    /// `p_dot`.
    pub p_dot: Vec<f64>,
    /// `Pi_dot[A][i]`.
    pub pi_dot: Vec<f64>,
    /// `d(phi Pi)/dt`.
    pub sigma_dot: Vec<f64>,
    /// `d(Pi phi)/dt`.
    pub sigma_hat_dot: Vec<f64>,
    /// `d(phi^T p)/dt`.
    pub p_hat_dot: Vec<f64>,
}
