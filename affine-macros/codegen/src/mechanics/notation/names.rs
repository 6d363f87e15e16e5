//! What each symbol of a model is called, and expressions by these names.

use rustc_hash::FxHashMap;

use super::field;
use super::matrix_name::MatrixName;
use super::sentence::Sentence;
use super::symbols;
use crate::algebra::substitute::listed;
use crate::algebra::text::Written;
use crate::algebra::{Arena, Expr, Polynomial};
use crate::mechanics::custom::{By, Custom, On, Role};
use crate::mechanics::metrics::{Metrics, Rebased, Source};
use crate::symbol::{Quantity, Symbol};

/// The names in the formulas of a model.
pub struct Notation<'a> {
    pub(super) customs: &'a [Custom],
    pub(super) metrics: Option<&'a Metrics>,
    pub(super) rebased: &'a [Rebased],
    pub(super) in_latex: bool,
    pub(super) matrices: Vec<Named>,
    /// Entries of inverses: of which matrix, with row and column from 1.
    pub(super) inverses: FxHashMap<Expr, (MatrixName, (usize, usize))>,
    /// Blocks of the mass matrix that are no part of a matrix that has a name: their entries, and what they are.
    pub(super) blocks: Vec<(Vec<Expr>, Sentence)>,
}

/// A matrix of a quadratic form under its name.
#[derive(Clone, Debug)]
pub(super) struct Named {
    pub(super) rows: Vec<Vec<Expr>>,
    pub(super) name: MatrixName,
    /// What it is, where it is no field.
    pub(super) definition: Option<Sentence>,
    /// Its number among the matrices that `prepare()` carries to orthonormal bases.
    pub(super) carried: Option<usize>,
}

impl Notation<'_> {
    /// Is it this entry of the inverse of a matrix?
    pub(in crate::mechanics) fn is_inverse_entry(
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

    /// An expression.
    pub(in crate::mechanics) fn scalar(&self, arena: &mut Arena, expr: Expr) -> Sentence {
        Sentence::Scalar(self.through_powers(arena, expr))
    }

    /// A polynomial.
    pub(in crate::mechanics) fn polynomial(&self, arena: &mut Arena, polynomial: &Polynomial) -> Sentence {
        let expr = polynomial.expression(arena);
        self.scalar(arena, expr)
    }

    /// The expression with powers of symbols for what stands for them.
    pub(super) fn through_powers(&self, arena: &mut Arena, expr: Expr) -> Expr {
        let mut symbols: Vec<Expr> = Vec::new();
        arena.any_symbol(expr, &mut |symbol| {
            symbols.push(symbol);
            false
        });
        let mut values: Vec<(Expr, Expr)> = Vec::new();
        for symbol in symbols {
            let (base, exponent) = self.power(arena, symbol);
            if base != symbol {
                values.push((symbol, arena.power(base, exponent)));
            }
        }
        // Powers of symbols are not zero.
        arena.replaced(expr, &listed(&values))
    }

    /// The symbol that this is a power of in formulas, and the exponent.
    pub(in crate::mechanics) fn power(&self, arena: &mut Arena, symbol: Expr) -> (Expr, i32) {
        match arena.as_symbol(symbol).and_then(Symbol::power) {
            Some((base, exponent)) => (arena.symbol(base), exponent),
            None => (symbol, 1),
        }
    }

    /// The symbol that this is a power of in formulas.
    pub(in crate::mechanics) fn base(&self, arena: &mut Arena, symbol: Expr) -> Expr {
        self.power(arena, symbol).0
    }

    /// Do formulas write out what it stands for?
    pub(in crate::mechanics) fn is_written_out(&self, arena: &Arena, symbol: Expr) -> bool {
        arena.quantity(symbol) == Some(Quantity::Swelling)
    }

    /// Text and LaTeX of a symbol.
    pub(super) fn written(&self, arena: &Arena, symbol: Expr) -> [Written; 2] {
        if let Some((matrix, (row, column))) = self.inverses.get(&symbol) {
            return matrix.inverse_entry(*row, *column);
        }
        let known = arena.as_symbol(symbol).and_then(|symbol| match symbol {
            Symbol::Field(field) => Some(field::number(field)),
            Symbol::Entry(field, row, column) => Some(field::matrix(field).entry(*row, *column)),
            Symbol::Prepared(number, row, column) => Some(self.prepared(*number, *row, *column)),
            Symbol::Component(quantity, indices) => {
                symbols::written(symbol).or_else(|| self.computed(*quantity, indices))
            }
            Symbol::About(..) | Symbol::Factor(..) => symbols::written(symbol),
            Symbol::Formula(..) | Symbol::Part(..) | Symbol::Step(_) => None,
        });
        known.unwrap_or_else(|| {
            let name = arena.symbol_name(symbol);
            let typewriter = Written::letter(field::typewriter(&name));
            [Written::letter(name), typewriter]
        })
    }

    /// An entry of a matrix that `prepare()` makes.
    fn prepared(&self, number: usize, row: usize, column: usize) -> [Written; 2] {
        let made =
            self.rebased.iter().find(|rebased| rebased.number == number).map(|rebased| &rebased.source);
        match made {
            Some(Source::SpaceInverse) => MatrixName::new("A", "A", true).inverse_entry(row, column),
            Some(Source::Body) => MatrixName::new("B", "B", true).entry(row, column),
            Some(Source::Form(..)) | None => {
                let of_it = |named: &&Named| named.carried == Some(number);
                let named = self.matrices.iter().find(of_it).map(|named| &named.name);
                let unnamed = || MatrixName::new(number.to_string(), number.to_string(), true);
                named.map_or_else(unnamed, Clone::clone).entry(row, column)
            }
        }
    }

    /// What a field computes: forces, slopes and energies.
    fn computed(&self, quantity: Quantity, indices: &[usize]) -> Option<[Written; 2]> {
        let (place, indices) = indices.split_first()?;
        let custom = self.customs.iter().find(|custom| custom.place == *place)?;
        if let By::SelfGravity(_) = custom.by {
            return integral(quantity, indices);
        }
        let [name, sub] = field::index(&custom.name);
        let index: String = indices.iter().map(usize::to_string).collect();
        let entry = |text: &str, latex: &str| {
            [
                Written::letter(format!("{text}[{name}]_{index}")),
                Written::letter(format!("{latex}_{{{sub},{index}}}")),
            ]
        };
        let slope = |of: &str, of_latex: &str| {
            let latex = format!("\\frac{{\\partial U_{{{sub}}}}}{{\\partial {of_latex}_{{{index}}}}}");
            [Written::raised(format!("dU[{name}]/d{of}_{index}")), Written::raised(latex)]
        };
        match (quantity, custom.role) {
            (Quantity::FieldForce, Role::Force { on: On::Body, .. }) => Some(entry("Q_hat", "\\hat Q")),
            (Quantity::FieldForce, Role::Force { .. }) => Some(entry("Q", "Q")),
            (Quantity::FieldPull, Role::Force { .. }) => Some(entry("F", "F")),
            (Quantity::FieldPush, _) => Some(entry("N", "N")),
            (Quantity::FieldPull, Role::Potential { .. }) => Some(slope("x", "x")),
            (Quantity::FieldSlope, Role::Potential { .. }) => Some(slope("phi", "\\varphi")),
            (Quantity::FieldPotential, _) => {
                Some([Written::letter(format!("U[{name}]")), Written::letter(format!("U_{{{sub}}}"))])
            }
            _ => None,
        }
    }
}

/// Carlson's integral of the squared stretches, and its derivatives.
fn integral(quantity: Quantity, indices: &[usize]) -> Option<[Written; 2]> {
    let index: String = indices.iter().map(usize::to_string).collect();
    match quantity {
        Quantity::FieldPotential => Some([Written::letter("R_F"), Written::letter("R_F")]),
        Quantity::FieldSlope => {
            let latex = format!("\\frac{{\\partial R_F}}{{\\partial \\varphi_{{{index}}}}}");
            Some([Written::raised(format!("dR_F/dphi_{index}")), Written::raised(latex)])
        }
        _ => None,
    }
}
