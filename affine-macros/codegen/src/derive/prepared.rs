//! What is computed when the fields have values: conditions, coefficients, inverse blocks.

use crate::algebra::bind::Constants;
use crate::algebra::ring::upper;
use crate::algebra::{Arena, Expr, Polynomial};
use crate::ir::Program;
use crate::mechanics::direction::Direction;
use crate::mechanics::forces::Forces;
use crate::mechanics::motion::Motion;
use crate::mechanics::term::Coefficient;
use crate::symbol::Quantity;

use super::batch::unbound;
use super::well_posed::{Condition, Damping, Factor, NumericBlock, Relation};

/// What `prepare()` has to find not negative in the dissipation.
pub(super) fn damping(arena: &mut Arena, forces: &Forces) -> Damping {
    let mut damping = Damping::default();
    let Some(dissipation) = &forces.dissipation else { return damping };
    let mut known: Vec<(&'static str, &'static str, Polynomial)> = Vec::new();
    for part in &dissipation.parts {
        let isotropic = part.form.terms.iter().all(|term| matches!(term.value, Coefficient::Scalar(_)));
        for block in &part.hessian.blocks {
            match block.eigenvalue() {
                Some(value) => {
                    let (name, directions) = match block.basis[0].kind {
                        Direction::Shear if isotropic => ("I + A", "symmetric traceless velocities (shear)"),
                        Direction::Rotation if isotropic => ("I - A", "skew velocities (rotation)"),
                        Direction::Dilatation if isotropic => {
                            ("I + A + n B", "multiples of the identity (dilatation)")
                        }
                        _ => ("an eigenvalue of R", "one direction of the velocity"),
                    };
                    known.push((name, directions, value));
                }
                None if block.numbers().is_none() => {
                    damping.blocks.push(form_block(arena, &block.form, false))
                }
                None => {}
            }
        }
    }
    for (_, coefficient) in &dissipation.centre {
        known.push(("the coefficient", "the velocity of the centre of mass", coefficient.clone()));
    }
    let mut listed: Vec<(&'static str, &'static str, Polynomial)> = Vec::new();
    for (name, directions, value) in known {
        if !listed.contains(&(name, directions, value.clone())) {
            let (factor, asked) = (Factor::Eigenvalue(name), (Relation::MomentumOfVelocity, false));
            damping.conditions.extend(Condition::of(arena, (factor, directions), asked, &value));
            listed.push((name, directions, value));
        }
    }
    damping
}

impl Condition {
    /// That on a value; none on a number, which the checks have seen.
    pub(super) fn of(
        arena: &mut Arena,
        (factor, directions): (Factor, &'static str),
        (relation, positive): (Relation, bool),
        value: &Polynomial,
    ) -> Option<Self> {
        value.as_constant().is_none().then(|| {
            let program = values(arena, std::iter::once(value.clone()).chain(summands(value)));
            Self { factor, directions, relation, positive, program }
        })
    }
}

/// The terms of a sum, each a polynomial: their sizes say how much of it rounding can make.
fn summands(sum: &Polynomial) -> Vec<Polynomial> {
    sum.terms().map(|(monomial, c)| Polynomial::term(monomial.clone(), c.clone())).collect()
}

/// The program of values over the fields alone.
pub(super) fn values(arena: &mut Arena, values: impl Iterator<Item = Polynomial>) -> Program {
    unbound(arena, values.enumerate().map(|(k, p)| (Quantity::Value.at([k + 1]), p)).collect())
}

pub(super) fn coefficient_program(arena: &mut Arena, coefficients: &Constants) -> Program {
    let results = coefficients.entries.iter().map(|(s, p)| (arena.symbol_of(*s), p.clone())).collect();
    unbound(arena, results)
}

/// The inverse blocks that only the fields' values give.
pub(super) fn numeric_blocks(arena: &mut Arena, motion: &Motion, required: bool) -> Vec<NumericBlock> {
    let positive = required || motion.polynomial().is_some_and(|(kinetic, _)| kinetic.is_dalembert());
    motion
        .numeric_blocks()
        .iter()
        .map(|block| {
            let name = |s: Expr| arena.symbol_of(s);
            let inverse = upper(block.form.len()).map(|(i, j)| name(block.inverse[i][j])).collect();
            NumericBlock { inverse, basis: block.basis.clone(), ..form_block(arena, &block.form, positive) }
        })
        .collect()
}

/// A symmetric form to be looked at in numbers.
fn form_block(arena: &mut Arena, form: &[Vec<Polynomial>], positive: bool) -> NumericBlock {
    let size = form.len();
    let entries: Vec<Polynomial> = upper(size).map(|(i, j)| form[i][j].clone()).collect();
    let sizes: Vec<Polynomial> = entries.iter().flat_map(summands).collect();
    let program = values(arena, entries.into_iter().chain(sizes));
    NumericBlock { program, inverse: Vec::new(), basis: Vec::new(), size, positive }
}
