//! Constant metrics of space and body: the bases in which they are the identity.

mod axes;
mod congruent;
mod forms;

use crate::algebra::ring::table;
use crate::algebra::root::root;
use crate::algebra::{Expr, Rational};

pub use axes::{Axes, root_of_product};
pub use congruent::Congruent;
pub use forms::{Rebased, Source};

/// Metrics other than the identity.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Metrics {
    /// Numbers, with the bases that follow from them.
    Known(Bases),
    /// Expressions in the fields, which have their values when the model is prepared: `g` and `eta`.
    Given([Vec<Vec<Expr>>; 2]),
}

/// `g = A^T A` and `eta = B^T B` with upper triangular factors (Cholesky) and their inverses.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Bases {
    /// `A`.
    pub space: Factor,
    /// `B`.
    pub body: Factor,
}

/// A factor and its inverse: exact where the roots of the metric's pivots are rational, correct to more than a
/// double-double otherwise.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Factor {
    /// The factor, row after row.
    pub matrix: Vec<Vec<Rational>>,
    /// The inverse of the factor, row after row.
    pub inverse: Vec<Vec<Rational>>,
    /// The rational basis that it normalises.
    pub axes: Axes,
}

impl Bases {
    /// The change of bases; `None` where both metrics are the identity, or one is not positive definite.
    pub fn new(space: &[Vec<Rational>], body: &[Vec<Rational>]) -> Option<Self> {
        if is_identity(space) && is_identity(body) {
            return None;
        }
        Some(Self { space: Factor::of(space)?, body: Factor::of(body)? })
    }
}

impl Factor {
    /// `A = diag(sqrt d) U` of `g = U^T diag(d) U`.
    fn of(metric: &[Vec<Rational>]) -> Option<Self> {
        let axes = Axes::of(metric)?;
        let roots: Vec<Rational> = axes.squares.iter().map(root).collect::<Option<_>>()?;
        let reciprocals: Vec<Rational> = roots.iter().map(Rational::recip).collect::<Option<_>>()?;
        let n = roots.len();
        let scaled = |entry: &dyn Fn(usize, usize) -> Rational| -> Vec<Vec<Rational>> { table(n, entry) };
        let matrix = scaled(&|i, j| &axes.matrix[i][j] * &roots[i]);
        let inverse = scaled(&|i, j| &axes.inverse[i][j] * &reciprocals[j]);
        Some(Self { matrix, inverse, axes })
    }
}

fn is_identity(metric: &[Vec<Rational>]) -> bool {
    metric.iter().enumerate().all(|(i, row)| {
        row.iter().enumerate().all(|(j, entry)| if i == j { entry.is_one() } else { entry.is_zero() })
    })
}
