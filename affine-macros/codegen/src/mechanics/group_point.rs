//! Points of `GL(n)` and of the constraint groups modulo a prime: what holds on a group need not hold as a polynomial identity,
//! and an identity need not be multiplied out to be seen.
//!
//! A rational function that does not vanish on the group vanishes at a random point of it with a chance of its degree
//! over `2^61` (Schwartz, J. ACM 27 (1980) 701; the groups are rational varieties), at [`POINTS`] points with that to
//! the power [`POINTS`].

use std::cell::RefCell;
use std::fmt::Display;

use rustc_hash::FxHashMap;

use crate::algebra::evaluate::{Field, evaluate};
use crate::algebra::fault::never_missing;
use crate::algebra::residue::Residue;
use crate::algebra::ring::{
    Ring, Square, adjugate, determinant, difference, multiple, product, scalar, sum, table,
};
use crate::algebra::{Arena, Expr, Matrix, Polynomial, Rational};
use crate::symbol::{Quantity, Symbol};

use super::charts::Chart;
use super::constraint::Constraint;
use super::metric::Definitions;

/// Number of points that decide.
pub(super) const POINTS: usize = 3;

/// Values of the placement, of a projected momentum and of `exp(q)`; of every other name one that depends on it alone.
#[derive(Clone)]
pub(super) struct GroupPoint {
    seed: usize,
    values: FxHashMap<Symbol, Residue>,
    /// Of symbols that were asked for: polynomials name them many times.
    known: RefCell<FxHashMap<Expr, Residue>>,
}

impl GroupPoint {
    /// The points that decide about a chart of a motion, on the group of its constraint where it has one.
    pub(super) fn all(arena: &Arena, chart: &Chart, group: Option<Constraint>) -> Vec<Self> {
        (0..POINTS).map(|seed| Self::numbered(arena, chart, group, seed)).collect()
    }

    /// The point of this number.
    pub(super) fn numbered(arena: &Arena, chart: &Chart, group: Option<Constraint>, seed: usize) -> Self {
        let mut point = Self { seed, values: FxHashMap::default(), known: RefCell::default() };
        let scale = match group {
            None | Some(Constraint::Conformal) => point.random("scale"),
            Some(Constraint::Isochoric | Constraint::Rigid) => Residue::from_rational(&Rational::ONE),
        };
        let phi = match group {
            // det phi = D^n
            None => {
                let mut phi = unimodular(&point.sample(arena, &chart.phi));
                let det = (1..chart.dim).fold(scale, |power, _| power.mul(&scale));
                phi[0].iter_mut().for_each(|entry| *entry = entry.mul(&det));
                phi
            }
            Some(Constraint::Isochoric) => unimodular(&point.sample(arena, &chart.phi)),
            Some(Constraint::Rigid | Constraint::Conformal) => {
                let rotation = cayley(&Constraint::Rigid.projected(&point.sample(arena, &chart.phi)));
                multiple(&rotation, &scale)
            }
        };
        let momentum = point.sample(arena, &chart.m);
        let momentum = group.map_or_else(|| momentum.clone(), |group| group.projected(&momentum));
        for (symbols, values) in [(&chart.phi, phi), (&chart.m, momentum)] {
            for (symbol, value) in symbols.0.iter().flatten().zip(values.concat()) {
                point.values.extend(arena.as_symbol(*symbol).map(|symbol| (symbol.clone(), value)));
            }
        }
        let inverse = never_missing(scale.recip(), "a random dilatation is not zero", Residue::UNKNOWN);
        let of_the_dilatation = [
            (Quantity::Dilatation, scale),
            (Quantity::InverseDilatation, inverse),
            (Quantity::DilatationSquared, scale.mul(&scale)),
            (Quantity::InverseDilatationSquared, inverse.mul(&inverse)),
        ];
        point.values.extend(of_the_dilatation.map(|(quantity, value)| (quantity.into(), value)));
        point
    }

    /// The first of them.
    pub(super) fn first(arena: &Arena, chart: &Chart) -> Self {
        Self::numbered(arena, chart, chart.confined, 0)
    }

    /// A point at `phi = 1`, without other relations.
    pub(super) fn undeformed(arena: &Arena, chart: &Chart) -> Self {
        let one = scalar(chart.dim, &Residue::number(&Rational::ONE));
        let entries = chart.phi.0.concat().into_iter().zip(one.concat());
        let named = entries.filter_map(|(symbol, value)| Some((arena.as_symbol(symbol)?.clone(), value)));
        Self { seed: 0, values: named.collect(), known: RefCell::default() }
    }

    /// Gives quantities the values of their definitions, in order.
    pub(super) fn define(&mut self, arena: &Arena, definitions: &Definitions) {
        for (symbol, definition) in definitions {
            let value = self.evaluate(arena, definition);
            if let Some(name) = arena.as_symbol(*symbol) {
                self.values.insert(name.clone(), value);
                self.known.get_mut().insert(*symbol, value);
            }
        }
    }

    /// The value of a symbol.
    pub(super) fn value(&self, symbol: &Symbol) -> Residue {
        let known = self.values.get(symbol).copied();
        known.unwrap_or_else(|| self.random(symbol))
    }

    /// A value that depends on the name alone.
    pub(super) fn random(&self, name: impl Display) -> Residue {
        Residue::sample(&format!("{name} at point {}", self.seed))
    }

    fn sample(&self, arena: &Arena, symbols: &Matrix) -> Square<Residue> {
        table(symbols.dim(), |i, j| self.of(arena, symbols.0[i][j]))
    }

    fn of(&self, arena: &Arena, symbol: Expr) -> Residue {
        let value = arena.as_symbol(symbol).map(|symbol| self.value(symbol));
        never_missing(value, "the coordinates of a chart are symbols", Residue::UNKNOWN)
    }

    /// The value of a polynomial.
    pub(super) fn evaluate(&self, arena: &Arena, polynomial: &Polynomial) -> Residue {
        let mut sum = Residue::ZERO;
        for (monomial, coefficient) in polynomial.terms() {
            let mut product = Residue::from_rational(coefficient);
            for atom in monomial {
                product = product.mul(&self.of_atom(arena, *atom));
            }
            sum = sum.add(&product);
        }
        sum
    }

    /// The value of an expression.
    pub(super) fn of_atom(&self, arena: &Arena, atom: Expr) -> Residue {
        if let Some(value) = self.known.borrow().get(&atom) {
            return *value;
        }
        let value = evaluate(arena, atom, &|symbol| Some(self.value(symbol)));
        let value = never_missing(value, "a form of the energy has values on the group", Residue::UNKNOWN);
        if arena.as_symbol(atom).is_some() {
            self.known.borrow_mut().insert(atom, value);
        }
        value
    }
}

/// The inverse matrix.
pub(super) fn inverse(m: &Square<Residue>) -> Square<Residue> {
    multiple(&adjugate(m), &determinant(m).recip().unwrap_or(Residue::UNKNOWN))
}

/// The matrix with its first row divided by its determinant.
fn unimodular(m: &Square<Residue>) -> Square<Residue> {
    let factor = never_missing(determinant(m).recip(), "a random matrix is regular", Residue::UNKNOWN);
    table(m.len(), |i, j| if i == 0 { m[i][j].mul(&factor) } else { m[i][j] })
}

/// Cayley's rotation `(1 - W)^-1 (1 + W)` of a skew `W`.
fn cayley(w: &Square<Residue>) -> Square<Residue> {
    let one = scalar(w.len(), &Residue::number(&Rational::ONE));
    product(&inverse(&difference(&one, w)), &sum(&one, w))
}
