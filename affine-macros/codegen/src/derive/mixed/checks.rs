//! What is known of the mass matrix before a placement is, and what is checked at one.

use crate::algebra::bind::Constants;
use crate::algebra::{Arena, Function, Matrix, Polynomial, Rational};
use crate::derive::prepared::{conditions, leading_minors, numeric_blocks, summands, unbound};
use crate::derive::{Condition, NumericBlock, Regularity};
use crate::ir::fuse::fuse;
use crate::mechanics::form::Positive;
use crate::mechanics::hessian::Hessian;
use crate::mechanics::metric::Definitions;
use crate::mechanics::mixed::Factorisation;
use crate::mechanics::term::TermKind;
use crate::optimise::{Batch, straight_line};
use crate::symbol::Quantity;

use super::{Body, Inner};

impl Body<'_> {
    /// What tells at a placement whether the mass matrix is regular, where that is not known for all.
    pub(super) fn regularity(
        &self,
        arena: &mut Arena,
        positive: Positive,
        required: bool,
        coefficients: &mut Constants,
    ) -> Option<Option<Regularity>> {
        let mut parts: Vec<(Factorisation, Definitions)> = Vec::new();
        if let Some((factorisation, shared)) = self.inner.factorised().filter(|_| !positive.internal) {
            parts.push((factorisation.clone(), shared.clone()));
        }
        if self.masses.are_mixed() && !positive.centre {
            parts.push(self.masses.factorised(arena)?);
        }
        if parts.is_empty() {
            return Some(None);
        }
        let phi = Matrix::symbols(arena, Quantity::Placement, self.mixed.dim).0.concat();
        let mut blocks = Vec::new();
        for (factorisation, shared) in parts {
            for (block, count) in factorisation.blocks() {
                let sizes: Vec<Polynomial> =
                    block.diagonal().into_iter().map(|entry| size(arena, entry)).collect();
                let values = block.upper.iter().chain(&sizes).enumerate();
                let results = values.map(|(k, p)| (format!("value_{}", k + 1), p.clone())).collect();
                let batch = Batch { shared: shared.clone(), results, ..Batch::default() }.pruned(arena);
                let program = fuse(&straight_line(arena, &batch, coefficients, &|a| phi.contains(&a)));
                blocks.extend(std::iter::repeat_n((program, block.size), count));
            }
        }
        Some(Some(Regularity { blocks, positive: required }))
    }

    /// Numbers of positive and negative squares, where they are the same at every placement that a motion reaches.
    pub(super) fn signature(
        &self,
        hessian: Option<&Hessian>,
        positive: Positive,
        required: bool,
    ) -> Option<(usize, usize)> {
        if required || (positive.internal && positive.centre) {
            return Some((self.mixed.degrees_of_freedom(), 0));
        }
        let blocks = hessian.filter(|_| positive.centre)?.blocks.iter();
        let inertias: Vec<_> = blocks.map(|block| block.inertia(self.mixed.dim)).collect::<Option<_>>()?;
        let squares = self.mixed.degrees_of_freedom();
        let negative: usize = inertias.iter().map(|inertia| inertia.negative).sum();
        Some((squares - negative, negative))
    }

    /// What `prepare()` has to check: masses, the inertia of d'Alembert's energy, and a constant mass matrix.
    pub(super) fn conditions(
        &self,
        arena: &mut Arena,
        hessian: Option<&Hessian>,
        required: bool,
    ) -> Vec<Condition> {
        let mut list = match (&self.inner, hessian) {
            (Inner::Constant(kinetic, _), Some(hessian)) => {
                conditions(arena, kinetic, hessian.eigenvalues(), required)
            }
            _ => Vec::new(),
        };
        let mut add = |arena: &mut Arena, name, directions, positive, value: Polynomial| {
            if value.as_constant().is_none() {
                let sizes = summands(&value);
                let program = unbound(arena, std::iter::once(value).chain(sizes));
                list.push(Condition {
                    name,
                    directions,
                    relation: crate::derive::Relation::MomentumOfVelocity,
                    positive,
                    program,
                });
            }
        };
        let terms = self.mixed.internal.iter().flat_map(|part| &part.terms);
        let inertia = terms.filter(|term| term.kind == TermKind::Dalembert).map(|term| &term.value).next();
        if let (Inner::Varying(_), Some(inertia)) = (&self.inner, inertia) {
            for minor in leading_minors(arena, inertia) {
                add(arena, "a leading minor of J", "a row of phi_dot", true, minor);
            }
        }
        for mass in [self.masses.body, self.masses.space].into_iter().flatten() {
            let mass = Polynomial::normal_form(arena, mass);
            add(arena, "m", "the velocity of the centre of mass", required || inertia.is_some(), mass);
        }
        list
    }

    pub(super) fn numeric_blocks(&self, arena: &mut Arena, required: bool) -> Vec<NumericBlock> {
        match &self.inner {
            Inner::Constant(kinetic, h) => numeric_blocks(arena, h, required || kinetic.is_dalembert()),
            Inner::Varying(_) => Vec::new(),
        }
    }
}

/// The sum of the sizes of the terms of a polynomial.
fn size(arena: &mut Arena, polynomial: &Polynomial) -> Polynomial {
    let mut sum = Polynomial::zero();
    for (monomial, c) in polynomial.terms() {
        let value = Polynomial::term(monomial.clone(), Rational::ONE).expression(arena);
        let size = match monomial.is_empty() {
            true => value,
            false => arena.apply(Function::Abs, value),
        };
        sum.add_scaled(&Polynomial::normal_form(arena, size), &c.abs());
    }
    sum
}
