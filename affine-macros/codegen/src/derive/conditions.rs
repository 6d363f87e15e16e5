//! What is known of the mass matrix before the fields or a placement are, and what is checked then.

use crate::algebra::bind::Constants;
use crate::algebra::ring::{Square, determinant};
use crate::algebra::{Arena, Function, Matrix, Polynomial, Rational};
use crate::mechanics::form::Positive;
use crate::mechanics::hessian::Hessian;
use crate::mechanics::metric::Definitions;
use crate::mechanics::mixed::Factorisation;
use crate::mechanics::motion::Motion;
use crate::mechanics::term::{Coefficient, TermKind};
use crate::optimise::Batch;
use crate::symbol::Quantity;

use super::batch::{numbered, program};
use super::model::Regularity;
use super::well_posed::{Condition, Factor, Relation, eigenvalue};

/// What `prepare()` has to check once the fields have values: the eigenvalues of a constant mass matrix, masses, the inertia
/// of d'Alembert's energy.
pub(super) fn conditions(
    arena: &mut Arena,
    motion: &Motion,
    hessian: Option<&Hessian>,
    require_positive: bool,
) -> Vec<Condition> {
    let dalembert = motion.polynomial().is_some_and(|(kinetic, _)| kinetic.is_dalembert());
    let terms = || motion.internal().flat_map(|part| &part.terms);
    // Masses are positive, whatever stands beside their energy.
    let same = |kind| motion.constraint().map_or(kind, |group| group.same_as(kind));
    let inertia = terms().find(|term| same(term.kind) == TermKind::Dalembert).map(|term| &term.value);
    let tensor = terms().any(|term| matches!(term.value, Coefficient::Matrix(_)));
    let mut list: Vec<(Factor, &'static str, bool, Polynomial)> = Vec::new();
    for (direction, value) in hessian.into_iter().flat_map(Hessian::eigenvalues) {
        let (name, directions) = match dalembert {
            // J has its eigenvalues once for each row of phi_dot, whatever the basis.
            true => ("J", "a row of phi_dot"),
            false => eigenvalue(direction).unwrap_or(("K", "one entry of the affine velocity")),
        };
        // A tensor has no I, A and B of its own.
        let factor = Factor::Eigenvalue(if tensor && !dalembert { "the eigenvalue of T" } else { name });
        if !list.iter().any(|(known, on, _, same)| (*known, *on) == (factor, directions) && *same == value) {
            list.push((factor, directions, require_positive || dalembert, value));
        }
    }
    for mass in motion.masses.list() {
        let mass = Polynomial::normal_form(arena, mass);
        let positive = require_positive || inertia.is_some();
        list.push((Factor::Mass("m"), "the velocity of the centre of mass", positive, mass));
    }
    if let Some(inertia) = inertia.filter(|_| !dalembert) {
        let minors = leading_minors(arena, inertia).into_iter();
        list.extend(minors.map(|minor| (Factor::Minor, "a row of phi_dot", true, minor)));
    }
    let condition = |(factor, directions, positive, value)| {
        Condition::of(arena, (factor, directions), (Relation::MomentumOfVelocity, positive), &value)
    };
    list.into_iter().filter_map(condition).collect()
}

/// The leading minors of `J`, all positive iff `J` is (Sylvester); `I` for `J = I 1`.
fn leading_minors(arena: &mut Arena, inertia: &Coefficient) -> Vec<Polynomial> {
    match inertia {
        Coefficient::Scalar(i) => vec![Polynomial::normal_form(arena, *i)],
        Coefficient::Matrix(j) => {
            let j = j.normal_form(arena);
            let leading =
                |k: usize| -> Square<Polynomial> { j[..k].iter().map(|row| row[..k].to_vec()).collect() };
            let larger = (2..=j.len()).map(|k| determinant(&leading(k)));
            std::iter::once(j[0][0].clone()).chain(larger).collect()
        }
    }
}

/// What tells at a placement whether the mass matrix is regular, where that is not known for all.
pub(super) fn regularity(
    arena: &mut Arena,
    motion: &Motion,
    positive: Positive,
    required: bool,
    coefficients: &mut Constants,
) -> Option<Option<Regularity>> {
    let mut parts: Vec<(Factorisation, Definitions)> = Vec::new();
    if let Some(internal) = motion.factorised().filter(|_| !positive.internal) {
        parts.push((internal.factorisation.clone(), internal.shared.clone()));
    }
    if motion.masses.are_mixed() && !positive.centre {
        parts.push(motion.masses.factorised(arena)?);
    }
    if parts.is_empty() {
        return Some(None);
    }
    let phi = Matrix::symbols(arena, Quantity::Placement, motion.dim()).0.concat();
    let mut blocks = Vec::new();
    for (factorisation, shared) in parts {
        for (block, count) in factorisation.blocks() {
            let sizes: Vec<Polynomial> =
                block.diagonal().into_iter().map(|entry| size(arena, entry)).collect();
            let values = block.upper.iter().chain(&sizes).cloned();
            let results = numbered(Quantity::Value, values).collect();
            let batch = Batch { shared: shared.clone(), results, ..Batch::default() }.pruned(arena);
            let program = program(arena, &batch, coefficients, &phi);
            blocks.extend(std::iter::repeat_n((program, block.size), count));
        }
    }
    Some(Some(Regularity { blocks, positive: required }))
}

/// Numbers of positive and negative squares, where they are the same at every placement that a motion reaches. With a cubic
/// term the metric depends on the momentum.
pub(super) fn signature(
    arena: &Arena,
    motion: &Motion,
    hessian: Option<&Hessian>,
    positive: Positive,
    required: bool,
) -> Option<(usize, usize)> {
    let squares = motion.degrees_of_freedom();
    if required || (positive.internal && positive.centre) {
        return Some((squares, 0));
    }
    let blocks = hessian.filter(|_| motion.determines_momentum())?.blocks.iter();
    let inertias: Vec<_> = blocks.map(|block| block.inertia(motion.dim())).collect::<Option<_>>()?;
    let of_the_centre = match motion.masses.single() {
        Some(mass) if arena.as_constant(mass)?.is_negative() => motion.dim(),
        None if motion.masses.are_mixed() && !positive.centre => return None,
        _ => 0,
    };
    let negative = of_the_centre + inertias.iter().map(|inertia| inertia.negative).sum::<usize>();
    Some((squares - negative, negative))
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
