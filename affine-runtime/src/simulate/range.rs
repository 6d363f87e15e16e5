//! Where `det phi` leaves the range of numbers, and with it methods that form it.

use super::point::is_clearly_positive;
use crate::error::Reason;
use crate::frames::Matrix;
use crate::inner::LogDeterminant;

/// Refuses a placement, in orthonormal bases, at which `det phi` or its inverse is no normal number: a force that underflows would be left out
/// without a word.
pub(super) fn in_range<const N: usize>(t: f64, phi: &Matrix<N>) -> Result<(), Reason> {
    // A determinant whose square is a number is one itself, and so is its inverse.
    if is_clearly_positive(phi) {
        return Ok(());
    }
    let determinant = LogDeterminant::of(phi);
    match determinant.is_normal() {
        true => Ok(()),
        false => Err(Reason::Range { q: determinant.mean(), t }),
    }
}
