//! Support for emitted dissipation functions: forms that must not be negative.

use crate::error::{Error, IllPosed, Result};
use crate::reduction::{Condition, jacobi, symmetric};
use crate::scalar::Real;

/// Holds every value against zero, less `eps` times the largest sum of sizes: a form that rounding alone makes
/// negative is semidefinite.
///
/// # Errors
/// [`Error::IllPosed`] with the first condition that fails.
pub fn semidefinite(conditions: &[Condition]) -> Result<()> {
    let scale = conditions.iter().map(|c| c.size).fold(0.0, f64::max);
    conditions.iter().try_for_each(|c| not_negative(c.condition, c.reason, c.value, scale))
}

/// Holds every eigenvalue of a symmetric form, given by its upper triangle, against zero; `M = K (K + 1)/2`, `size` is
/// that of the terms of all entries.
///
/// # Errors
/// [`Error::IllPosed`] with the first eigenvalue that is negative.
pub fn semidefinite_form<const K: usize, const M: usize, T: Real>(upper: [T; M], size: f64) -> Result<()> {
    jacobi::<K, f64>(symmetric(&upper.map(Real::to_f64))).values.into_iter().try_for_each(|value| {
        not_negative(
            "R >= 0 on every velocity",
            "where the dissipation function R is negative, its forces would feed energy in",
            value,
            size,
        )
    })
}

fn not_negative(condition: &'static str, reason: &'static str, value: f64, size: f64) -> Result<()> {
    let threshold = -f64::EPSILON * size;
    // NaN holds nothing.
    if value >= threshold && value.is_finite() {
        return Ok(());
    }
    Err(Error::IllPosed(IllPosed { condition, reason, value, threshold, velocity: None }))
}
