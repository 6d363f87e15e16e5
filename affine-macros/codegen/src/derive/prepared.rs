//! What is computed when the fields have values, step after step: bases, conditions, inverse blocks; then the coefficients.

use crate::algebra::bind::Constants;
use crate::algebra::ring::upper;
use crate::algebra::{Arena, Polynomial};
use crate::ir::Program;
use crate::mechanics::forces::Forces;
use crate::mechanics::motion::Motion;
use crate::mechanics::term::Coefficient;

use super::batch::{unbound, values};
use super::metrics::{GivenMatrix, Preparation};
use super::splitting::PrincipalProgram;
use super::well_posed::{Condition, Factor, NumericBlock, Relation, eigenvalue};

/// What `prepare()` computes and checks.
pub struct Prepared {
    /// What comes first, in its order; later ones read what earlier ones found.
    pub steps: Vec<Step>,
    /// Coefficients that depend on the fields, and the program that computes them after all steps.
    pub coefficients: Program,
}

/// A step of `prepare()`. Those that check or invert end it where the values do not allow them.
pub enum Step {
    /// The bases in which the metrics are the identity are found, from the entries of `g` and `eta`, row after row.
    Bases([Program; 2]),
    /// An inertia or a tensor is carried to these bases, which are found before.
    Rebased(GivenMatrix),
    /// What must not vanish; the first that does is told.
    WellPosed(Vec<Condition>),
    /// A block is inverted.
    Inverse(NumericBlock),
    /// A form is brought to its principal axes.
    PrincipalAxes(PrincipalProgram),
    /// What must not be negative.
    Semidefinite(Vec<Condition>),
    /// A block whose eigenvalues must not be negative; no inverse is formed.
    SemidefiniteForm(NumericBlock),
}

impl Prepared {
    /// What must not vanish, of all steps.
    pub fn conditions(&self) -> impl Iterator<Item = &Condition> {
        self.steps.iter().flat_map(|step| match step {
            Step::WellPosed(conditions) => conditions.as_slice(),
            _ => &[],
        })
    }

    /// Blocks that are inverted.
    pub fn inverted(&self) -> impl Iterator<Item = &NumericBlock> {
        self.steps.iter().filter_map(|step| match step {
            Step::Inverse(block) => Some(block),
            _ => None,
        })
    }
}

/// All steps in their order: what is carried to orthonormal bases is looked at in them, and else these bases come last.
pub(super) fn in_order(bases: Option<Preparation>, mut checks: Vec<Step>) -> Vec<Step> {
    let Some(Preparation { metrics, matrices }) = bases else { return checks };
    let place = if matrices.is_empty() { checks.len() } else { 0 };
    let bases = std::iter::once(Step::Bases(metrics)).chain(matrices.into_iter().map(Step::Rebased));
    checks.splice(place..place, bases);
    checks
}

/// What must not vanish: eigenvalues share one threshold, masses another, and each minor has its own.
pub(super) fn well_posed(conditions: Vec<Condition>) -> impl Iterator<Item = Step> {
    let mut steps = vec![Vec::new(), Vec::new()];
    for condition in conditions {
        match condition.factor {
            Factor::Eigenvalue(_) => steps[0].push(condition),
            Factor::Mass(_) => steps[1].push(condition),
            Factor::Minor => steps.push(vec![condition]),
        }
    }
    steps.into_iter().filter(|conditions| !conditions.is_empty()).map(Step::WellPosed)
}

/// What `prepare()` has to find not negative in the dissipation.
pub(super) fn damping(arena: &mut Arena, forces: &Forces) -> Vec<Step> {
    let Some(dissipation) = &forces.dissipation else { return Vec::new() };
    let (mut listed, mut blocks) = (Vec::new(), Vec::new());
    let mut list = |name: &'static str, directions: &'static str, value: Polynomial| {
        let condition = (name, directions, value);
        if !listed.contains(&condition) {
            listed.push(condition);
        }
    };
    for part in &dissipation.parts {
        let isotropic = part.form.terms.iter().all(|term| matches!(term.value, Coefficient::Scalar(_)));
        for block in &part.hessian.blocks {
            match block.eigenvalue() {
                Some(value) => {
                    let named = isotropic.then(|| eigenvalue(block.basis[0].kind)).flatten();
                    let (name, directions) =
                        named.unwrap_or(("an eigenvalue of R", "one direction of the velocity"));
                    list(name, directions, value);
                }
                None if block.numbers().is_none() => {
                    blocks.push(Step::SemidefiniteForm(form_block(arena, &block.form, false)));
                }
                None => {}
            }
        }
    }
    for (_, coefficient) in &dissipation.centre {
        list("the coefficient", "the velocity of the centre of mass", coefficient.clone());
    }
    let asked = (Relation::MomentumOfVelocity, false);
    let conditions: Vec<Condition> = listed
        .into_iter()
        .filter_map(|(name, directions, value)| {
            Condition::of(arena, (Factor::Eigenvalue(name), directions), asked, &value)
        })
        .collect();
    let conditions = (!conditions.is_empty()).then_some(Step::Semidefinite(conditions));
    conditions.into_iter().chain(blocks).collect()
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

pub(super) fn coefficient_program(arena: &mut Arena, coefficients: &Constants) -> Program {
    let results = coefficients.entries.iter().map(|(s, p)| (arena.symbol_of(*s), p.clone())).collect();
    unbound(arena, results)
}

/// The blocks that only the fields' values invert.
pub(super) fn inverted(arena: &mut Arena, motion: &Motion, required: bool) -> Vec<Step> {
    let positive = required || motion.polynomial().is_some_and(|(kinetic, _)| kinetic.is_dalembert());
    let blocks = motion.numeric_blocks().iter().map(|block| {
        let inverse = upper(block.form.len()).map(|(i, j)| arena.symbol_of(block.inverse[i][j])).collect();
        NumericBlock { inverse, basis: block.basis.clone(), ..form_block(arena, &block.form, positive) }
    });
    blocks.map(Step::Inverse).collect()
}

/// A symmetric form to be looked at in numbers.
fn form_block(arena: &mut Arena, form: &[Vec<Polynomial>], positive: bool) -> NumericBlock {
    let size = form.len();
    let entries: Vec<Polynomial> = upper(size).map(|(i, j)| form[i][j].clone()).collect();
    let sizes: Vec<Polynomial> = entries.iter().flat_map(summands).collect();
    let program = values(arena, entries.into_iter().chain(sizes));
    NumericBlock { program, inverse: Vec::new(), basis: Vec::new(), size, positive }
}
