//! What a Hamiltonian stated on the momentum side asks of the values of the fields.

use crate::algebra::{Arena, Polynomial};
use crate::mechanics::direction::Direction;
use crate::mechanics::momentum_side::Stated;
use crate::mechanics::term::Frame;

use super::well_posed::{Condition, Factor, Relation};

/// Each eigenvalue of the momentum form, and the inverse mass, is different from zero; nothing is asked of a cubic
/// Hamiltonian, whose velocity is a polynomial in the momentum whatever the coefficients are.
pub(super) fn conditions(arena: &mut Arena, stated: &Stated, positive: bool) -> Vec<Condition> {
    if stated.is_cubic() {
        return Vec::new();
    }
    let without_norm = stated.invariants().skew.is_zero();
    let rotation = match (without_norm, stated.frame) {
        (true, _) => "-casimir2",
        (false, Frame::Space) => "2 spin_squared - casimir2",
        (false, _) => "2 vorticity_squared - casimir2",
    };
    let eigenvalues = stated.eigenvalues();
    let shears = eigenvalues.iter().any(|(direction, _)| *direction == Direction::Shear);
    let mut values: Vec<(Factor, &'static str, Polynomial)> = eigenvalues
        .into_iter()
        .filter_map(|(direction, value)| {
            let (name, directions) = match direction {
                // Without a norm it is the eigenvalue on shears but for its sign, which the former decides.
                Direction::Rotation if without_norm && !positive && shears => return None,
                Direction::Rotation => (rotation, "skew momenta (rotation)"),
                Direction::Dilatation => {
                    ("casimir2 + n casimir1_squared", "multiples of the identity (dilatation)")
                }
                Direction::Shear | Direction::Entry => ("casimir2", "symmetric traceless momenta (shear)"),
            };
            Some((Factor::Eigenvalue(name), directions, value))
        })
        .collect();
    if let Some((_, _, inverse_mass)) = &stated.translation {
        values.push((Factor::Mass("1/m"), "the momentum of the centre of mass", inverse_mass.clone()));
    }
    let asked = (Relation::VelocityOfMomentum, positive);
    let condition = |(factor, directions, value)| Condition::of(arena, (factor, directions), asked, &value);
    values.into_iter().filter_map(condition).collect()
}
