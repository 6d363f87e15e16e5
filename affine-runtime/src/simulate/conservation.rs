//! How well a trajectory keeps what its model conserves.

use core::fmt;

use super::event::Word;
use super::power_balance::PowerBalance;
use super::trajectory::Trajectory;
use crate::conserved::Components;
use crate::inner::larger;
use crate::model::Conserved;
use crate::state::Phase;

/// Drifts of all conserved quantities over the outputs of a trajectory; displays as a table, with the balance of
/// energy where forces change it.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Conservation {
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::inner::word"))]
    model: Word,
    drifts: Vec<Drift>,
    balance: Option<PowerBalance>,
}

/// Drift of one quantity `Q`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Drift {
    /// The quantity.
    pub quantity: Conserved,
    /// Largest `|Q(t) - Q(t0)|` over the outputs and the end.
    #[cfg_attr(feature = "serde", serde(with = "crate::inner::number"))]
    pub absolute: f64,
    /// The size it is held against: the largest, over the same points, of what the quantity is made of (see
    /// [`Conserved::scale`]); for the energy, of `|H|` and `(|Pi| |phi_dot| + |p| |x_dot|)/2`.
    #[cfg_attr(feature = "serde", serde(with = "crate::inner::number"))]
    pub scale: f64,
}

impl Drift {
    /// `absolute / scale`; 0 where nothing drifts.
    #[must_use]
    pub fn relative(&self) -> f64 {
        if self.absolute == 0.0 { 0.0 } else { self.absolute / self.scale }
    }
}

impl Conservation {
    /// One row per quantity.
    #[must_use]
    pub fn drifts(&self) -> &[Drift] {
        &self.drifts
    }

    /// The balance of energy and work, where there are forces that no potential has.
    #[must_use]
    pub fn balance(&self) -> Option<&PowerBalance> {
        self.balance.as_ref()
    }

    /// The row of a quantity, if this motion conserves it.
    #[must_use]
    pub fn of(&self, quantity: Conserved) -> Option<&Drift> {
        self.drifts.iter().find(|drift| drift.quantity == quantity)
    }

    /// The largest relative drift; NaN where one is.
    #[must_use]
    pub fn worst(&self) -> f64 {
        self.drifts.iter().map(Drift::relative).fold(0.0, larger)
    }
}

impl<const N: usize, P: Phase<N>> Trajectory<N, P> {
    /// What the model conserves in this motion.
    pub(super) fn quantities(&self) -> &'static [Conserved] {
        match self.computation.at_rest {
            true => self.description.conserved_at_rest,
            false => self.description.conserved,
        }
    }

    /// Drift of every quantity that the model conserves, or conserves while `p = 0` where the start is at rest.
    #[must_use]
    pub fn conservation(&self) -> Conservation {
        let quantities = self.quantities();
        let drift = |&quantity: &Conserved| self.drift(quantity);
        Conservation {
            model: self.description.name,
            drifts: quantities.iter().map(drift).collect(),
            balance: self.power_balance(),
        }
    }

    /// The drift of one of the quantities of [`conservation`](Self::conservation) at each output,
    /// `|Q(t) - Q(t0)|` relative to its scale.
    #[must_use]
    pub fn relative_drifts(&self, Drift { quantity, scale, .. }: &Drift) -> Vec<f64> {
        let relative = |absolute: f64| if absolute == 0.0 { 0.0 } else { absolute / scale };
        let Some(at_start) = self.value(*quantity, &self.start.1) else {
            let distance = |energy: &f64| (energy - self.energies.start).abs();
            return self.energies.outputs.iter().map(distance).map(relative).collect();
        };
        let distance =
            |point: &P| self.value(*quantity, point).map_or(0.0, |value| value.distance(&at_start));
        self.points.iter().map(distance).map(relative).collect()
    }

    /// A quantity where its norm is that of the metrics; a sum of entries stands in the bases of the points.
    pub(super) fn value(&self, quantity: Conserved, point: &P) -> Option<Components> {
        match quantity {
            Conserved::Component(_) => quantity.of(point, self.bases.as_deref()),
            _ => quantity.of(&self.orthonormal(point), None),
        }
    }

    fn scale(&self, quantity: Conserved, point: &P) -> Option<f64> {
        match quantity {
            Conserved::Component(_) => quantity.scale(point, self.bases.as_deref()),
            _ => quantity.scale(&self.orthonormal(point), None),
        }
    }

    /// A phase point of the trajectory in bases in which the model's metrics are the identity, as
    /// [`Model::orthonormal`](crate::Model::orthonormal) gives it.
    #[must_use]
    pub fn orthonormal(&self, point: &P) -> P::InOrthonormal {
        point.in_orthonormal(self.bases.as_deref())
    }

    fn drift(&self, quantity: Conserved) -> Drift {
        let mut drift = Drift { quantity, absolute: 0.0, scale: 0.0 };
        let Some(at_start) = self.value(quantity, &self.start.1) else {
            drift.scale = self.energies.scale;
            for energy in self.energies.outputs.iter().chain([&self.energies.end]) {
                drift.absolute = larger(drift.absolute, (energy - self.energies.start).abs());
            }
            return drift;
        };
        for point in self.points.iter().chain([&self.start.1, &self.end.1]) {
            let distance = self.value(quantity, point).map_or(0.0, |value| value.distance(&at_start));
            drift.absolute = larger(drift.absolute, distance);
            drift.scale = larger(drift.scale, self.scale(quantity, point).unwrap_or(0.0));
        }
        drift
    }
}

impl fmt::Display for Conservation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}: drift of conserved quantities", self.model)?;
        let width = self.drifts.iter().map(|d| d.quantity.symbol().len()).max().unwrap_or(0).max(8);
        writeln!(f, "{:width$}  {:>9}  {:>9}  {:>9}", "quantity", "relative", "absolute", "scale")?;
        for drift in &self.drifts {
            writeln!(
                f,
                "{:width$}  {:>9.2e}  {:>9.2e}  {:>9.2e}",
                drift.quantity.symbol(),
                drift.relative(),
                drift.absolute,
                drift.scale
            )?;
        }
        if let Some(balance) = &self.balance {
            writeln!(f, "{balance}")?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Wherever it stands, a drift that is no number is the worst.
    #[test]
    fn a_drift_that_is_no_number_is_not_passed_over() {
        let row = |quantity, absolute| Drift { quantity, absolute, scale: 1.0 };
        let worst = |absolute: [f64; 3]| {
            let quantities = [Conserved::Energy, Conserved::Spin, Conserved::Vorticity];
            let drifts =
                quantities.into_iter().zip(absolute).map(|(quantity, absolute)| row(quantity, absolute));
            Conservation { model: "Body", drifts: drifts.collect(), balance: None }.worst()
        };
        assert_eq!(worst([1e-3, 0.0, 1e-9]), 1e-3);
        assert!(worst([f64::NAN, 1e-9, 1e-16]).is_nan());
        assert!(worst([1e-9, f64::NAN, 1e-16]).is_nan());
        assert!(worst([1e-9, 1e-16, f64::NAN]).is_nan());
    }
}
