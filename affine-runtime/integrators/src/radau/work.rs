//! The work of forces along a step, at nodes that are not those of its stages.

use crate::gauss;
use affine_core::model::{Group, Quantity, StateVector};

/// How the work of a step is integrated: by Gauss quadrature over the collocation polynomial, of a degree above that of the
/// stages. The stages close their own balance of energy, whatever motion they solve; other nodes do not.
#[derive(Clone, Copy, Debug)]
pub(super) struct Work {
    /// Its component in the state.
    pub(super) place: usize,
    quadrature: &'static gauss::Tableau,
}

impl Work {
    /// `None` where a state has no work.
    pub(super) fn of(groups: &[Group], stages: usize) -> Option<Self> {
        let at = groups.iter().position(|group| group.quantity == Quantity::Work)?;
        let place = groups[..at].iter().map(|group| group.len).sum();
        let quadrature = if stages < 4 { &gauss::Tableau::FOUR } else { &gauss::Tableau::SIX };
        Some(Self { place, quadrature })
    }

    /// Evaluations that it takes.
    pub(super) fn evaluations(&self) -> u64 {
        self.quadrature.stages() as u64
    }

    /// The work from a time over an interval, where `rates` are those of all components.
    pub(super) fn along<S: StateVector<f64>>(&self, from: f64, length: f64, rates: impl Fn(f64) -> S) -> f64 {
        let nodes = self.quadrature.quadrature();
        length
            * nodes
                .map(|(node, weight)| weight * rates(from + node * length).as_ref()[self.place])
                .sum::<f64>()
    }
}
