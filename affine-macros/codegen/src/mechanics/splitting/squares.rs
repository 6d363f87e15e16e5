//! An anisotropic energy as a sum of squares, each with an exact flow.
//!
//! A quadratic form in the affine spin is `H = sum over k of d_k/2 <E_k, M>^2`: by completing squares (Lagrange; `L D L^T`) where
//! its coefficients are numbers, by its principal axes where the fields' values give them. `<E_k, M>` is conserved along the flow of its own square, which
//! is that of `<E_k, M>` at the rate `s = d_k <E_k, M>`,
//!
//! ```text
//! phi -> phi exp(t s E), M -> exp(-t s E) M exp(t s E)          or, in space, phi -> exp(t s E) phi, M -> exp(t s E) M exp(-t s E)
//! ```
//!
//! in the closed form of [`turns`](super::turns). Squares whose momenta commute make one piece.

use crate::algebra::ring::table;
use crate::algebra::{Arena, Expr, Polynomial, Rational};
use crate::mechanics::brackets::poisson;
use crate::mechanics::charts::{Chart, Coordinate};
use crate::mechanics::equations::System;
use crate::mechanics::hessian::{Block, blocks, entries};
use crate::mechanics::reduce::Reduction;

use super::flows::value_of;
use super::turns::{self, Turn};
use super::{Flow, Summand};

/// The squares of an energy.
#[derive(Default)]
pub(super) struct Squares {
    /// Those with momenta that commute stand together.
    pub(super) groups: Vec<Vec<Square>>,
    /// What `prepare()` has to find first.
    pub(super) principal: Vec<Principal>,
}

/// `d/2 l^2`.
#[derive(Clone)]
pub(super) struct Square {
    /// `d`.
    weight: Polynomial,
    /// `l`, linear in the entries of the affine spin that determine the others.
    form: Polynomial,
    /// `l` of the projection of any affine spin.
    on_all: Polynomial,
    /// As text.
    name: String,
}

/// A symmetric form whose eigenvalues and eigenvectors are computed from the values of the fields.
#[derive(Clone, Debug)]
pub struct Principal {
    /// The form, in parameters.
    pub form: Vec<Vec<Polynomial>>,
    /// Symbols of the eigenvalues.
    pub values: Vec<Expr>,
    /// Symbols of the eigenvectors, one after the other.
    pub vectors: Vec<Vec<Expr>>,
}

impl Squares {
    /// The squares of a quadratic energy of a chart's affine spin; `None` where it is degenerate.
    pub(super) fn of(arena: &mut Arena, chart: &Chart, energy: &Polynomial) -> Option<Self> {
        let energy = energy.substitute(&|atom| value_of(&chart.dependent(), atom));
        let momenta: Vec<Coordinate> =
            chart.independent().into_iter().filter(|z| matches!(z, Coordinate::M(..))).collect();
        let symbols: Vec<Expr> = momenta.iter().map(|z| chart.symbol(*z)).collect();
        let form: Vec<Vec<Polynomial>> =
            energy.gradient(&symbols).iter().map(|slope| slope.gradient(&symbols)).collect();
        let mut squares = Self::default();
        for block in blocks(&form, entries(symbols.len())) {
            let of_block = squares.of_block(arena, &block)?;
            let places = block.basis.iter().filter_map(|vector| vector.entries.first());
            let places: Vec<usize> = places.map(|(k, _)| *k).collect();
            let atoms: Vec<Expr> = places.iter().map(|k| symbols[*k]).collect();
            for (k, (weight, row)) in of_block.into_iter().enumerate() {
                let (mut form, mut on_all) = (Polynomial::zero(), Polynomial::zero());
                for (c, place) in row.iter().zip(&places) {
                    form.add_product(c, &Polynomial::atom(symbols[*place]), &Rational::ONE);
                    on_all.add_product(c, &on_all_momenta(chart, momenta[*place]), &Rational::ONE);
                }
                let name = name(arena, &form, k + 1, &atoms);
                squares.place(chart, Square { weight, form, on_all, name });
            }
        }
        Some(squares)
    }

    /// Weights and rows of coefficients.
    fn of_block(&mut self, arena: &mut Arena, block: &Block) -> Option<Vec<(Polynomial, Vec<Polynomial>)>> {
        let fixed = |entry: &Polynomial| !entry.any_symbol(arena, &mut |_| true);
        if block.form.len() == 1 || block.form.iter().flatten().all(fixed) {
            return completed(arena, block.form.clone());
        }
        let known = self.principal.iter().position(|known| known.form == block.form);
        let known = known.unwrap_or_else(|| {
            self.principal.push(Principal::symbols(arena, self.principal.len() + 1, block.form.clone()));
            self.principal.len() - 1
        });
        self.principal.get(known).map(Principal::squares)
    }

    /// Puts a square beside others that it commutes with.
    fn place(&mut self, chart: &Chart, square: Square) {
        let commutes = |other: &Square| poisson(chart, &other.on_all, &square.on_all).is_zero();
        match self.groups.iter_mut().find(|group| group.iter().all(commutes)) {
            Some(group) => group.push(square),
            None => self.groups.push(vec![square]),
        }
    }
}

impl Principal {
    fn symbols(arena: &mut Arena, b: usize, form: Vec<Vec<Polynomial>>) -> Self {
        let size = form.len();
        let values = (1..=size).map(|k| arena.symbol(&format!("square_{b}_{k}"))).collect();
        let mut vector = |k: usize| (1..=size).map(|i| arena.symbol(&format!("axis_{b}_{k}_{i}"))).collect();
        let vectors = (1..=size).map(&mut vector).collect();
        Self { form, values, vectors }
    }

    fn squares(&self) -> Vec<(Polynomial, Vec<Polynomial>)> {
        let atoms = |list: &Vec<Expr>| list.iter().map(|s| Polynomial::atom(*s)).collect();
        self.values.iter().map(|s| Polynomial::atom(*s)).zip(self.vectors.iter().map(atoms)).collect()
    }
}

/// An entry of the affine spin, under a constraint that of its projection.
fn on_all_momenta(chart: &Chart, entry: Coordinate) -> Polynomial {
    match (chart.confined, entry) {
        (Some(group), Coordinate::M(a, b)) => {
            group.projected(&table(chart.dim, |c, d| Polynomial::atom(chart.m.0[c][d])))[a][b].clone()
        }
        _ => Polynomial::atom(chart.symbol(entry)),
    }
}

/// Lagrange's reduction of a symmetric form: weights `d_k` and rows of `l_k` with `F = sum of d_k l_k^T l_k`.
fn completed(
    arena: &mut Arena,
    mut form: Vec<Vec<Polynomial>>,
) -> Option<Vec<(Polynomial, Vec<Polynomial>)>> {
    let size = form.len();
    let unit =
        |i: usize| (0..size).map(|j| Polynomial::constant(Rational::from(i64::from(i == j)))).collect();
    let mut rows: Vec<Vec<Polynomial>> = (0..size).map(unit).collect();
    let mut open: Vec<usize> = (0..size).collect();
    let mut squares = Vec::new();
    while !open.is_empty() {
        let k = match open.iter().find(|k| !form[**k][**k].is_zero()) {
            Some(k) => *k,
            None => square_of_a_product(&mut form, &mut rows, &open)?,
        };
        open.retain(|other| *other != k);
        let pivot = form[k][k].clone();
        let reciprocal = pivot.expression(arena);
        let reciprocal = arena.pow(reciprocal, -1)?;
        let reciprocal = Polynomial::normal_form(arena, reciprocal);
        let factors: Vec<(usize, Polynomial)> =
            open.iter().map(|j| (*j, form[k][*j].mul(&reciprocal))).filter(|(_, f)| !f.is_zero()).collect();
        for (j, factor) in &factors {
            for l in &open {
                let less = factor.mul(&form[k][*l]);
                form[*j][*l].add_scaled(&less, &Rational::MINUS_ONE);
            }
            let more: Vec<Polynomial> = rows[*j].iter().map(|c| c.mul(factor)).collect();
            rows[k].iter_mut().zip(&more).for_each(|(c, more)| c.add_scaled(more, &Rational::ONE));
        }
        squares.push((pivot, rows[k].clone()));
    }
    Some(squares)
}

/// Only products are left: `y_i y_j = ((y_i + y_j)^2 - (y_i - y_j)^2)/4`. The place of the sum.
fn square_of_a_product(
    form: &mut [Vec<Polynomial>],
    rows: &mut [Vec<Polynomial>],
    open: &[usize],
) -> Option<usize> {
    let pairs = open.iter().flat_map(|i| open.iter().map(move |j| (*i, *j)));
    let (i, j) = pairs.into_iter().find(|(i, j)| i != j && !form[*i][*j].is_zero())?;
    let half = Rational::ratio(1, 2)?;
    let combined = |one: &[Polynomial], other: &[Polynomial], sign: &Rational| -> Vec<Polynomial> {
        let pairs = one.iter().zip(other);
        pairs
            .map(|(a, b)| {
                let mut sum = a.clone();
                sum.add_scaled(b, sign);
                sum
            })
            .collect()
    };
    // y_i = (u + v)/2 and y_j = (u - v)/2, in the columns and then in the rows of the form.
    for row in form.iter_mut() {
        let (a, b) = (row[i].scaled(&half), row[j].scaled(&half));
        [row[i], row[j]] = [&Rational::ONE, &Rational::MINUS_ONE].map(|sign| {
            let mut sum = a.clone();
            sum.add_scaled(&b, sign);
            sum
        });
    }
    let (a, b): (Vec<_>, Vec<_>) = (
        form[i].iter().map(|c| c.scaled(&half)).collect(),
        form[j].iter().map(|c| c.scaled(&half)).collect(),
    );
    (form[i], form[j]) = (combined(&a, &b, &Rational::ONE), combined(&a, &b, &Rational::MINUS_ONE));
    let (a, b) = (rows[i].clone(), rows[j].clone());
    (rows[i], rows[j]) = (combined(&a, &b, &Rational::ONE), combined(&a, &b, &Rational::MINUS_ONE));
    Some(i)
}

impl Square {
    fn summand(&self) -> Option<Summand> {
        let half = Rational::ratio(1, 2)?;
        let energy = self.weight.mul(&self.on_all.mul(&self.on_all)).scaled(&half);
        Some(Summand { name: self.name.clone(), energy: Some(energy), system: System::default() })
    }
}

/// The square as text: the `k`-th of a block of momenta where only the fields' values tell which.
fn name(arena: &mut Arena, form: &Polynomial, k: usize, block: &[Expr]) -> String {
    let known = |atom: Expr| block.contains(&atom);
    if form.mentions(|atom| !known(atom)) {
        let names: Vec<&str> = block.iter().filter_map(|atom| arena.name(*atom)).collect();
        return format!("square {k} of {}", names.join(", "));
    }
    let form = form.expression(arena);
    let text = arena.text(form);
    if arena.name(form).is_some() { format!("{text}^2") } else { format!("({text})^2") }
}

/// The piece of squares that commute.
pub(super) fn piece(
    arena: &mut Arena,
    reduction: &Reduction,
    group: &[Square],
) -> Option<(Vec<Summand>, Vec<Flow>)> {
    let turns = group.iter().enumerate();
    let turns = turns.map(|(k, square)| {
        let rate = (arena.symbol(&format!("rate_{}", k + 1)), square.weight.mul(&square.form));
        Turn::of(arena, reduction, &square.on_all, rate)
    });
    let turns: Vec<Turn> = turns.collect::<Option<_>>()?;
    let flows = turns::flows(arena, reduction, &turns)?;
    let summands = group.iter().map(Square::summand).collect::<Option<_>>()?;
    Some((summands, flows))
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::completed;
    use crate::algebra::{Arena, Polynomial, Rational};

    /// Small integers, a third of them zero, from a linear congruence.
    fn next(state: &mut u64) -> Rational {
        *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let value = i64::try_from((*state >> 33) % 9).unwrap() - 4;
        if value.rem_euclid(3) == 0 { Rational::ZERO } else { Rational::from(value) }
    }

    #[test]
    fn squares_add_up_to_the_form() {
        let (mut arena, mut state, mut indefinite) = (Arena::new(), 1, 0);
        for trial in 0..300 {
            let size = 1 + trial % 6;
            let mut form = vec![vec![Polynomial::zero(); size]; size];
            for i in 0..size {
                // Every third form has nothing but products.
                for j in 0..i + usize::from(trial % 3 != 0) {
                    let entry = Polynomial::constant(next(&mut state));
                    (form[i][j], form[j][i]) = (entry.clone(), entry);
                }
            }
            let Some(squares) = completed(&mut arena, form.clone()) else { continue };
            indefinite += usize::from(form[0][0].is_zero());
            for i in 0..size {
                for j in 0..size {
                    let mut sum = Polynomial::zero();
                    for (weight, row) in &squares {
                        sum.add_product(&row[i].mul(&row[j]), weight, &Rational::ONE);
                    }
                    assert_eq!(sum, form[i][j], "{form:?}");
                }
            }
        }
        assert!(indefinite > 20, "{indefinite}");
    }
}
