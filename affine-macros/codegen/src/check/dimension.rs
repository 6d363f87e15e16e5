//! The dimension.

use crate::diagnostics::{Diagnostics, NotationMistake, Reported};
use crate::spec::Spec;

/// n = 2 or 3: the code is written out component by component, and the closed forms it uses (inverse,
/// exponential, invariants) are those of 2 x 2 and 3 x 3 matrices. For n = 1 there is neither rotation nor
/// shear, and the terms of the kinetic energy coincide.
pub(super) fn two_or_three(spec: &Spec, found: &mut Diagnostics) -> Result<(), Reported> {
    match spec.dim.value {
        2 | 3 => Ok(()),
        other => Err(found.report(spec.dim.span, NotationMistake::Dimension { found: other.to_string() })),
    }
}
