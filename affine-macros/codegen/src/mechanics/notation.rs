//! Formulas in text and LaTeX: what each symbol of a model is called.
//!
//! A formula names [symbols of the mechanics](SYMBOLS) and fields, which keep the names that the user gave them. What the
//! derivation names besides is a power of such a symbol, an entry of a matrix or of its inverse, or what a field
//! computes.

mod as_latex;
mod as_text;
mod field;
mod formula;
mod latex;
mod letter;
pub(super) mod letters;
mod matrix;
mod matrix_name;
mod names;
mod sentence;
mod sum;
mod symbols;

use rustc_hash::FxHashMap;

use crate::algebra::definitions::used;
use crate::algebra::{Arena, Expr, Polynomial};
use crate::symbol::Symbol;

use super::forces::Forces;
use super::hessian::NumericBlock;
use super::kinetic::Kinetic;
use super::metrics::{Metrics, Rebased, Source};

pub(super) use field::index as field_index;
pub use formula::Formula;
pub use letter::Letter;
pub use matrix_name::MatrixName;
pub use names::Notation;
pub use sentence::{Exponent, Sentence, Summand};
pub(super) use sentence::{commutator, half, placement, product, rate, slope, trace};
pub(super) use sum::Sum;
pub use symbols::{FUNCTIONS, SYMBOLS, is_symbol};

/// What the formulas of a model describe.
pub struct Described<'a> {
    /// The kinetic energies.
    pub energies: &'a [Kinetic],
    /// The blocks of the mass matrix whose inverses need numbers.
    pub blocks: &'a [NumericBlock],
    /// The forces that no potential has.
    pub forces: &'a Forces,
    /// The metrics other than the identity.
    pub metrics: Option<&'a Metrics>,
    /// The matrices that are carried to orthonormal bases.
    pub rebased: &'a [Rebased],
    /// Are they wanted in LaTeX?
    pub latex: bool,
}

impl<'a> Notation<'a> {
    /// The names for a model.
    pub fn new(arena: &mut Arena, described: &Described<'a>) -> Self {
        let mut notation = Self {
            customs: &described.forces.customs,
            metrics: described.metrics,
            rebased: described.rebased,
            in_latex: described.latex,
            matrices: Vec::new(),
            inverses: FxHashMap::default(),
            blocks: Vec::new(),
        };
        notation.name_matrices(arena, described.energies, described.forces);
        notation.name_blocks(arena, described.blocks);
        notation
    }

    /// Names for the inverses: those of entries of `J^-1` where a block is one of a matrix `J`.
    fn name_blocks(&mut self, arena: &mut Arena, blocks: &[NumericBlock]) {
        let mut unnamed = Vec::new();
        for block in blocks {
            match self.containing(arena, &block.form) {
                Some((named, rows)) => {
                    let name = named.name.clone();
                    self.name_inverse(block, &name, &rows);
                }
                None => unnamed.push(block),
            }
        }
        for (k, block) in unnamed.iter().enumerate() {
            let name = match unnamed.len() {
                1 => MatrixName::new("Gamma", "\\Gamma", true),
                _ => MatrixName::new(format!("Gamma_{}", k + 1), format!("\\Gamma_{{{}}}", k + 1), false),
            };
            self.name_inverse(block, &name, &(0..block.form.len()).collect::<Vec<_>>());
            let rows: Vec<Vec<Expr>> =
                block.form.iter().map(|row| row.iter().map(|p| p.expression(arena)).collect()).collect();
            let definition = self.literal(arena, &rows).of(Sentence::Matrix(name));
            self.blocks.push((block.inverse.concat(), definition));
        }
    }

    fn name_inverse(&mut self, block: &NumericBlock, name: &MatrixName, rows: &[usize]) {
        for (i, row) in block.inverse.iter().enumerate() {
            for (j, symbol) in row.iter().enumerate().skip(i) {
                self.inverses.insert(*symbol, (name.clone(), (rows[i] + 1, rows[j] + 1)));
            }
        }
    }

    /// What these polynomials use and no formula defines but one of its own: blocks of the mass matrix, factors of the metrics.
    pub(super) fn definitions<'p>(
        &self,
        arena: &mut Arena,
        polynomials: impl Iterator<Item = &'p Polynomial>,
    ) -> Vec<Sentence> {
        let used = used(arena, polynomials);
        let of_block = |(entries, definition): &(Vec<Expr>, Sentence)| {
            entries.iter().any(|entry| used.contains(entry)).then(|| definition.clone())
        };
        let mut list: Vec<Sentence> = self.blocks.iter().filter_map(of_block).collect();
        let Some(Metrics::Given([space, body])) = self.metrics else { return list };
        for matrix in self.rebased {
            let (letter, metric) = match matrix.source {
                Source::SpaceInverse => (letters::SPACE_FACTOR, space),
                Source::Body => (letters::BODY_FACTOR, body),
                Source::Form(..) => continue,
            };
            let is_entry = |symbol: &Expr| matches!(arena.as_symbol(*symbol), Some(Symbol::Prepared(number, ..)) if *number == matrix.number);
            if used.iter().any(is_entry) {
                let square = product([Sentence::from(letter).transposed(), letter.into()]);
                list.push(self.literal(arena, metric).of(square));
            }
        }
        list
    }
}
