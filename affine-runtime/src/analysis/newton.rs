//! Solutions of equations that have whole families of them.

use nalgebra::DVector;

use super::error::AnalysisError;
use super::linear::{Column, Dense, decomposed};

/// Steps that an iteration may take.
const MOST_STEPS: usize = 80;
/// Singular values are not taken to be smaller than this part of the largest: what symmetries make zero at a solution is
/// not quite zero beside it.
pub(super) const FLOOR: f64 = 1e-9;
/// A residual of so many roundings is none.
const ROUNDINGS: f64 = 256.0;
/// Times that a step may be halved.
const HALVINGS: usize = 30;

/// Equations at a point.
pub(super) struct Equations {
    pub(super) values: Column,
    pub(super) jacobian: Dense,
    /// Size of what the values are differences of.
    pub(super) size: f64,
    /// That of each of them.
    pub(super) scale: Column,
}

impl Equations {
    /// Nothing but rounding is left.
    fn are_solved(&self) -> bool {
        let mut values = self.values.iter().zip(&self.scale);
        values.all(|(value, size)| size.is_finite() && value.abs() <= ROUNDINGS * f64::EPSILON * size)
    }
}

/// A solution.
#[derive(Clone, Debug)]
pub(super) struct Solution {
    pub(super) at: Column,
    pub(super) steps: usize,
}

/// The step of Levenberg and Marquardt whose damping falls with the square of the residual: quadratic convergence to the
/// nearest solutions wherever the residual measures the distance from them, isolated or not (N. Yamashita, M. Fukushima,
/// Computing Suppl. 15 (2001) 239).
fn step(equations: &Equations, floor: f64) -> Result<Column, AnalysisError> {
    let Equations { values, jacobian, size, .. } = equations;
    let svd = decomposed(jacobian.clone()).ok_or(AnalysisError::NoDecomposition)?;
    let (Some(u), Some(v_t)) = (&svd.u, &svd.v_t) else { return Err(AnalysisError::NoDecomposition) };
    let largest = svd.singular_values.max();
    let damping = (values.norm() / size).clamp(floor, 1.0) * largest;
    let along = u.tr_mul(values);
    let weighted = DVector::from_fn(along.len(), |k, _| {
        let singular = svd.singular_values[k];
        -along[k] * singular / (singular * singular + damping * damping)
    });
    Ok(v_t.tr_mul(&weighted))
}

/// A solution near a start. `equations` is `None` outside of where they are defined. Their rounding is amplified by at most half
/// of `1/floor`, in the directions of singular values that are about as small.
pub(super) fn solve(
    start: Column,
    floor: f64,
    equations: impl Fn(&Column) -> Option<Equations>,
) -> Result<Solution, AnalysisError> {
    let mut at = start;
    let no_convergence = |residual: f64, steps| AnalysisError::NoConvergence { residual, steps };
    let mut now = equations(&at).ok_or(no_convergence(f64::NAN, 0))?;
    for steps in 0..MOST_STEPS {
        let (residual, is_solved) = (now.values.norm(), now.are_solved());
        if !residual.is_finite() {
            return Err(no_convergence(residual, steps));
        }
        let full_step = step(&now, floor)?;
        let better = (0..HALVINGS).find_map(|halvings| {
            let next = &at + &full_step * 0.5_f64.powi(halvings as i32);
            let there = equations(&next)?;
            (there.values.norm() < residual).then_some((next, there))
        });
        match better {
            // The last steps go as far as rounding lets them.
            Some((next, there)) if !is_solved || there.values.norm() < 0.5 * residual => {
                (at, now) = (next, there);
            }
            _ if is_solved => return Ok(Solution { at, steps }),
            _ => return Err(no_convergence(residual, steps)),
        }
    }
    Err(no_convergence(now.values.norm(), MOST_STEPS))
}
