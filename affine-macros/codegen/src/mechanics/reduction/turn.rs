//! Space turned so that a conserved `p` lies along the first axis, and `I(O)_13 = 0` where `I(O)` is conserved.

use crate::algebra::{Expr, Polynomial};
use crate::mechanics::charts::{Chart, Linear, Momentum};
use crate::mechanics::equations::System;

use super::conserved::Conserved;
use super::left_out::{LeftOut, Scope};

/// Space turned where its rotations leave `H` unchanged.
#[derive(Clone, Debug)]
pub struct Turn {
    /// Components that vanish.
    pub vanishing: Vec<Expr>,
}

impl Turn {
    /// That of a chart with a conserved `p`.
    pub(super) fn of(chart: &Chart, conserved: &Conserved) -> Option<Self> {
        let across = chart.p.iter().skip(1).copied();
        let of_total = conserved.affine && chart.momentum == Momentum::Total && chart.dim == 3;
        let vanishing = across.chain(of_total.then(|| chart.m.0[0][2])).collect();
        (conserved.linear && chart.linear == Some(Linear::Space)).then_some(Self { vanishing })
    }

    /// A system without what vanishes.
    pub(super) fn taken(&self, system: &System) -> System {
        system.substitute(&|atom| self.vanishing.contains(&atom).then(Polynomial::zero))
    }

    pub(super) fn left_out() -> LeftOut {
        Scope::Reduction.without("p: conserved; space is turned so that only its first component is left")
    }
}

#[cfg(test)]
#[allow(clippy::expect_used)]
mod tests {
    use super::*;
    use crate::algebra::Arena;

    /// Turning space makes an entry of `I(O)` vanish, and none of a momentum of another chart.
    #[test]
    fn the_gauge_is_that_of_the_total_momentum() {
        let mut arena = Arena::new();
        let mut entries = |momentum, dim, affine| {
            let chart = Chart::new(&mut arena, dim, momentum, Some(Linear::Space));
            let conserved = Conserved { linear: true, affine, components: Vec::new() };
            let turn = Turn::of(&chart, &conserved).expect("p is conserved");
            turn.vanishing.into_iter().filter(|zero| !chart.p.contains(zero)).count()
        };
        for momentum in [Momentum::Body, Momentum::Space, Momentum::Canonical] {
            assert_eq!(entries(momentum, 3, true), 0);
        }
        assert_eq!(entries(Momentum::Total, 3, true), 1);
        assert_eq!(entries(Momentum::Total, 3, false), 0);
        assert_eq!(entries(Momentum::Total, 2, true), 0);
    }
}
