//! Small symbolic matrices.

use super::arena::{Arena, Expr};
use super::polynomial::Polynomial;
use super::ring::{Square, table};
use crate::symbol::Symbol;

/// A matrix of expressions, row after row.
#[derive(Clone, Debug, PartialEq, Eq)]
#[must_use]
pub struct Matrix(pub Vec<Vec<Expr>>);

impl Matrix {
    /// The matrix of the components `11`, `12`, ... of a symbol.
    pub fn symbols(arena: &mut Arena, of: impl Into<Symbol>, n: usize) -> Self {
        let of = of.into();
        Self(table(n, |i, j| arena.symbol(of.at([i + 1, j + 1]))))
    }

    /// The symmetric matrix of such components, of two that mirror each other the one above the diagonal.
    pub fn symmetric(arena: &mut Arena, of: impl Into<Symbol>, n: usize) -> Self {
        let of = of.into();
        Self(table(n, |i, j| arena.symbol(of.at([i.min(j) + 1, i.max(j) + 1]))))
    }

    /// Its entries, which are atoms, as polynomials.
    pub fn atoms(&self) -> Square<Polynomial> {
        table(self.dim(), |i, j| Polynomial::atom(self.0[i][j]))
    }

    /// Its entries as polynomials.
    pub fn normal_form(&self, arena: &mut Arena) -> Square<Polynomial> {
        table(self.dim(), |i, j| Polynomial::normal_form(arena, self.0[i][j]))
    }

    /// Number of rows.
    pub fn dim(&self) -> usize {
        self.0.len()
    }

    /// Transpose.
    pub fn transpose(&self) -> Self {
        let n = self.dim();
        Self(table(n, |i, j| self.0[j][i]))
    }
}
