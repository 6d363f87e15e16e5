//! Systems component by component.

use rustc_hash::FxHashSet;

use super::{Notation, Sentence};
use crate::algebra::definitions::used;
use crate::algebra::kernel::Callee;
use crate::algebra::{Arena, Expr, Polynomial};
use crate::mechanics::charts::Coordinate;
use crate::mechanics::equations::System;
use crate::mechanics::notation::{letters, product, rate};

/// A quantity of a system and what it is, or its rate.
struct Line {
    symbol: Expr,
    value: Polynomial,
    is_rate: bool,
}

/// Shared quantities and rates of a system, component by component; what is a rate itself is written there.
pub fn system(arena: &mut Arena, notation: &Notation, system: &System) -> Vec<Sentence> {
    let is_rate = |s: Expr| {
        let is_it = |rate: &Polynomial| *rate == Polynomial::atom(s);
        let of = system.rates.iter().find(|(.., rate)| is_it(rate)).map(|(z, ..)| *z);
        // A velocity is the rate of a place by its name; of anything else the name may be needed.
        let uses = system.mentions(arena, s);
        of.is_some_and(|z| matches!(z, Coordinate::X(_) | Coordinate::Phi(..)) || uses == 1)
    };
    let (rates, shared): (Vec<_>, Vec<_>) = system.shared.iter().partition(|(s, _)| is_rate(*s));
    let value = |rate: &Polynomial| {
        let found = rates.iter().find(|(s, _)| *rate == Polynomial::atom(*s));
        found.map_or_else(|| rate.clone(), |(_, value)| value.clone())
    };
    let line = |symbol: Expr, value: Polynomial, is_rate: bool| Line { symbol, value, is_rate };
    let shared = shared.into_iter().map(|(s, p)| line(*s, p.clone(), false));
    let rates = system.rates.iter().map(|(_, s, p)| line(*s, value(p), true));
    let work = system.work.iter().map(|(s, p)| line(*s, p.clone(), true));
    let lines = shown(arena, notation, shared.chain(rates).chain(work).collect());
    let mut list = notation.definitions(arena, lines.iter().map(|line| &line.value));
    if system.kernels.iter().any(|kernel| matches!(kernel.callee, Callee::Stretches | Callee::LogStretches)) {
        list.push(principal_axes());
    }
    list.extend(lines.iter().map(|line| line.sentence(arena, notation)));
    list
}

/// The lines that formulas show: what has no name of its own is written where it stands, and of a quantity that is known
/// its powers are too.
fn shown(arena: &mut Arena, notation: &Notation, lines: Vec<Line>) -> Vec<Line> {
    let (hidden, mut lines): (Vec<Line>, Vec<Line>) =
        lines.into_iter().partition(|line| notation.is_written_out(arena, line.symbol));
    for line in hidden.iter().rev() {
        let value = |atom: Expr| (atom == line.symbol).then(|| line.value.clone());
        lines.iter_mut().for_each(|other| other.value = other.value.substitute(&value));
    }
    let mut known: FxHashSet<Expr> =
        lines.iter().filter(|line| line.is_rate).map(|line| notation.base(arena, line.symbol)).collect();
    lines.retain(|line| line.is_rate || known.insert(notation.base(arena, line.symbol)));
    loop {
        let used = used(arena, lines.iter().map(|line| &line.value)).into_iter();
        let used: FxHashSet<Expr> = used.map(|symbol| notation.base(arena, symbol)).collect();
        let count = lines.len();
        lines.retain(|line| line.is_rate || used.contains(&notation.base(arena, line.symbol)));
        if lines.len() == count {
            return lines;
        }
    }
}

impl Line {
    fn sentence(&self, arena: &mut Arena, notation: &Notation) -> Sentence {
        let (base, exponent) = notation.power(arena, self.symbol);
        let value = self.value.expression(arena);
        let (left, value) = match (self.is_rate, exponent) {
            // 1/D = 1/x says that D = x; a definition is not zero.
            (false, -1) => (base, arena.reciprocal(value)),
            _ => (self.symbol, value),
        };
        let left = notation.scalar(arena, left);
        notation.scalar(arena, value).of(match (self.is_rate, exponent) {
            (false, _) => left,
            (true, 1) => rate(left),
            (true, _) => Sentence::RateOfAll(Box::new(left)),
        })
    }
}

/// What the stretches and the principal axes are: `G e_a = Q_a^2 e_a, |e_a| = 1, f_a = phi e_a`.
fn principal_axes() -> Sentence {
    let (axis, stretch) = (|| Sentence::from(letters::PRINCIPAL_AXIS), Sentence::from(letters::STRETCH));
    let length = Sentence::Length(Box::new(axis()));
    product([stretch.power(2), axis()]).of(product([letters::GREEN.into(), axis()])).with(vec![
        Sentence::One.of(length),
        product([letters::PLACEMENT.into(), axis()]).of(letters::STRETCHED_AXIS),
    ])
}
