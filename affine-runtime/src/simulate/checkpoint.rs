//! Where a run was interrupted, as numbers from which it goes on with the same bits.

mod line;
mod numbers;

use super::standing::Memory;
use crate::inner::Tape;
use crate::integrate::{FusedArithmetic, Statistics};
use crate::state::Phase;

/// The state of an interrupted run between two steps, and what has been done of the step after.
///
/// All numbers are kept as their bits, so that no text format rounds them. With the feature `serde` it can be written
/// and read.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Checkpoint {
    /// What the run is known by: [`fingerprint`](super::fingerprint::fingerprint).
    pub(super) run: String,
    /// The arithmetic of the machine.
    pub(super) fused: FusedArithmetic,
    pub(super) place: Place,
    /// The digest of the place, as it was when the checkpoint was made.
    digest: u64,
}

impl Checkpoint {
    /// A checkpoint of a run on this machine.
    pub(super) fn new(run: String, place: Place) -> Self {
        let digest = place.digest();
        Self { run, fused: FusedArithmetic::here(), place, digest }
    }

    /// Is it of the run that is known by this, and as it was written? An integrator that goes on from other numbers leads
    /// anywhere, and does not tell.
    pub(super) fn is_of(&self, run: &str) -> bool {
        self.run == run && self.place.digest() == self.digest
    }
}

/// How far a run has come.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Place {
    /// Bits of the time and of the point from which the integration started: the start, or where an event changed it.
    pub(super) from: Vec<u64>,
    /// What is known of the events where it goes on.
    pub(super) events: Vec<Memory>,
    /// Bits of the cost before.
    pub(super) cost: [u64; 5],
    /// Bits of the work before.
    pub(super) work: u64,
    /// Bits of the largest `|T| + |U|` met since then.
    pub(super) energy: u64,
    /// State of the integrator, or the time reached in closed form; empty where it has not begun.
    pub(super) integrator: Vec<u64>,
    /// Output times done.
    pub(super) outputs: u64,
    /// Events of the step after that are done.
    pub(super) met: usize,
    /// The point at the end of that step has been recorded.
    pub(super) recorded: bool,
    /// An event has set the centre of mass in motion.
    pub(super) moved: bool,
    /// Bits of the time from which on another method took the motion because friction was stiff; no number without one.
    pub(super) stiff_since: u64,
}

impl Place {
    /// At the start of an integration. Where that is is written down when it is asked for, by [`from`](Self::from).
    pub(super) fn starting(events: Vec<Memory>, (cost, work): (Statistics, f64)) -> Self {
        let stiff_since = f64::NAN.to_bits();
        let mut place = Self { events, work: work.to_bits(), stiff_since, ..Self::default() };
        place.set_cost(cost);
        place
    }

    /// Counts evaluations that are spent before the integration begins; where it has begun they have been counted.
    pub(super) fn spend(&mut self, evaluations: u64) {
        if self.integrator.is_empty() {
            self.set_cost(self.cost().and(Statistics { evaluations, ..Statistics::default() }));
        }
    }

    fn set_cost(&mut self, cost: Statistics) {
        let Statistics { steps, rejected, evaluations, series, series_worth } = cost;
        self.cost = [steps, rejected, evaluations, series, series_worth];
    }

    /// With the time and the point from which the integration started.
    pub(super) fn from<const N: usize, P: Phase<N>>(self, t: f64, point: &P) -> Self {
        // The time, and x, phi, p and a momentum in three dimensions: one allocation.
        let mut from = Vec::with_capacity(1 + 24);
        from.push(t.to_bits());
        point.entries(&mut |entry| from.push(entry.to_bits()));
        Self { from, ..self }
    }

    /// Time and point from which the integration started; `like` is any point of the model.
    pub(super) fn origin<const N: usize, P: Phase<N>>(&self, like: &P) -> (f64, P) {
        let mut numbers = self.from.iter().map(|bits| f64::from_bits(*bits));
        let t = numbers.next().unwrap_or(f64::NAN);
        (t, like.with_entries(&mut || numbers.next().unwrap_or(f64::NAN)))
    }

    /// A step is done with.
    pub(super) fn passed(&mut self, integrator: Vec<u64>, events: &[Memory]) {
        (self.integrator, self.met, self.recorded) = (integrator, 0, false);
        self.events = events.to_vec();
    }

    /// How large they have been.
    pub(super) fn largest_energy(&self) -> f64 {
        f64::from_bits(self.energy)
    }

    /// Notes how large kinetic and potential energy have been.
    pub(super) fn met_energy(&mut self, scale: f64) {
        self.energy = scale.to_bits();
    }

    /// The work before.
    pub(super) fn work(&self) -> f64 {
        f64::from_bits(self.work)
    }

    /// From when on another method took the motion because friction was stiff.
    pub(super) fn stiff_since(&self) -> Option<f64> {
        Some(f64::from_bits(self.stiff_since)).filter(|t| !t.is_nan())
    }

    /// The cost before.
    pub(super) fn cost(&self) -> Statistics {
        let [steps, rejected, evaluations, series, series_worth] = self.cost;
        Statistics { steps, rejected, evaluations, series, series_worth }
    }
}

/// A tape that is written, or read; what is missing of one that is read stays as it is.
pub(super) enum Bits<'t> {
    Written(Vec<u64>),
    Read(core::slice::Iter<'t, u64>),
}

impl Tape for Bits<'_> {
    fn bits(&mut self, bits: &mut u64) {
        match self {
            Bits::Written(tape) => tape.push(*bits),
            Bits::Read(tape) => *bits = tape.next().copied().unwrap_or(*bits),
        }
    }
}
