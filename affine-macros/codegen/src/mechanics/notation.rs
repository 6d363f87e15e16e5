//! Formulas in text and LaTeX: what each symbol of a model is called.
//!
//! A formula names [symbols of the mechanics](SYMBOLS) and fields, which keep the names that the user gave them. What the
//! derivation names besides is a power of such a symbol, an entry of a matrix or of its inverse, or what a field
//! computes.

mod field;
mod latex;
mod matrix;
mod symbols;

use rustc_hash::{FxHashMap, FxHashSet};

use crate::algebra::text::Written;
use crate::algebra::{Arena, Expr, Polynomial};

use super::custom::{Custom, On, Role};
use super::forces::Forces;
use super::hessian::NumericBlock;
use super::kinetic::Kinetic;
use super::metrics::{Metrics, Rebased, Source};
use matrix::{Named, entry_of_field};

pub(super) use field::index as field_index;
pub(super) use matrix::MatrixName;

pub use symbols::{FUNCTIONS, SYMBOLS, Symbol, is_symbol};

/// A formula in both notations.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Formula {
    /// Plain text.
    pub text: String,
    /// LaTeX.
    pub latex: String,
}

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
}

/// The names in the formulas of a model.
pub struct Notation<'a> {
    customs: &'a [Custom],
    metrics: Option<&'a Metrics>,
    rebased: &'a [Rebased],
    matrices: Vec<Named>,
    /// Entries of inverses: of which matrix, with row and column from 1.
    inverses: FxHashMap<Expr, (MatrixName, (usize, usize))>,
    /// Blocks of the mass matrix that are no part of a matrix that has a name: their entries, and what they are.
    blocks: Vec<(Vec<Expr>, Formula)>,
}

impl<'a> Notation<'a> {
    /// The names for a model.
    pub fn new(arena: &mut Arena, described: &Described<'a>) -> Self {
        let mut notation = Self {
            customs: &described.forces.customs,
            metrics: described.metrics,
            rebased: described.rebased,
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
            let Formula { text, latex } = self.literal(arena, &rows);
            let definition = Formula {
                text: format!("{} = {text}", name.text),
                latex: format!("{} = {latex}", name.latex),
            };
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

    /// Is it this entry of the inverse of a matrix?
    pub(super) fn is_inverse_entry(
        &self,
        symbol: Expr,
        matrix: &MatrixName,
        (row, column): (usize, usize),
    ) -> bool {
        let same = |(known, place): &(MatrixName, _)| {
            known == matrix && [(row, column), (column, row)].contains(place)
        };
        self.inverses.get(&symbol).is_some_and(same)
    }

    /// An expression in both notations.
    pub(super) fn formula(&self, arena: &mut Arena, expr: Expr) -> Formula {
        let shown = self.through_powers(arena, expr);
        let name = |which: usize| {
            let arena = &*arena;
            move |symbol: Expr| {
                let [text, latex] = self.written(arena, symbol);
                if which == 0 { text } else { latex }
            }
        };
        Formula { text: arena.text_with(shown, &name(0)), latex: latex::latex(arena, shown, &name(1)) }
    }

    /// The expression with powers of symbols for what stands for them.
    fn through_powers(&self, arena: &mut Arena, expr: Expr) -> Expr {
        let mut symbols: Vec<Expr> = Vec::new();
        arena.any_symbol(expr, &mut |symbol| {
            symbols.push(symbol);
            false
        });
        let mut values: Vec<(Expr, Expr)> = Vec::new();
        for symbol in symbols {
            let (base, exponent) = self.power(arena, symbol);
            if base != symbol {
                values.extend(arena.pow(base, exponent).map(|power| (symbol, power)));
            }
        }
        let value = |symbol: Expr| values.iter().find(|(known, _)| *known == symbol).map(|(_, value)| *value);
        // Powers of symbols are not zero.
        arena.substitute(expr, &value).unwrap_or(expr)
    }

    /// The symbol that this is a power of in formulas, and the exponent.
    pub(super) fn power(&self, arena: &mut Arena, symbol: Expr) -> (Expr, i32) {
        match arena.name(symbol).and_then(symbols::power) {
            Some((base, exponent)) => (arena.symbol(&base), exponent),
            None => (symbol, 1),
        }
    }

    /// The symbol that this is a power of in formulas.
    pub(super) fn base(&self, arena: &mut Arena, symbol: Expr) -> Expr {
        self.power(arena, symbol).0
    }

    /// Do formulas write out what it stands for?
    pub(super) fn is_written_out(&self, arena: &Arena, symbol: Expr) -> bool {
        arena.name(symbol).is_some_and(symbols::is_written_out)
    }

    /// A polynomial in both notations.
    pub(super) fn polynomial(&self, arena: &mut Arena, polynomial: &Polynomial) -> Formula {
        let expr = polynomial.expression(arena);
        self.formula(arena, expr)
    }

    /// Text and LaTeX of a symbol.
    fn written(&self, arena: &Arena, symbol: Expr) -> [Written; 2] {
        let name = arena.name(symbol).unwrap_or_default();
        if let Some((matrix, (row, column))) = self.inverses.get(&symbol) {
            return matrix.inverse_entry(*row, *column);
        }
        if let Some((matrix, row, column)) = entry_of_field(name) {
            return self.entry(matrix, row, column);
        }
        if let Some(field) = name.strip_prefix("self.") {
            return field::number(field);
        }
        symbols::written(name)
            .or_else(|| self.computed(name))
            .unwrap_or_else(|| [Written::letter(name), Written::letter(field::typewriter(name))])
    }

    /// An entry of a field, or of a matrix that `prepare()` makes.
    fn entry(&self, matrix: &str, row: usize, column: usize) -> [Written; 2] {
        let made = self.rebased.iter().find(|rebased| rebased.name == matrix).map(|rebased| &rebased.source);
        match made {
            None => field::matrix(matrix).entry(row, column),
            Some(Source::SpaceInverse) => MatrixName::new("A", "A", true).inverse_entry(row, column),
            Some(Source::Body) => MatrixName::new("B", "B", true).entry(row, column),
            Some(Source::Form(..)) => {
                let of_it = |named: &&Named| named.carried.as_deref() == Some(matrix);
                let named = self.matrices.iter().find(of_it).map(|named| &named.name);
                named.map_or_else(|| field::matrix(matrix), Clone::clone).entry(row, column)
            }
        }
    }

    /// What a field computes: forces, slopes and energies.
    fn computed(&self, name: &str) -> Option<[Written; 2]> {
        let (stem, index) = name.rsplit_once('_')?;
        let (stem, index, place) = match stem.rsplit_once('_') {
            Some((kind, place)) => (kind, Some(index), place),
            None => (stem, None, index),
        };
        let place: usize = place.parse().ok()?;
        let custom = self.customs.iter().find(|custom| custom.place == place)?;
        let [name, sub] = field_index(&custom.name);
        let entry = |text: &str, latex: &str, index: &str| {
            [
                Written::letter(format!("{text}[{name}]_{index}")),
                Written::letter(format!("{latex}_{{{sub},{index}}}")),
            ]
        };
        let slope = |of: &str, of_latex: &str, index: &str| {
            let latex = format!("\\frac{{\\partial U_{{{sub}}}}}{{\\partial {of_latex}_{{{index}}}}}");
            [Written::raised(format!("dU[{name}]/d{of}_{index}")), Written::raised(latex)]
        };
        match (stem, index, custom.role) {
            ("force", Some(index), Role::Force { on: On::Body, .. }) => {
                Some(entry("Q_hat", "\\hat Q", index))
            }
            ("force", Some(index), Role::Force { .. }) => Some(entry("Q", "Q", index)),
            ("pull", Some(index), Role::Force { .. }) => Some(entry("F", "F", index)),
            ("push", Some(index), _) => Some(entry("N", "N", index)),
            ("pull", Some(index), Role::Potential { .. }) => Some(slope("x", "x", index)),
            ("slope", Some(index), Role::Potential { .. }) => Some(slope("phi", "\\varphi", index)),
            ("potential", None, _) => {
                Some([Written::letter(format!("U[{name}]")), Written::letter(format!("U_{{{sub}}}"))])
            }
            _ => None,
        }
    }

    /// What these polynomials use and no formula defines but one of its own: blocks of the mass matrix, factors of the metrics.
    pub(super) fn definitions<'p>(
        &self,
        arena: &mut Arena,
        polynomials: impl Iterator<Item = &'p Polynomial>,
    ) -> Vec<Formula> {
        let mut used = FxHashSet::default();
        for polynomial in polynomials {
            polynomial.any_symbol(arena, &mut |symbol| {
                used.insert(symbol);
                false
            });
        }
        let of_block = |(entries, definition): &(Vec<Expr>, Formula)| {
            entries.iter().any(|entry| used.contains(entry)).then(|| definition.clone())
        };
        let mut list: Vec<Formula> = self.blocks.iter().filter_map(of_block).collect();
        let Some(Metrics::Given([space, body])) = self.metrics else { return list };
        for matrix in self.rebased {
            let (letter, metric) = match matrix.source {
                Source::SpaceInverse => ("A", space),
                Source::Body => ("B", body),
                Source::Form(..) => continue,
            };
            let is_entry = |symbol: &Expr| {
                arena.name(*symbol).and_then(entry_of_field).is_some_and(|(name, ..)| name == matrix.name)
            };
            if used.iter().any(is_entry) {
                let Formula { text, latex } = self.literal(arena, metric);
                let text = format!("{letter}^T {letter} = {text}");
                list.push(Formula { text, latex: format!("{letter}^T {letter} = {latex}") });
            }
        }
        list
    }
}

impl Formula {
    /// With definitions of what it names.
    #[must_use]
    pub(super) fn with(self, definitions: Vec<Formula>) -> Self {
        definitions.into_iter().fold(self, |formula, Formula { text, latex }| Formula {
            text: format!("{}, {text}", formula.text),
            latex: format!("{},\\quad {latex}", formula.latex),
        })
    }
}
