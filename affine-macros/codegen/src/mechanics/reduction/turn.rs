//! Space turned so that a conserved `p` lies along the first axis, and `I(O)_13 = 0` where `I(O)` is conserved.

use crate::algebra::Expr;
use crate::algebra::passage::{Constant, Extent, MatrixFunction, Passage, Statement, Tensor, Word};
use crate::mechanics::charts::{Chart, Linear, Momentum};
use crate::symbol::Quantity;

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

    /// The rotation is kept.
    pub(super) fn pass(chart: &Chart, conserved: &Conserved, passage: &mut Passage) {
        let [p, momentum] = [Word::LinearMomentum, Word::Momentum].map(Tensor::Variable);
        let turn = match chart.momentum == Momentum::Total && conserved.affine {
            true => Tensor::Applied(MatrixFunction::TurnOfBoth, vec![p, momentum]),
            false => p.under(MatrixFunction::Turn),
        };
        passage.inward.push(Statement::Named(Word::Turn, turn));
        let meaning = "Turns space so that `p` lies along the first axis.";
        passage.constants.push(Constant::new(Word::Turn, Extent::Matrix, meaning));
    }

    /// A quantity in turned space.
    pub(super) fn turned(quantity: Quantity, value: Tensor) -> Tensor {
        let turn = || Tensor::Variable(Word::Turn);
        match quantity {
            Quantity::ComovingAffineSpin => value,
            Quantity::CanonicalMomentum => value.times(turn().transposed()),
            Quantity::AffineSpin | Quantity::TotalAffineMomentum => {
                turn().times(value).times(turn().transposed())
            }
            _ => turn().times(value),
        }
    }

    /// And back.
    pub(super) fn turned_back(quantity: Quantity, value: Tensor) -> Tensor {
        let turn = || Tensor::Constant(Word::Turn);
        match quantity {
            Quantity::ComovingAffineSpin => value,
            Quantity::CanonicalMomentum => value.times(turn()),
            Quantity::AffineSpin | Quantity::TotalAffineMomentum => {
                turn().transposed_times(value).times(turn())
            }
            _ => turn().transposed_times(value),
        }
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
