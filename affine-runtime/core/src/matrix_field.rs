//! Support for emitted `prepare()`: fields of matrix type.

use crate::error::{Error, IllPosed, Result};
use crate::scalar::Real;

/// The symmetric part `(J + J^T)/2` of a matrix that is symmetric up to rounding: `|J - J^T| <= 4 K eps |J|` in the
/// largest entries, which a product of three `K x K` matrices such as `R D R^T` keeps (Higham, Accuracy and Stability
/// of Numerical Algorithms, section 3.5).
///
/// # Errors
/// [`Error::FieldNotFinite`] with the first entry that is not finite; [`Error::IllPosed`] with the largest `|J_ab - J_ba|`.
pub fn symmetric_part<const K: usize, T: Real>(
    field: &'static str,
    entries: [[T; K]; K],
    condition: &'static str,
    reason: &'static str,
) -> Result<[[T; K]; K]> {
    let half = T::from_f64(0.5);
    let symmetric = |a: usize, b: usize| half * entries[a][b] + half * entries[b][a];
    let rows = entries.map(|row| row.map(Real::to_f64));
    let places = || (0..K).flat_map(|a| (0..K).map(move |b| (a, b)));
    if let Some((a, b)) = places().find(|&(a, b)| !rows[a][b].is_finite()) {
        return Err(Error::FieldNotFinite { field, entry: Some((a + 1, b + 1)), value: rows[a][b] });
    }
    let largest = |sizes: &mut dyn Iterator<Item = f64>| sizes.fold(0.0, f64::max);
    let value = largest(&mut places().map(|(a, b)| (rows[a][b] - rows[b][a]).abs()));
    let threshold =
        4.0 * K as f64 * f64::EPSILON * largest(&mut rows.iter().flatten().map(|entry| entry.abs()));
    if value > threshold {
        return Err(Error::IllPosed(IllPosed { condition, reason, value, threshold, velocity: None }));
    }
    Ok(core::array::from_fn(|a| core::array::from_fn(|b| symmetric(a, b))))
}
