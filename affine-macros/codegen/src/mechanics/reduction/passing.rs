//! The way from a phase point to the state of a reduction, and back: each step adds what it takes out.

use crate::algebra::Arena;
use crate::algebra::passage::{Constant, Extent, MatrixFunction, Passage, Statement, Tensor, Word};
use crate::algebra::ring::table;
use crate::mechanics::charts::{Linear, Momentum};
use crate::symbol::{Quantity, Symbol};

use super::drift::Drift;
use super::turn::Turn;
use super::{Commuting, Reduction, dilatation};

impl Reduction {
    /// The way of its states.
    pub fn passage(&self, arena: &Arena) -> Passage {
        let mut passage = Passage::default();
        let Commuting { rotation, drift } = &self.commuting;
        if rotation.is_some() || drift.is_some() {
            passage.constants.push(Constant::new(Word::Start, Extent::Number, "Time of the start."));
        }
        self.momenta(&mut passage);
        if self.turn.is_some() {
            Turn::pass(&self.chart, &self.conserved, &mut passage);
        }
        if self.keeps_linear_momentum() {
            let p = Constant::new(Word::LinearMomentum, Extent::Vector, "Linear momentum `p`.");
            passage.constants.push(p);
        }
        let fixed = self.conserved.fixed(arena);
        match &self.dilatation {
            Some(motion) => dilatation::pass(motion, self.chart.dim, &fixed, &mut passage),
            None => self.placement(&mut passage),
        }
        let elapsed = Tensor::Time.minus(Tensor::Constant(Word::Start));
        let moves = rotation.is_some() || drift.is_some();
        passage.outward.extend(moves.then_some(Statement::Named(Word::Elapsed, elapsed)));
        if drift.is_some() {
            Drift::pass(&mut passage);
        }
        self.centre(arena, &mut passage);
        if self.dilatation.is_none() {
            self.affine_momentum(arena, &fixed, &mut passage);
        }
        passage.constants.extend(self.conserved.constants(arena));
        self.momentum_of_point(&mut passage);
        if let Some(rotation) = rotation {
            rotation.pass(&self.chart, &mut passage);
        }
        passage
    }

    /// Is `p` a quantity of the state?
    fn pushes(&self) -> bool {
        self.chart
            .linear
            .is_some_and(|linear| self.states.iter().any(|(group, _)| *group == linear.quantity()))
    }

    /// Is `p` a constant?
    fn keeps_linear_momentum(&self) -> bool {
        (self.chart.linear.is_some() || self.commuting.drift.is_some()) && !self.pushes()
    }

    /// The momenta of the chart at the phase point.
    fn momenta(&self, passage: &mut Passage) {
        if self.keeps_linear_momentum() || self.pushes() && self.chart.linear == Some(Linear::Space) {
            let p = Tensor::OfPoint(Quantity::LinearMomentum);
            passage.inward.push(Statement::Named(Word::LinearMomentum, p));
        }
        let momentum = match self.chart.momentum {
            Momentum::Total => {
                Tensor::OfPoint(Quantity::TotalAffineMomentum).under(MatrixFunction::Projected)
            }
            other => Tensor::OfPoint(other.quantity()),
        };
        passage.inward.push(Statement::Named(Word::Momentum, momentum));
    }

    /// A quantity as the state has it, in turned space.
    fn turned(&self, quantity: Quantity, value: Tensor) -> Tensor {
        if self.turn.is_some() { Turn::turned(quantity, value) } else { value }
    }

    /// And back.
    fn turned_back(&self, quantity: Quantity, value: Tensor) -> Tensor {
        if self.turn.is_some() { Turn::turned_back(quantity, value) } else { value }
    }

    /// The placement, and what follows from it.
    fn placement(&self, passage: &mut Passage) {
        let entries = entries(Quantity::Placement, self.chart.dim);
        let of_point = || Tensor::OfPoint(Quantity::Placement);
        let turned = self.turned(Quantity::Placement, of_point());
        passage.inward.push(Statement::Entries(entries.clone(), turned));
        passage.inward.extend(self.carried.iter().map(|carried| carried.at(of_point())));
        let of_state = Tensor::Matrix(entries);
        if !self.carried.is_empty() {
            passage.renewed.push(Statement::Named(Word::Placement, of_state.clone()));
            let variable = || Tensor::Variable(Word::Placement);
            passage.renewed.extend(self.carried.iter().map(|carried| carried.at(variable())));
        }
        let back = self.turned_back(Quantity::Placement, of_state);
        passage.outward.push(Statement::Named(Word::Placement, back));
    }

    /// The centre of mass.
    fn centre(&self, arena: &Arena, passage: &mut Passage) {
        let [x, p] = [Word::Position, Word::LinearMomentum].map(Tensor::Variable);
        let Some(linear) = self.chart.linear else {
            let rests = self.commuting.drift.is_some();
            passage.centre = rests.then_some([x, Tensor::Constant(Word::LinearMomentum)]);
            return;
        };
        let quantity = linear.quantity();
        let [positions, momenta] = [&self.chart.x, &self.chart.p].map(|of| arena.symbols_of(of));
        let position = self.turned(Quantity::Position, Tensor::OfPoint(Quantity::Position));
        let momentum = match linear {
            Linear::Body => Tensor::OfPoint(Quantity::ComovingLinearMomentum),
            Linear::Space => self.turned(quantity, p.clone()),
        };
        passage.inward.extend([
            Statement::Components(positions.clone(), position),
            Statement::Components(momenta.clone(), momentum),
        ]);
        let place = self.turned_back(Quantity::Position, Tensor::Vector(positions));
        passage.outward.push(Statement::Named(Word::Position, place));
        if self.pushes() {
            let momentum = match linear {
                Linear::Space => Tensor::Vector(momenta),
                Linear::Body => {
                    let inverse = Tensor::Variable(Word::Placement).under(MatrixFunction::Inverse);
                    inverse.transposed_times(Tensor::Vector(momenta))
                }
            };
            passage.outward.push(Statement::Named(Word::LinearMomentum, momentum));
        }
        let p = if self.pushes() { p } else { Tensor::Constant(Word::LinearMomentum) };
        passage.centre = Some([x, p]);
    }

    /// The affine momentum of the chart.
    fn affine_momentum(&self, arena: &Arena, fixed: &[Symbol], passage: &mut Passage) {
        let quantity = self.chart.momentum.quantity();
        let entries: Vec<Vec<Symbol>> = self.chart.m.0.iter().map(|row| arena.symbols_of(row)).collect();
        let turned = self.turned(quantity, Tensor::Variable(Word::Momentum));
        passage.inward.push(Statement::Entries(entries.clone(), turned));
        let back = match self.conserved.affine {
            true => Tensor::Constant(Word::Momentum),
            false => {
                let constants = Tensor::Constant(Word::Fixed);
                let some = !fixed.is_empty();
                passage.outward.extend(some.then(|| Statement::Listed(fixed.to_vec(), constants)));
                passage.outward.push(Statement::Dependent);
                self.turned_back(quantity, Tensor::Matrix(entries))
            }
        };
        passage.outward.push(Statement::Named(Word::Momentum, back));
    }

    /// The affine momentum of the phase point.
    fn momentum_of_point(&self, passage: &mut Passage) {
        let momentum = Tensor::Variable(Word::Momentum);
        passage.momentum = Some(match (self.chart.momentum, &passage.centre) {
            (Momentum::Total, Some([x, p])) => {
                let spin = momentum.minus(x.clone().times(p.clone().transposed()));
                (Quantity::AffineSpin, spin.under(MatrixFunction::Projected))
            }
            (chart, _) => (chart.quantity(), momentum),
        });
    }
}

fn entries(of: Quantity, n: usize) -> Vec<Vec<Symbol>> {
    table(n, |i, a| of.at([i + 1, a + 1]))
}
