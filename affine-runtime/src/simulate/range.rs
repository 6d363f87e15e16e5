//! Where forces of a flat body leave the range of numbers before its placement does.

use super::halt::Reason;
use super::methods::is_canonical;
use super::point::is_clearly_positive;
use crate::kinematics::LogDeterminant;
use crate::model::Model;
use crate::state::Phase;

/// Refuses a placement at which `1/det phi` is no normal number, of a model whose forces contain it: with `q` or `D` in the
/// potential the force on `Pi` is a multiple of `phi^-T`, cofactors times `1/det phi`. A number that underflows would
/// leave the force out without a word.
pub(super) fn in_range<const N: usize, M: Model<N>>(t: f64, point: &M::Point<f64>) -> Result<(), Reason> {
    let needs = M::DESCRIPTION.reduced.iter().any(|group| matches!(group.name, "1/D" | "q"));
    // A determinant whose square is a number is one itself, and so is its inverse.
    if !needs || !is_canonical::<N, M>() || is_clearly_positive(point.phi()) {
        return Ok(());
    }
    let determinant = LogDeterminant::of(point.phi());
    match determinant.is_normal() {
        true => Ok(()),
        false => Err(Reason::Range { q: determinant.mean(), t }),
    }
}
