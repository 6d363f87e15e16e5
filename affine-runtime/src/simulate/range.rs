//! Where forces of a flat body leave the range of numbers before its placement does.

use super::halt::Reason;
use super::point::is_clearly_positive;
use crate::frames::Matrix;
use crate::kinematics::LogDeterminant;

/// Refuses a placement at which `1/det phi` is no normal number. A number that underflows would leave the force out
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
