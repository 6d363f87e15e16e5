//! Points modulo a prime at which quantities with definitions have values: what is not zero there is no identity.

use std::collections::HashMap;

use crate::algebra::evaluate::{Field, evaluate_polynomial};
use crate::algebra::residue::Residue;
use crate::algebra::{Arena, Polynomial, Rational};
use crate::mechanics::charts::Chart;
use crate::mechanics::constraint::Constraint;
use crate::mechanics::group_point::GroupPoint;
use crate::mechanics::metric::Definitions;

/// A point: parameters and coordinates have values that depend on their names and on the point's own.
#[derive(Clone, Debug)]
pub struct Sample {
    point: &'static str,
    undeformed: bool,
    defined: HashMap<String, Residue>,
}

impl Sample {
    /// A generic point of that name.
    #[must_use]
    pub fn generic(point: &'static str) -> Self {
        Self { point, undeformed: false, defined: HashMap::new() }
    }

    /// The undeformed placement `phi = 1`.
    #[must_use]
    pub fn undeformed() -> Self {
        Self { point: "", undeformed: true, defined: HashMap::new() }
    }

    /// A point of the constraint group with a projected momentum, one for each seed.
    #[must_use]
    pub fn on_the_group(arena: &Arena, chart: &Chart, group: Constraint, seed: usize) -> Self {
        let point = ["first.", "second.", "third."][seed % 3];
        Self { point, undeformed: false, defined: GroupPoint::values(arena, chart, group, seed) }
    }

    fn of_name(&self, name: &str) -> Residue {
        match name.strip_prefix("phi_").map(str::as_bytes) {
            Some([i, a]) if self.undeformed => {
                Residue::from_rational(if i == a { &Rational::ONE } else { &Rational::ZERO })
            }
            _ => Residue::sample(&format!("{}{name}", self.point)),
        }
    }

    /// The value of a polynomial.
    #[must_use]
    pub fn value(&self, arena: &Arena, polynomial: &Polynomial) -> Residue {
        let known = |name: &str| Some(self.defined.get(name).copied().unwrap_or_else(|| self.of_name(name)));
        evaluate_polynomial(arena, polynomial, &known).unwrap_or(Residue::UNKNOWN)
    }

    /// Gives quantities the values of their definitions, in order.
    pub fn define(&mut self, arena: &Arena, definitions: &Definitions) {
        for (symbol, definition) in definitions {
            let value = self.value(arena, definition);
            if let Some(name) = arena.name(*symbol) {
                self.defined.insert(name.to_owned(), value);
            }
        }
    }
}
