//! An anisotropic energy as a sum of squares, each with an exact flow.
//!
//! A quadratic form in the affine spin is `H = sum over k of d_k/2 <E_k, M>^2`: by completing squares where its
//! coefficients are numbers, by its principal axes where the fields' values give them. `<E_k, M>` is conserved along
//! the flow of its own square, which is that of `<E_k, M>` at the rate `s = d_k <E_k, M>`,
//!
//! ```text
//! phi -> phi exp(t s E), M -> exp(-t s E) M exp(t s E)          in the body
//! phi -> exp(t s E) phi, M -> exp(t s E) M exp(-t s E)          in space
//! ```
//!
//! in the closed form of [`turns`](super::turns). Squares whose momenta commute make one piece.

use crate::algebra::lagrange::completed;
use crate::algebra::{Arena, Expr, Polynomial, Rational};
use crate::mechanics::brackets::poisson;
use crate::mechanics::charts::{Chart, Coordinate};
use crate::mechanics::direction::entries;
use crate::mechanics::equations::System;
use crate::mechanics::hessian::{Block, blocks};
use crate::mechanics::reduction::Reduction;
use crate::symbol::Quantity;

use super::flows::Flow;
use super::summand::Summand;
use super::turns::{self, Turn};

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
    /// `l` as text.
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
        let energy = chart.reduced(energy);
        let momenta = chart.independent_momenta();
        let symbols: Vec<Expr> = momenta.iter().map(|z| chart.symbol(*z)).collect();
        let form = energy.hessian(&symbols);
        let mut squares = Self::default();
        for block in blocks(&form, &entries(symbols.len())) {
            let of_block = squares.of_block(arena, &block)?;
            let places = block.places();
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
        let values = arena.components(Quantity::BlockValue.at([b]), size);
        let vectors = (1..=size).map(|k| arena.components(Quantity::BlockAxis.at([b, k]), size)).collect();
        Self { form, values, vectors }
    }

    fn squares(&self) -> Vec<(Polynomial, Vec<Polynomial>)> {
        let vectors = self.vectors.iter().map(|vector| Polynomial::vector(vector));
        Polynomial::vector(&self.values).into_iter().zip(vectors).collect()
    }
}

/// An entry of the affine spin, under a constraint that of its projection.
fn on_all_momenta(chart: &Chart, entry: Coordinate) -> Polynomial {
    match (chart.confined, entry) {
        (Some(group), Coordinate::M(a, b)) => group.projected(&chart.m.atoms())[a][b].clone(),
        _ => Polynomial::atom(chart.symbol(entry)),
    }
}

impl Square {
    fn summand(&self) -> Summand {
        let energy = self.weight.mul(&self.on_all.mul(&self.on_all)).scaled(&Rational::HALF);
        Summand { name: self.name.clone(), energy: Some(energy), system: System::default() }
    }
}

/// The square as text: the `k`-th of a block of momenta where only the fields' values tell which.
fn name(arena: &mut Arena, form: &Polynomial, k: usize, block: &[Expr]) -> String {
    if form.mentions(|atom| !block.contains(&atom)) {
        let names: Vec<String> = block.iter().map(|atom| arena.symbol_name(*atom)).collect();
        return format!("square {k} of {}", names.join(", "));
    }
    let form = form.expression(arena);
    let text = arena.text(form);
    if arena.as_symbol(form).is_some() { format!("{text}^2") } else { format!("({text})^2") }
}

/// The piece of squares that commute.
pub(super) fn piece(
    arena: &mut Arena,
    reduction: &Reduction,
    group: &[Square],
) -> Option<(Vec<Summand>, Vec<Flow>)> {
    let turns = group.iter().enumerate();
    let turns = turns.map(|(k, square)| {
        let rate = (arena.symbol(Quantity::FlowRate.at([k + 1])), square.weight.mul(&square.form));
        Turn::of(arena, reduction, &square.on_all, rate)
    });
    let turns: Vec<Turn> = turns.collect::<Option<_>>()?;
    let flows = turns::flows(arena, reduction, &turns)?;
    Some((group.iter().map(Square::summand).collect(), flows))
}
