//! Forward and back: what a run and the run back leave of the start.

use core::fmt;

use super::outcome::Outcome;
use super::output::Output;
use super::settings::Settings;
use super::simulation::Simulation;
use super::trajectory::Trajectory;
use crate::inner::larger;
use crate::model::Model;
use crate::state::Phase;

/// A run and the run back from its end to the time of its start, see [`Simulation::forward_and_back`].
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct RoundTrip<const N: usize, P> {
    /// The run forward.
    pub forward: Trajectory<N, P>,
    /// The run back.
    pub back: Trajectory<N, P>,
}

impl<const N: usize, M: Model<N>> Simulation<'_, N, M> {
    /// Runs the simulation, then runs it back from where it ended, by the same method, tolerance, outputs and limit of
    /// steps; callbacks and events belong to the way forward.
    ///
    /// A test that needs no reference: what is left at the start is of the size of both errors together. It is a lower
    /// bound in practice, not an upper one: errors that the way back undoes are not seen, those of symmetric methods in
    /// equal steps (Gauss, RATTLE, splitting) least of all, which return up to rounding whatever the step. Gauss collocation
    /// does so where it keeps what the reduction took out, as `det Psi = 1` or the vorticity: the way back begins with their
    /// values at the turn. With friction the way back multiplies errors by what the motion had lost. Where an event changed
    /// the motion the way back leads elsewhere.
    ///
    /// # Errors
    /// [`Halt`](super::Halt) of whichever run stopped.
    pub fn forward_and_back(self) -> Outcome<N, M::Point<f64>, RoundTrip<N, M::Point<f64>>> {
        let (model, begin, mut plan) = (self.model, self.begin, self.settings.plan.clone());
        let forward = self.run()?;
        let (reached, end) = forward.end();
        plan.output = plan.output.reversed_from(plan.t0, reached);
        (plan.t0, plan.t_end) = (reached, Some(plan.t0));
        let settings = Settings { plan, ..Settings::new(*end) };
        let back = Simulation { model, settings, begin }.run()?;
        Ok(RoundTrip { forward, back })
    }
}

impl<const N: usize, P: Phase<N>> RoundTrip<N, P> {
    /// `|phi' - phi|/|phi|` of the placement at the start and the one come back, in the Frobenius norm.
    #[must_use]
    pub fn placement(&self) -> f64 {
        let (start, end) = self.ends();
        relative((end.phi() - start.phi()).norm(), [start.phi().norm()])
    }

    /// The same of the affine spin, relative to the larger of its norms at the start and at the end of the way forward.
    #[must_use]
    pub fn affine_spin(&self) -> f64 {
        let (start, end) = self.ends();
        let size = |point: &P| point.mixed_spin().norm();
        relative((end.mixed_spin() - start.mixed_spin()).norm(), [size(start), size(self.forward.end().1)])
    }

    /// The same of the centre of mass, relative to the larger of `|x|` at both ends of the way forward; 0 for a pinned
    /// body.
    #[must_use]
    pub fn centre(&self) -> f64 {
        let (start, end) = self.ends();
        relative((end.x() - start.x()).norm(), [start.x().norm(), self.forward.end().1.x().norm()])
    }

    /// The largest of the three.
    #[must_use]
    pub fn worst(&self) -> f64 {
        [self.placement(), self.affine_spin(), self.centre()].into_iter().fold(0.0, larger)
    }

    fn ends(&self) -> (&P, &P) {
        (self.forward.start().1, self.back.end().1)
    }
}

impl<const N: usize, P: Phase<N>> fmt::Display for RoundTrip<N, P> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (t0, t_end) = (self.forward.start().0, self.forward.end().0);
        writeln!(f, "from t = {t0} to {t_end} and back, relative to the start:")?;
        writeln!(f, "  placement    {:.1e}", self.placement())?;
        writeln!(f, "  affine spin  {:.1e}", self.affine_spin())?;
        writeln!(f, "  centre       {:.1e}", self.centre())
    }
}

impl Output {
    /// The same outputs of a run in the other direction, from `reached` to `t0`.
    fn reversed_from(self, t0: f64, reached: f64) -> Self {
        match self {
            Output::At(times) => {
                let passed = |t: &f64| (t - t0).abs() <= (reached - t0).abs();
                Output::At(times.into_iter().filter(passed).rev().collect())
            }
            other => other,
        }
    }
}

/// A distance in parts of the larger of two sizes.
fn relative<const K: usize>(distance: f64, sizes: [f64; K]) -> f64 {
    if distance == 0.0 { 0.0 } else { distance / sizes.into_iter().fold(0.0, larger) }
}
