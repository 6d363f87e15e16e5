//! Quantities that polynomials share, each defined through others.

use rustc_hash::FxHashSet;

use super::arena::{Arena, Expr};
use super::polynomial::Polynomial;

/// Every symbol that some polynomials use, inside functions and reciprocals too.
pub fn used<'a>(arena: &Arena, polynomials: impl IntoIterator<Item = &'a Polynomial>) -> FxHashSet<Expr> {
    needed(arena, &[], polynomials)
}

/// The same with what the definitions of these symbols use.
pub fn needed<'a>(
    arena: &Arena,
    shared: &'a [(Expr, Polynomial)],
    polynomials: impl IntoIterator<Item = &'a Polynomial>,
) -> FxHashSet<Expr> {
    let mut found = FxHashSet::default();
    let mut open: Vec<&Polynomial> = polynomials.into_iter().collect();
    while let Some(polynomial) = open.pop() {
        polynomial.any_symbol(arena, &mut |symbol| {
            if found.insert(symbol) {
                open.extend(shared.iter().filter(|(known, _)| *known == symbol).map(|(_, value)| value));
            }
            false
        });
    }
    found
}
