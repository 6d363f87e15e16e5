//! The motion of a lattice.

use core::fmt;

use super::{Lattice, LatticeForm, TwoPolarForm, Variables};
use crate::error::Error;
use crate::frames::{Matrix, Vector};
use crate::inner::Time;
use crate::integrate::{Failure, RungeKutta8};
use crate::model::{Constraint, Group, Model, Quantity};

/// Stretches nearer than this are taken across in the form of the placement; see [`LatticeFlow`].
const NEAR: f64 = 0.05;
/// Back on the lattice once they are further apart than this: no change to and fro.
const APART: f64 = 0.1;

/// Cosine of the angle by which axes may turn from one decomposition to the next: 37 degrees, less than the half right
/// angle beyond which another axis is nearer.
const NEARLY_PARALLEL: f64 = 0.8;
/// A step is halved at most so often: axes that turn faster cross, within what rounding can tell.
const DEPTH: u32 = 24;

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
///
/// *Isochoric bodies.* After each step the volume is 1 up to rounding, and the momentum of the volume 0: every lattice of the motion
/// is one of [`at_lattice`](TwoPolarForm::at_lattice).
///
/// *Collapse.* A stretch of d'Alembert's model may reach zero in finite time; the motion then stops there, with
/// [`Error::Placement`] and the time of the collapse.
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
#[derive(Clone, PartialEq)]
pub struct LatticeStop<const N: usize> {
    /// Time of the last good state.
    pub t: f64,
    /// The last good state.
    pub lattice: Lattice<N>,
    /// Why the motion stopped.
    pub reason: StopReason,
}

/// What stopped a motion.
#[derive(Clone, Debug, PartialEq)]
pub enum StopReason {
    /// The integrator cannot go on.
    Integration(Failure),
    /// The tolerance is not in `1e-15 <= eps < 1`.
    Tolerance {
        /// Its value.
        given: f64,
    },
    /// Two angles of U(n) coincide or are opposite, or a fixed step does not resolve how two places meet: there the
    /// equations have a pole.
    Coincidence {
        /// `|sin x_ab|` or `|cos x_ab|` where the motion was going, `x_ab = (q_a - q_b)/2`, or the difference of the places.
        distance: f64,
    },
    /// The state is no phase point any more: stretches beyond the range of doubles, or not to be told from zero.
    Conversion(Error),
}

impl<'a, const N: usize, M: TwoPolarForm<N>> LatticeFlow<'a, N, M> {
    /// The motion through `lattice` at the time `t`, with a tolerance of 1e-13 for each step.
    pub fn new(model: &'a M, t: f64, lattice: Lattice<N>) -> Self {
        Self { model, t, lattice, tolerance: 1e-13, placements: 0, steps: 0 }
    }

    /// Another tolerance for each step, `1e-15 <= eps < 1`; checked by [`advance_to`](Self::advance_to).
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
    /// [`LatticeStop`] with the last good state, where it stays until it is asked for another time.
    pub fn advance_to(&mut self, t: f64) -> Result<&Lattice<N>, LatticeStop<N>> {
        if !t.is_finite() {
            let reason = StopReason::Conversion(Error::NotFinite { quantity: "t" });
            return Err(LatticeStop { t: self.t, lattice: self.lattice, reason });
        }
        if let Err(reason) = sound(self.tolerance) {
            return Err(LatticeStop { t: self.t, lattice: self.lattice, reason });
        }
        let mut near = self.lattice.gap() < NEAR;
        while self.t != t {
            let outcome = match near {
                true => self.placement_until_apart(t).map(|()| false),
                false => self.lattice_until_near(t).map(|()| true),
            };
            near = outcome.map_err(|reason| LatticeStop { t: self.t, lattice: self.lattice, reason })?;
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
            if !is_finite(&now) {
                let (begin, end, dense) = (self.t, steps.t(), steps.dense());
                let at = |time: f64| {
                    let lattice = Lattice::from_framed::<M>(&couplings, &dense.at(time));
                    is_finite(&lattice).then(|| lattice.relabelled(&sorting.transpose()))
                };
                return Err(self.collapsed(begin, end, at, Error::Placement { determinant: 0.0 }));
            }
            if now.descending() != Matrix::<N>::identity() {
                // The step went past a coincidence, and with it past a pole: its begin stands.
                return Ok(());
            }
            self.t = steps.t();
            self.lattice = on_the_group::<N, M>(now.relabelled(&sorting.transpose()));
            if now.gap() < NEAR {
                return Ok(());
            }
        }
        Ok(())
    }

    /// The model's reduced equations until `t`, or until the stretches are apart and parting.
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
            let (begin, end, dense) = (self.t, steps.t(), steps.dense());
            let point = |time: f64| self.model.expand(time, &constants, &dense.at(time));
            let before = self.lattice;
            match self.followed(&point, before, (begin, end), DEPTH) {
                Ok(next) => self.lattice = next,
                Err(error) => {
                    let at = |time: f64| self.followed(&point, before, (begin, time), DEPTH).ok();
                    let (t, lattice) = last_good(begin, end, at).unwrap_or((begin, before));
                    (self.t, self.lattice) = (t, lattice);
                    return Err(StopReason::Conversion(error));
                }
            }
            self.t = end;
            if self.lattice.gap() > APART && self.lattice.gap() > before.gap() {
                return Ok(());
            }
        }
        Ok(())
    }

    /// Stands at the last good state of a step that left the phase space.
    fn collapsed(
        &mut self,
        begin: f64,
        end: f64,
        at: impl Fn(f64) -> Option<Lattice<N>>,
        error: Error,
    ) -> StopReason {
        if let Some((t, lattice)) = last_good(begin, end, at) {
            (self.t, self.lattice) = (t, lattice);
        }
        StopReason::Conversion(error)
    }

    /// The lattice at the end of an interval, from that at its start: halved where the axes turn too far to tell
    /// which is which, and where stretches change their order, since seen from afar two that bounce while their axes
    /// turn by a right angle look like two that cross.
    fn followed(
        &self,
        point: &impl Fn(f64) -> M::Point<f64>,
        before: Lattice<N>,
        (begin, end): (f64, f64),
        depth: u32,
    ) -> crate::Result<Lattice<N>> {
        let next = on_the_group::<N, M>(self.model.lattice_after(&point(end), &before)?);
        let turned = |a: usize| {
            next.left.column(a).dot(&before.left.column(a)) < NEARLY_PARALLEL
                || next.right.column(a).dot(&before.right.column(a)) < NEARLY_PARALLEL
        };
        let crossed = next.descending() != before.descending();
        if depth == 0 || !(crossed || (0..N).any(turned)) {
            return Ok(next);
        }
        let middle = 0.5 * (begin + end);
        let halfway = self.followed(point, before, (begin, middle), depth - 1)?;
        self.followed(point, halfway, (middle, end), depth - 1)
    }
}

/// A lattice brought back to the group of the model. Steps in the space around it, and rounding, change the volume and its
/// momentum by what the tolerance allows: that is taken from all places alike. Of the other groups no lattice has stretches apart.
fn on_the_group<const N: usize, M: Model<N>>(lattice: Lattice<N>) -> Lattice<N> {
    match M::DESCRIPTION.constraint {
        Some(Constraint::Isochoric) => {
            let centred = |places: &Vector<N>| places.add_scalar(-places.mean());
            Lattice { q: centred(&lattice.q), p: centred(&lattice.p), ..lattice }
        }
        Some(Constraint::Rigid | Constraint::Conformal) | None => lattice,
    }
}

/// The last time between two at which there is a lattice, and that lattice.
fn last_good<const N: usize>(
    begin: f64,
    end: f64,
    at: impl Fn(f64) -> Option<Lattice<N>>,
) -> Option<(f64, Lattice<N>)> {
    let (mut good, mut bad, mut last) = (begin, end, None);
    for _ in 0..64 {
        let middle = 0.5 * (good + bad);
        match at(middle) {
            Some(lattice) => (good, last) = (middle, Some((middle, lattice))),
            None => bad = middle,
        }
    }
    last
}

fn is_finite<const N: usize>(lattice: &Lattice<N>) -> bool {
    lattice.q.iter().chain(lattice.p.iter()).all(|value| value.is_finite())
}

/// The layout for the error norm: momenta and couplings together, since any of them may vanish; angles against 1 as
/// logarithms are.
pub(super) fn groups<const N: usize, M: LatticeForm<N>>() -> &'static [Group] {
    use Quantity::{LatticeMomenta, LeftRotation, LogStretches, RightRotation, Stretches};
    const PLANE: [[Group; 3]; 2] = [
        [Group::new(LogStretches, 2), Group::new(LatticeMomenta, 2), Group::new(LogStretches, 2)],
        [Group::new(Stretches, 2), Group::new(LatticeMomenta, 2), Group::new(LogStretches, 2)],
    ];
    const SPACE: [[Group; 4]; 2] = [
        [
            Group::new(LogStretches, 3),
            Group::new(LatticeMomenta, 9),
            Group::new(LeftRotation, 9),
            Group::new(RightRotation, 9),
        ],
        [
            Group::new(Stretches, 3),
            Group::new(LatticeMomenta, 9),
            Group::new(LeftRotation, 9),
            Group::new(RightRotation, 9),
        ],
    ];
    match (N, M::LATTICE.variables) {
        (2, Variables::LogStretches | Variables::Angles) => &PLANE[0],
        (2, Variables::Stretches) => &PLANE[1],
        (_, Variables::LogStretches | Variables::Angles) => &SPACE[0],
        (_, Variables::Stretches) => &SPACE[1],
    }
}

/// A tolerance that steps can have.
pub(super) fn sound(tolerance: f64) -> Result<(), StopReason> {
    let is_sound = (1e-15..1.0).contains(&tolerance);
    if is_sound { Ok(()) } else { Err(StopReason::Tolerance { given: tolerance }) }
}

impl<const N: usize> fmt::Display for LatticeStop<N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the motion of the lattice stopped at t = {}: {}", Time(self.t), self.reason)
    }
}

impl fmt::Display for StopReason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            StopReason::Integration(failure) => failure.fmt(f),
            StopReason::Tolerance { given } => write!(
                f,
                "tolerance {given:e}: it is a relative error per step, at least 1e-15 (what rounding leaves of double \
                 precision) and below 1"
            ),
            StopReason::Coincidence { distance } => write!(
                f,
                "two places coincide or are opposite, to {distance:e}, where (q, p, M, N) are no coordinates"
            ),
            StopReason::Conversion(error) => error.fmt(f),
        }
    }
}

/// As it is displayed: a `main` that returns an error prints that.
impl<const N: usize> core::fmt::Debug for LatticeStop<N> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        core::fmt::Display::fmt(self, f)
    }
}

impl<const N: usize> core::error::Error for LatticeStop<N> {}
