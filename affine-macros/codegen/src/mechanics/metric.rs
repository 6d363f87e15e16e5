//! Quantities with their definitions.

use crate::algebra::{Expr, Polynomial};

/// Quantities with their definitions, each in earlier ones.
pub type Definitions = Vec<(Expr, Polynomial)>;

/// Adds definitions of what has none yet. Two may define a quantity that they share; either definition has its value.
pub fn share(known: &mut Definitions, definitions: impl IntoIterator<Item = (Expr, Polynomial)>) {
    for (symbol, definition) in definitions {
        if known.iter().all(|(other, _)| *other != symbol) {
            known.push((symbol, definition));
        }
    }
}
