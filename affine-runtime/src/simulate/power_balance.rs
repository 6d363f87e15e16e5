//! Energy against the work of the forces that no potential has.

use core::fmt;

use super::trajectory::Trajectory;
use crate::inner::larger;
use crate::model::Quantity;
use crate::state::Phase;

/// The balance `H(t) - H(t0) = W(t)`, `W` the integral of the power over time, along a trajectory.
///
/// The power of a dissipation function `R` is `-2 R` (Goldstein, *Classical Mechanics*, section 1.5); a potential
/// that contains the time has the power `dU/dt` at rest. `W` is
/// integrated with the motion, as one more variable that the steps do not depend on: the balance closes about as well as velocities
/// are known. Where friction is stiff these are small beside the forces, and known less well than the placement is: the defect can
/// be many tolerances of a motion that is right, and grows with the time. What an event that changes the point gives or takes is
/// not part of `W`, and stays in the defect.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PowerBalance {
    /// `H(t_end) - H(t0)`.
    #[cfg_attr(feature = "serde", serde(with = "crate::inner::number"))]
    pub energy: f64,
    /// `W(t_end)`.
    #[cfg_attr(feature = "serde", serde(with = "crate::inner::number"))]
    pub work: f64,
    /// Largest `|H(t) - H(t0) - W(t)|` over the outputs and the end.
    #[cfg_attr(feature = "serde", serde(with = "crate::inner::number"))]
    pub defect: f64,
    /// The size it is held against: the largest of `|H|` and `(|Pi| |phi_dot| + |p| |x_dot|)/2`.
    #[cfg_attr(feature = "serde", serde(with = "crate::inner::number"))]
    pub scale: f64,
}

impl PowerBalance {
    /// `defect / scale`; 0 where the balance is exact.
    #[must_use]
    pub fn relative(&self) -> f64 {
        if self.defect == 0.0 { 0.0 } else { self.defect / self.scale }
    }
}

impl<const N: usize, P: Phase<N>> Trajectory<N, P> {
    /// The balance of energy and work; `None` for a model without forces other than those of a potential at rest, whose
    /// energy stands among what [`conservation`](Self::conservation) lists.
    #[must_use]
    pub fn power_balance(&self) -> Option<PowerBalance> {
        self.description.reduced.iter().find(|group| group.quantity == Quantity::Work)?;
        let energies = &self.energies;
        let points = energies.outputs.iter().zip(&energies.work);
        let end = (&energies.end, &energies.work_at_end);
        let defects = points.chain([end]).map(|(energy, work)| (energy - energies.start - work).abs());
        Some(PowerBalance {
            energy: energies.end - energies.start,
            work: energies.work_at_end,
            defect: defects.fold(0.0, larger),
            scale: energies.scale,
        })
    }

    /// The work of the forces that no potential has, from the start to each output.
    #[must_use]
    pub fn work(&self) -> &[f64] {
        &self.energies.work
    }
}

impl fmt::Display for PowerBalance {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "H changed by {:.6e}, the work of the forces is {:.6e}: defect {:.2e}, relative {:.2e}",
            self.energy,
            self.work,
            self.defect,
            self.relative()
        )
    }
}
