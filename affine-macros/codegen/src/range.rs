//! Numbers of a derived model that no double holds, and what of the specification they come from.
//!
//! Coefficients are exact: their products, quotients and powers may be of any size. Which numbers are written down is known
//! when the model is derived.

use crate::algebra::{Arena, Rational};
use crate::derive::{Model, Written};
use crate::diagnostics::{Diagnostics, ExpressionMistake, Reported};
use crate::ir::build::Builder;
use crate::lower::{self, Lowered};
use crate::spec::{Expression, Spec};
use crate::symbol::Quantity;

/// Every number of the model keeps its digits as a double. One that does not is blamed on the smallest expressions that
/// have such a number themselves; where only the derivation makes it, on the expression with the number farthest from 1.
///
/// # Errors
/// [`Reported`] on these expressions.
pub fn representable(spec: &Spec, model: &Model, found: &mut Diagnostics) -> Result<(), Reported> {
    let Some(number) = hardest(model).filter(|number| !number.fits_a_double()) else { return Ok(()) };
    let sources = sources(spec);
    let most = sources.iter().filter_map(|source| source.difficulty(source.whole)).max();
    let (limit, reports) = match most {
        Some(Difficulty { beyond: true, .. }) => (Difficulty { beyond: true, distance: 0 }, usize::MAX),
        most => (most.unwrap_or_default(), 1),
    };
    let mut culprits = Vec::new();
    sources.iter().for_each(|source| source.culprits(source.whole, &limit, &mut culprits));
    for (source, culprit) in culprits.into_iter().take(reports) {
        let own = source.number(culprit).filter(|own| !own.fits_a_double());
        let mistake = ExpressionMistake::ValueRange {
            expression: culprit.to_string(),
            number: own.as_ref().unwrap_or(number).about(),
        };
        found.report(culprit.span, mistake);
    }
    found.verdict()
}

/// How hard a number is to hold.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
struct Difficulty {
    /// It loses digits as a double.
    beyond: bool,
    /// Powers of two between it and 1.
    distance: u64,
}

impl Difficulty {
    fn of(number: &Rational) -> Self {
        Self { beyond: !number.fits_a_double(), distance: number.binary_exponent().unsigned_abs() }
    }
}

fn hardest(written: &impl Written) -> Option<&Rational> {
    written.numbers().into_iter().max_by_key(|number| Difficulty::of(number))
}

/// An expression of the specification.
struct Source<'s> {
    whole: &'s Expression,
    spec: &'s Spec,
    lower: fn(&mut Arena, &Spec, &Expression) -> Lowered,
}

fn sources(spec: &Spec) -> Vec<Source<'_>> {
    let coefficients = spec.coefficients().map(|whole| Source {
        whole,
        spec,
        lower: |arena, spec, part| lower::expression(arena, spec.dim.value, part),
    });
    let potential = spec.potential.iter().map(|potential| Source {
        whole: &potential.energy,
        spec,
        lower: |arena, spec, part| {
            let difference = arena.symbol(Quantity::Difference);
            lower::energy(arena, spec, part, Some(difference))
        },
    });
    coefficients.chain(potential).collect()
}

impl<'s> Source<'s> {
    /// The hardest number of a part as it stands.
    fn number(&self, part: &Expression) -> Option<Rational> {
        let (mut arena, mut builder) = (Arena::new(), Builder::new());
        let value = (self.lower)(&mut arena, self.spec, part).ok()?;
        builder.output(&arena, Quantity::Value, value);
        hardest(&builder.finish()).cloned()
    }

    fn difficulty(&self, part: &Expression) -> Option<Difficulty> {
        self.number(part).as_ref().map(Difficulty::of)
    }

    /// The smallest parts with a number as hard as this.
    fn culprits<'a>(
        &'a self,
        part: &'s Expression,
        limit: &Difficulty,
        found: &mut Vec<(&'a Self, &'s Expression)>,
    ) {
        if self.difficulty(part).unwrap_or_default() < *limit {
            return;
        }
        let before = found.len();
        part.operands().into_iter().for_each(|operand| self.culprits(operand, limit, found));
        if found.len() == before {
            found.push((self, part));
        }
    }
}
