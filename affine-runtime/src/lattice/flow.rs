//! The motion of a lattice.

use core::fmt;

use super::{Lattice, LatticeForm, TwoPolarForm, Variables};
use crate::error::Error;
use crate::integrate::{Failure, RungeKutta8};
use crate::model::Group;

/// Stretches nearer than this are taken across in the form of the placement; see [`LatticeFlow`].
const NEAR: f64 = 0.05;
/// Back on the lattice once they are further apart than this: no change to and fro.
const APART: f64 = 0.1;

/// The motion of a lattice by the Runge-Kutta method of order 8 with adaptive steps.
///
/// The stretches are integrated in descending order, in which nothing overflows, and handed out in the labels of the
/// start, continued.
///
/// *Coincidences.* Where two stretches meet, `dM/dt`, `chi_hat` and `theta_hat` have poles although the motion is smooth. So
/// when the least gap `|q_a - q_b|` falls below 0.05, the motion goes on in the placement and its affine spin
/// (the model's reduced equations) until the gap is above 0.1, with labels and frames that follow
/// through crossings. A motion that stays there, all stretches nearly equal, is integrated in that form to the end. Nothing
/// is lost by it but the form: tolerances are the same.
#[derive(Clone, Debug)]
pub struct LatticeFlow<'a, const N: usize, M: TwoPolarForm<N>> {
    model: &'a M,
    t: f64,
    lattice: Lattice<N>,
    tolerance: f64,
    placements: u64,
    steps: u64,
}

/// Why a motion stopped, and where.
#[derive(Clone, Debug, PartialEq)]
pub struct LatticeStop<const N: usize> {
    /// Time of the last good state.
    pub t: f64,
    /// The last good state.
    pub lattice: Lattice<N>,
    /// What happened.
    pub reason: StopReason,
}

/// What stopped a motion.
#[derive(Clone, Debug, PartialEq)]
pub enum StopReason {
    /// The integrator cannot go on.
    Integration(Failure),
    /// The state is no phase point any more: stretches beyond the range of doubles, or not to be told from zero.
    Conversion(Error),
}

impl<'a, const N: usize, M: TwoPolarForm<N>> LatticeFlow<'a, N, M> {
    /// The motion through `lattice` at the time `t`, with a tolerance of 1e-13 for each step.
    pub fn new(model: &'a M, t: f64, lattice: Lattice<N>) -> Self {
        Self { model, t, lattice, tolerance: 1e-13, placements: 0, steps: 0 }
    }

    /// Another tolerance for each step; below 1e-15 rounding rules.
    #[must_use]
    pub fn tolerance(mut self, tolerance: f64) -> Self {
        self.tolerance = tolerance;
        self
    }

    /// Time reached.
    #[must_use]
    pub fn t(&self) -> f64 {
        self.t
    }

    /// State reached.
    #[must_use]
    pub fn lattice(&self) -> &Lattice<N> {
        &self.lattice
    }

    /// Steps taken, and how many of them in the form of the placement.
    #[must_use]
    pub fn steps(&self) -> (u64, u64) {
        (self.steps, self.placements)
    }

    /// Moves to the time `t`, forward or backward, and stands there exactly.
    ///
    /// # Errors
    /// [`LatticeStop`] with the last good state.
    pub fn advance_to(&mut self, t: f64) -> Result<&Lattice<N>, LatticeStop<N>> {
        while self.t != t {
            let before = (self.t, self.lattice);
            let outcome = match self.lattice.gap() < NEAR {
                true => self.placement_until_apart(t),
                false => self.lattice_until_near(t),
            };
            outcome.map_err(|reason| LatticeStop { t: before.0, lattice: before.1, reason })?;
        }
        Ok(&self.lattice)
    }

    /// The lattice equations until `t`, or until two stretches are near.
    fn lattice_until_near(&mut self, t: f64) -> Result<(), StopReason> {
        let sorting = self.lattice.descending();
        let sorted = self.lattice.relabelled(&sorting);
        let (couplings, state) = sorted.framed::<M>();
        let rates = |_: f64, state: &M::Framed<f64>| self.model.framed_equations(&couplings, state);
        let mut steps = RungeKutta8::new(rates, groups::<N, M>(), (self.t, state), t, self.tolerance)
            .map_err(StopReason::Integration)?;
        while !steps.is_finished() {
            steps.advance().map_err(StopReason::Integration)?;
            self.steps += 1;
            let now = Lattice::from_framed::<M>(&couplings, steps.y());
            // Near or past it: a step may have jumped across.
            if now.gap() < NEAR || now.descending() != crate::frames::Matrix::<N>::identity() {
                self.t = steps.t();
                self.lattice = now.relabelled(&sorting.transpose());
                return Ok(());
            }
        }
        self.t = steps.t();
        self.lattice = Lattice::from_framed::<M>(&couplings, steps.y()).relabelled(&sorting.transpose());
        Ok(())
    }

    /// The model's reduced equations until `t`, or until the stretches are apart.
    fn placement_until_apart(&mut self, t: f64) -> Result<(), StopReason> {
        let point = self.model.at_lattice(&self.lattice).map_err(StopReason::Conversion)?;
        let (state, constants) = self.model.reduce(self.t, &point);
        let rates =
            |time: f64, state: &M::Reduced<f64>| self.model.reduced_equations(time, &constants, state);
        let mut steps = RungeKutta8::new(rates, M::DESCRIPTION.reduced, (self.t, state), t, self.tolerance)
            .map_err(StopReason::Integration)?;
        while !steps.is_finished() {
            steps.advance().map_err(StopReason::Integration)?;
            self.steps += 1;
            self.placements += 1;
            let point = self.model.expand(steps.t(), &constants, steps.y());
            self.lattice = self.model.lattice_after(&point, &self.lattice).map_err(StopReason::Conversion)?;
            self.t = steps.t();
            if self.lattice.gap() > APART {
                return Ok(());
            }
        }
        Ok(())
    }
}

/// The layout for the error norm: momenta and couplings together, since any of them may vanish; angles against 1 as
/// logarithms are.
fn groups<const N: usize, M: LatticeForm<N>>() -> &'static [Group] {
    const fn group(name: &'static str, len: usize) -> Group {
        Group { name, len }
    }
    const PLANE: [[Group; 3]; 2] = [
        [group("q", 2), group("momenta", 2), group("q", 2)],
        [group("Q", 2), group("momenta", 2), group("q", 2)],
    ];
    const SPACE: [[Group; 4]; 2] = [
        [group("q", 3), group("momenta", 9), group("L", 9), group("R", 9)],
        [group("Q", 3), group("momenta", 9), group("L", 9), group("R", 9)],
    ];
    match (N, M::LATTICE.variables) {
        (2, Variables::LogStretches) => &PLANE[0],
        (2, Variables::Stretches) => &PLANE[1],
        (_, Variables::LogStretches) => &SPACE[0],
        (_, Variables::Stretches) => &SPACE[1],
    }
}

impl<const N: usize> fmt::Display for LatticeStop<N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the motion of the lattice stopped at t = {}: {}", self.t, self.reason)
    }
}

impl fmt::Display for StopReason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            StopReason::Integration(failure) => failure.fmt(f),
            StopReason::Conversion(error) => error.fmt(f),
        }
    }
}

impl<const N: usize> core::error::Error for LatticeStop<N> {}
