//! What a run looks at in a potential: functions of the placement, of `x` and of the time that keep their sign where it has a
//! value, and angles that the time turns.

use crate::algebra::{Arena, Expr, Rational};
use crate::mechanics::constraint::Constraint;

use super::restriction::restricted;

/// A part of a potential that has a value only where a function of the state keeps its sign, or that the time turns.
#[derive(Clone, Debug)]
pub struct Guard {
    /// The part as written: `ln(q)`, `1/x[1]`.
    pub part: String,
    /// The function, as written: `q`, `x[1]`.
    pub argument: String,
    /// Which signs it may have.
    pub bound: Bound,
    /// Its value.
    pub value: Expr,
}

/// The signs that a function of the state may have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bound {
    /// Above zero: the argument of a logarithm.
    Positive,
    /// Zero or above: the argument of a root.
    NotNegative,
    /// The sign that it has at the start: a divisor.
    NotZero,
    /// Any, but steps have to see it change: the argument of a periodic function that contains the time.
    Angle,
}

impl Bound {
    fn admits(self, value: &Rational) -> bool {
        match self {
            Self::Positive => !value.is_zero() && !value.is_negative(),
            Self::NotNegative => !value.is_negative(),
            Self::NotZero => !value.is_zero(),
            Self::Angle => true,
        }
    }
}

/// The guards on the group of a constraint, without those that hold everywhere; `None` where one holds nowhere.
pub(super) fn confined(
    arena: &mut Arena,
    dim: usize,
    domain: Vec<Guard>,
    group: Constraint,
) -> Option<Vec<Guard>> {
    let mut left = Vec::new();
    for guard in domain {
        let value = restricted(arena, dim, guard.value, group)?;
        match arena.as_constant(value) {
            Some(constant) if !guard.bound.admits(constant) => return None,
            Some(_) => {}
            None => left.push(Guard { value, ..guard }),
        }
    }
    Some(left)
}
