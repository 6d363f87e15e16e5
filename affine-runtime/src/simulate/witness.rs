//! The energy as a witness: a motion that has lost it is not the one that was asked for.

use super::energy::Energy;
use super::mechanics::Mechanics;
use crate::error::Reason;
use crate::inner::{larger, norm};
use crate::model::{Conserved, Description, Quantity};
use crate::state::Phase;

/// A run ends where the energy is off by so much of the largest `|T| + |U|` met.
const LOST: f64 = 0.1;
/// A run that conserves energy ends too where that is off by so much of `|T| + |U|`, both of what there is now and of what there
/// was at the start: near a singularity there is more, of which a tenth may be all that is left afterwards.
const SPENT: f64 = 0.5;
/// By less of the largest `|T| + |U|` met than this, or than [`RESOLVED`] tolerances if these are less, no energy is lost so: a
/// body may come to where it has hardly any.
const FAR: f64 = 0.01;
/// So many tolerances off, the energy is named in what is said of a run.
const WORTH_NAMING: f64 = 1e4;
/// No energy ends a run that an error of so many tolerances in the placement is worth: the energies of tiny vibrations, of
/// stiff ones that steps pass over, and of rounding. Nor is it named, unless so much is off that would end the run. Where the energy
/// is balanced by a work, each step may lose that: the work is integrated beside the motion, and goes on growing where the energy
/// does not.
const RESOLVED: f64 = 10.0;
/// Steps follow friction that takes velocities away no more than so often, by powers of e, within one of them, as explicit ones do.
/// What it takes within longer ones is known to the tolerance of the placement, beside which the energy of slow bodies is small.
const FOLLOWED: f64 = 6.4;
/// Nothing is said at all of one that a change of the placement by so much of itself is worth, at which the rounding of an energy may hide what is
/// quadratic in the change.
const ROUNDING: f64 = 1e-7;

/// The energy of a motion since its integration started.
#[derive(Clone, Copy, Debug)]
pub(super) struct Witness {
    /// `H - W` at the start; `None` where the energy is neither conserved nor balanced.
    before: Option<f64>,
    /// Largest `|T| + |U|` met.
    scale: f64,
    /// `|T| + |U|` at the start of a motion that conserves energy; infinite for others.
    first: f64,
    /// Largest `|H - W - before|` met, relative to the scale then, of those that are worth naming.
    worst: f64,
    tolerance: Option<f64>,
    /// Lengths of the last two steps, and how many there were.
    lengths: [f64; 2],
    steps: f64,
}

impl Witness {
    /// Of a motion that starts with an energy, less the work so far; `scale` is what was met before, and a method with a
    /// tolerance does not go on without its energy.
    pub(super) fn begin(
        model: &Description,
        (energy, work): (&Energy, f64),
        scale: f64,
        tolerance: Option<f64>,
    ) -> Self {
        let before = is_accounted_for(model).then_some(energy.value - work);
        let first = if is_conserved(model) { energy.size() } else { f64::INFINITY };
        Self {
            before,
            scale: larger(scale, energy.size()),
            first,
            worst: 0.0,
            tolerance,
            lengths: [0.0; 2],
            steps: 0.0,
        }
    }

    /// A step was taken.
    pub(super) fn stepped(&mut self, length: f64) {
        self.lengths = [length, self.lengths[0]];
        self.steps += 1.0;
    }

    /// About how long steps are: the last one may have been cut.
    fn step(&self) -> f64 {
        larger(self.lengths[0], 0.5 * self.lengths[1])
    }

    /// Largest `|T| + |U|` met.
    pub(super) fn scale(&self) -> f64 {
        self.scale
    }

    /// How far off the energy was at the most, relative to the scale; 0 where that is not worth naming.
    pub(super) fn worst(&self) -> f64 {
        self.worst
    }

    /// Is an energy, with the work so far, as near to that of the start as it has to be, however small what it is made of may be?
    pub(super) fn keeps(&self, energy: f64, work: f64) -> bool {
        let is_near = |before: f64| {
            let defect = (energy - work - before).abs();
            defect <= self.named() * self.scale && !self.is_spent(defect, 0.0)
        };
        energy.is_finite() && self.before.is_none_or(is_near)
    }

    /// The part of the scale up to which nothing is said.
    fn named(&self) -> f64 {
        self.tolerance.map_or(LOST, |tolerance| LOST.min(WORTH_NAMING * tolerance))
    }

    /// Is the energy off by half of what it is made of, now and at the start, and not because of the tolerance?
    fn is_spent(&self, defect: f64, now: f64) -> bool {
        let is_resolved = |tolerance: f64| defect > FAR.min(RESOLVED * tolerance) * self.scale;
        defect > SPENT * larger(self.first, now) && self.tolerance.is_some_and(is_resolved)
    }

    /// Looks at the energy of a point, with the work so far.
    ///
    /// # Errors
    /// [`Reason::Energy`] where it is not finite; [`Reason::EnergyLost`] where it is off by a tenth of the scale, or by half of what
    /// there was and is, and a tolerance is to be kept.
    pub(super) fn look<const N: usize, P: Phase<N>>(
        &mut self,
        model: &dyn Mechanics<N, P>,
        (t, point): (f64, &P),
        (at_point, work): (&Energy, f64),
    ) -> Result<(), Reason> {
        let energy = at_point.value;
        if !energy.is_finite() {
            return Err(Reason::Energy { energy, t });
        }
        let Some(before) = self.before else { return Ok(()) };
        self.scale = larger(self.scale, at_point.size());
        let defect = (energy - work - before).abs();
        let is_spent = self.is_spent(defect, at_point.size());
        if defect <= self.named() * self.scale && !is_spent {
            return Ok(());
        }
        let is_worth = |reach: f64| {
            let placed = worth(model, (t, point), energy, reach);
            let in_a_step = placed + self.worth_of_momenta(point, reach);
            defect <= if self.is_balanced() { self.steps * in_a_step } else { placed }
        };
        let is_lost = defect > LOST * self.scale || is_spent;
        let is_allowed =
            is_worth(self.tolerance.map_or(ROUNDING, |tolerance| ROUNDING.max(RESOLVED * tolerance)));
        if is_allowed && (!is_lost || is_worth(ROUNDING)) || self.passes_over_friction(model, (t, point)) {
            return Ok(());
        }
        self.worst = larger(self.worst, defect / self.scale);
        match self.tolerance.is_some() && is_lost && !is_allowed {
            true => Err(Reason::EnergyLost { defect, scale: self.scale, t }),
            false => Ok(()),
        }
    }

    /// What the energy changes by where the momenta are off by what moves the body by a part of its size within a step. Where forces
    /// set in on a body at rest, it has hardly any other energy at first.
    fn worth_of_momenta<const N: usize, P: Phase<N>>(&self, point: &P, reach: f64) -> f64 {
        let (placed, deformed) = (norm(point.x().as_slice()), norm(point.phi().as_slice()));
        let momenta =
            norm(point.pi().0.0.as_slice()) * deformed + norm(point.p().as_slice()) * (placed + deformed);
        let step = self.step();
        if step == 0.0 { 0.0 } else { reach * momenta / step }
    }

    /// The energy changes by a work, and is not conserved.
    fn is_balanced(&self) -> bool {
        self.first.is_infinite()
    }

    /// Are steps by a tolerance longer than what they follow of a friction?
    fn passes_over_friction<const N: usize, P: Phase<N>>(
        &self,
        model: &dyn Mechanics<N, P>,
        (t, point): (f64, &P),
    ) -> bool {
        let is_passed_over = |rate: f64| rate * self.step() > FOLLOWED;
        self.tolerance.is_some() && model.rate_of_friction(t, point).is_some_and(is_passed_over)
    }
}

/// The largest change of the energy by a change of one entry of `phi` by `reach |phi|`, or of `x` by `reach (|x| + |phi|)`, either
/// way; infinite where an energy there is not finite.
fn worth<const N: usize, P: Phase<N>>(
    model: &dyn Mechanics<N, P>,
    (t, point): (f64, &P),
    energy: f64,
    reach: f64,
) -> f64 {
    let (placed, deformed) = (norm(point.x().as_slice()), norm(point.phi().as_slice()));
    let mut largest = 0.0;
    let mut look = |x, phi| {
        let changed = (model.hamiltonian(t, &point.moved(x, phi, |spin| *spin)) - energy).abs();
        largest = larger(largest, if changed.is_nan() { f64::INFINITY } else { changed });
    };
    for way in [reach, -reach] {
        for entry in 0..N * N {
            let mut phi = *point.phi();
            phi[(entry / N, entry % N)] += way * deformed;
            look(point.x(), phi);
        }
        for i in 0..N {
            let mut x = point.x();
            x[i] += way * (placed + deformed);
            look(x, *point.phi());
        }
    }
    largest
}

fn is_conserved(model: &Description) -> bool {
    model.conserved.contains(&Conserved::Energy)
}

/// The energy is conserved, or changes by a work that is integrated with the motion.
fn is_accounted_for(model: &Description) -> bool {
    is_conserved(model) || model.reduced.iter().any(|group| group.quantity == Quantity::Work)
}
