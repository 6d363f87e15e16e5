//! Where `det phi` leaves the range of numbers, and with it methods that form it.

use super::course::Course;
use super::layout::carries_dilatation;
use super::point::is_clearly_positive;
use crate::error::Reason;
use crate::frames::Matrix;
use crate::inner::LogDeterminant;
use crate::model::Model;
use crate::state::Phase;

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

/// Methods may be taken that form `det phi`, and that a time within a step costs a step.
pub(super) fn by_halves<const N: usize, M: Model<N>>(model: &M, course: &Course<'_, M::Point<f64>>) -> bool {
    let in_reach = const { !carries_dilatation(&M::DESCRIPTION) }
        || in_range(course.t0, model.orthonormal(course.start).phi()).is_ok();
    !course.within_steps && in_reach
}
