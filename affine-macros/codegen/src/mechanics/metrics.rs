//! Constant metrics of space and body: the bases in which they are the identity.

use crate::algebra::linear;
use crate::algebra::root::root;
use crate::algebra::{Expr, Rational};

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
    /// Row after row.
    pub matrix: Vec<Vec<Rational>>,
    /// Likewise.
    pub inverse: Vec<Vec<Rational>>,
}

impl Bases {
    /// The change of bases; `None` where both metrics are the identity, or one is not positive definite.
    #[must_use]
    pub fn new(space: &[Vec<Rational>], body: &[Vec<Rational>]) -> Option<Self> {
        if is_identity(space) && is_identity(body) {
            return None;
        }
        Some(Self { space: Factor::of(space)?, body: Factor::of(body)? })
    }
}

impl Factor {
    /// `L` with `metric = L^T L`: `L_kj = (g_kj - sum over i < k of L_ik L_ij)/L_kk`.
    fn of(metric: &[Vec<Rational>]) -> Option<Self> {
        let n = metric.len();
        let mut matrix = vec![vec![Rational::ZERO; n]; n];
        for k in 0..n {
            let rest = |matrix: &[Vec<Rational>], j: usize| {
                (0..k).fold(metric[k][j].clone(), |sum, i| &sum - &(&matrix[i][k] * &matrix[i][j]))
            };
            let pivot = root(&rest(&matrix, k))?;
            for j in k + 1..n {
                matrix[k][j] = rest(&matrix, j).checked_div(&pivot)?;
            }
            matrix[k][k] = pivot;
        }
        let inverse = linear::inverse(&matrix)?;
        Some(Self { matrix, inverse })
    }
}

fn is_identity(metric: &[Vec<Rational>]) -> bool {
    metric.iter().enumerate().all(|(i, row)| {
        row.iter().enumerate().all(|(j, entry)| if i == j { entry.is_one() } else { entry.is_zero() })
    })
}
