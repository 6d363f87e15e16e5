//! Powers of the dilatation beside tensors.

use crate::algebra::{Arena, Expr, Polynomial};
use crate::mechanics::potential::Potential;
use crate::mechanics::potential::rewriting::through_dilatation;
use crate::mechanics::potential::sums::Sums;
use crate::symbol::Quantity;

impl Potential {
    /// Do tensors in the forces have powers of `D` beyond the third beside them? The product may be of degree 0, and `D^4`
    /// leaves the range of numbers where `phi` does not.
    pub(super) fn is_steep(&self, arena: &mut Arena) -> bool {
        let mut sums = Sums::default();
        let mut forms = Vec::new();
        for (base, slope) in &self.slopes {
            let form = through_dilatation(arena, *slope);
            forms.push((base.degree() > 0, sums.named(arena, form)));
        }
        let mut known = Vec::new();
        for (symbol, form) in sums.forms(arena) {
            let terms = form.terms().map(|(monomial, _)| Steepness::of(arena, monomial, &known)).collect();
            known.push((symbol, terms));
        }
        forms.into_iter().any(|(of_tensor, form)| {
            let form = Polynomial::normal_form(arena, form);
            form.terms().any(|(monomial, _)| {
                let Steepness { up, down, tensors } = Steepness::of(arena, monomial, &known);
                up.max(down) > 2 && (of_tensor || tensors)
            })
        })
    }
}

/// The powers of `D` and `1/D` in a product, and whether there are tensors beside them.
#[derive(Clone, Copy, Default)]
struct Steepness {
    up: usize,
    down: usize,
    tensors: bool,
}

impl Steepness {
    /// With the terms of the sums that stand in the product.
    fn of(arena: &Arena, monomial: &[Expr], sums: &[(Expr, Vec<Self>)]) -> Self {
        let mut all = Self::default();
        for atom in monomial {
            match arena.quantity(*atom) {
                Some(Quantity::Dilatation) => all.up += 1,
                Some(Quantity::InverseDilatation) => all.down += 1,
                _ => {}
            }
            let mut found = |symbol: Expr| arena.quantity(symbol).is_some_and(Quantity::is_tensor);
            all.tensors |= arena.any_symbol(*atom, &mut found);
            let Some((_, terms)) = sums.iter().find(|(symbol, _)| symbol == atom) else { continue };
            let most = |power: fn(&Self) -> usize| terms.iter().map(power).max().unwrap_or(0);
            all.up += most(|term| term.up);
            all.down += most(|term| term.down);
            all.tensors |= terms.iter().any(|term| term.tensors);
        }
        all
    }
}
