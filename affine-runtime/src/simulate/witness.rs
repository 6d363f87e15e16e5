//! The energy as a witness: a motion that has lost it is not the one that was asked for.

use super::halt::Reason;
use super::mechanics::Mechanics;
use super::point::energy_bound;
use crate::integrate::larger;
use crate::model::{Conserved, Description, WORK};
use crate::state::Phase;

/// A run ends where the energy is off by so much of the largest `|T| + |U|` met. What errors of a step may add up to over the
/// longest of loose runs stays below.
pub(super) const LOST: f64 = 0.1;
/// So many tolerances off, the energy is named in what is said of a run.
pub(super) const WORTH_NAMING: f64 = 1e4;

/// The energy of a motion since its integration started.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Witness {
    /// `H - W` at the start; `None` where the energy is neither conserved nor balanced.
    before: Option<f64>,
    /// Largest `|T| + |U|` met.
    scale: f64,
    /// Largest `|H - W - before|` met, relative to the scale then.
    worst: f64,
    /// The method has a tolerance, and is not to go on without its energy.
    is_held: bool,
}

impl Witness {
    /// Of a motion that starts with an energy, less the work so far; `scale` is what was met before.
    pub(super) fn begin<const N: usize, P: Phase<N>>(
        model: &dyn Mechanics<N, P>,
        (energy, work): (f64, f64),
        (point, scale): (&P, f64),
        is_held: bool,
    ) -> Self {
        let before = is_accounted_for(model.description()).then_some(energy - work);
        let scale = larger(scale, size(model, point, energy));
        Self { before, scale, worst: 0.0, is_held }
    }

    /// Largest `|T| + |U|` met.
    pub(super) fn scale(&self) -> f64 {
        self.scale
    }

    /// How far off the energy was at the most, relative to the scale.
    pub(super) fn worst(&self) -> f64 {
        self.worst
    }

    /// Looks at the energy of a point, with the work so far.
    ///
    /// # Errors
    /// [`Reason::Energy`] where it is not finite; [`Reason::EnergyLost`] where it is off by a tenth of the scale, and a tolerance
    /// is to be kept.
    pub(super) fn look<const N: usize, P: Phase<N>>(
        &mut self,
        model: &dyn Mechanics<N, P>,
        (t, point): (f64, &P),
        (energy, work): (f64, f64),
    ) -> Result<(), Reason> {
        if !energy.is_finite() {
            return Err(Reason::Energy { energy, t });
        }
        let Some(before) = self.before else { return Ok(()) };
        self.scale = larger(self.scale, size(model, point, energy));
        let defect = (energy - work - before).abs();
        if defect == 0.0 {
            return Ok(());
        }
        self.worst = larger(self.worst, defect / self.scale);
        match self.is_held && defect > LOST * self.scale {
            true => Err(Reason::EnergyLost { defect, scale: self.scale, t }),
            false => Ok(()),
        }
    }
}

/// The energy is conserved, or changes by a work that is integrated with the motion.
fn is_accounted_for(model: &Description) -> bool {
    model.conserved.contains(&Conserved::Energy) || model.reduced.iter().any(|group| group.name == WORK)
}

/// `|T| + |U|`, with a bound of `|T|` that an indefinite kinetic energy has too.
fn size<const N: usize, P: Phase<N>>(model: &dyn Mechanics<N, P>, point: &P, energy: f64) -> f64 {
    let (bound, kinetic) = energy_bound(model, point);
    bound + (energy - kinetic).abs()
}
