//! What a motion conserves, as it is listed.

use crate::algebra::Arena;
use crate::mechanics::conserved::{Candidate, Conservation, Entry};
use crate::mechanics::describe::{Notation, component};
use crate::mechanics::metrics::Metrics;

/// What a motion conserves.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Conserved {
    /// Momenta, and functions of them, as a whole.
    pub whole: Vec<Candidate>,
    /// Sums of entries of momenta of which not all are conserved.
    pub components: Vec<Component>,
}

/// A sum of multiples of entries of momenta.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Component {
    /// The formula: `Vort_12`.
    pub symbol: String,
    /// The multiples of entries of momenta whose sum it is.
    pub entries: Vec<Entry>,
}

impl Conserved {
    /// What stays under everything that was looked at.
    pub(super) fn of(
        arena: &mut Arena,
        notation: &Notation,
        metrics: Option<&Metrics>,
        conservation: &Conservation,
    ) -> Self {
        let bases = match metrics {
            Some(Metrics::Known(bases)) => Some(bases),
            Some(Metrics::Given(_)) | None => None,
        };
        let components = conservation.components(arena, bases).into_iter();
        let components = components
            .map(|entries| Component { symbol: component(arena, notation, &entries), entries })
            .collect();
        Self { whole: conservation.whole.clone(), components }
    }
}
