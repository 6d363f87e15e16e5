//! Small symbolic matrices.

use super::arena::{Arena, Expr};
use super::rational::Rational;
use crate::symbol::Symbol;

/// A matrix of expressions, row after row.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Matrix(pub Vec<Vec<Expr>>);

impl Matrix {
    /// The matrix of the components `11`, `12`, ... of a symbol.
    pub fn symbols(arena: &mut Arena, of: impl Into<Symbol>, n: usize) -> Self {
        let of = of.into();
        Self((1..=n).map(|i| (1..=n).map(|j| arena.symbol(of.at([i, j]))).collect()).collect())
    }

    /// Number of rows.
    #[must_use]
    pub fn dim(&self) -> usize {
        self.0.len()
    }

    /// Transpose.
    #[must_use]
    pub fn transpose(&self) -> Self {
        let n = self.dim();
        Self((0..n).map(|i| (0..n).map(|j| self.0[j][i]).collect()).collect())
    }

    /// Matrix product.
    #[must_use]
    pub fn mul(&self, arena: &mut Arena, other: &Self) -> Self {
        let n = self.dim();
        let mut entry = |i: usize, j: usize| {
            let products: Vec<_> =
                (0..n).map(|k| (arena.mul(self.0[i][k], other.0[k][j]), Rational::ONE)).collect();
            arena.linear(&products)
        };
        Self((0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect())
    }

    /// Trace.
    pub fn trace(&self, arena: &mut Arena) -> Expr {
        let diagonal: Vec<_> = (0..self.dim()).map(|k| (self.0[k][k], Rational::ONE)).collect();
        arena.linear(&diagonal)
    }
}
