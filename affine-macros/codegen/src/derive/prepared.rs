//! What is computed when the fields have values: conditions, coefficients, inverse blocks.

use crate::algebra::bind::Constants;
use crate::algebra::{Arena, Expr, Polynomial, Rational};
use crate::ir::Program;
use crate::ir::fuse::fuse;
use crate::mechanics::direction::Direction;
use crate::mechanics::forces::Forces;
use crate::mechanics::hamiltonian::Hamiltonian;
use crate::mechanics::kinetic::Kinetic;
use crate::mechanics::term::{Coefficient, TermKind};
use crate::optimise::{Batch, straight_line};
use crate::symbol::Quantity;

use super::well_posed::{Condition, Damping, NumericBlock, Relation};

/// What `prepare()` has to check once the fields have values.
pub(super) fn conditions(
    arena: &mut Arena,
    kinetic: &Kinetic,
    eigenvalues: Vec<(Direction, Polynomial)>,
    require_positive: bool,
) -> Vec<Condition> {
    let dalembert = kinetic.is_dalembert();
    // Masses are positive, whatever stands beside their energy.
    let inertia = kinetic.terms.iter().find(|term| term.kind == TermKind::Dalembert).map(|term| &term.value);
    let tensor = kinetic.terms.iter().any(|term| matches!(term.value, Coefficient::Matrix(_)));
    let mut list: Vec<(&'static str, &'static str, bool, Polynomial)> = Vec::new();
    for (direction, value) in eigenvalues {
        let (name, directions) = match direction {
            // J has its eigenvalues once for each row of phi_dot, whatever the basis.
            _ if dalembert => ("J", "a row of phi_dot"),
            Direction::Shear => ("I + A", "symmetric traceless velocities (shear)"),
            Direction::Rotation => ("I - A", "skew velocities (rotation)"),
            Direction::Dilatation => ("I + A + n B", "multiples of the identity (dilatation)"),
            Direction::Entry => ("K", "one entry of the affine velocity"),
        };
        // A tensor has no I, A and B of its own.
        let name = if tensor && !dalembert { "the eigenvalue of T" } else { name };
        if !list.iter().any(|(known, on, _, same)| (*known, *on) == (name, directions) && *same == value) {
            list.push((name, directions, require_positive || dalembert, value));
        }
    }
    if let Some(t) = kinetic.translation
        && arena.as_constant(t.mass).is_none()
    {
        let mass = Polynomial::normal_form(arena, t.mass);
        let positive = require_positive || inertia.is_some();
        list.push(("m", "the velocity of the centre of mass", positive, mass));
    }
    if let Some(inertia) = inertia.filter(|_| !dalembert) {
        let minors = leading_minors(arena, inertia).into_iter().filter(|minor| minor.as_constant().is_none());
        list.extend(minors.map(|minor| ("a leading minor of J", "a row of phi_dot", true, minor)));
    }
    list.into_iter()
        .map(|(name, directions, positive, value)| {
            let sizes = summands(&value);
            let program = unbound(arena, std::iter::once(value).chain(sizes));
            Condition { name, directions, relation: Relation::MomentumOfVelocity, positive, program }
        })
        .collect()
}

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
        let again = listed.contains(&(name, directions, value.clone()));
        if value.as_constant().is_none() && !again {
            listed.push((name, directions, value.clone()));
            let program = unbound(arena, std::iter::once(value.clone()).chain(summands(&value)));
            let relation = Relation::MomentumOfVelocity;
            damping.conditions.push(Condition { name, directions, relation, positive: false, program });
        }
    }
    damping
}

/// The leading minors of `J`, all positive iff `J` is (Sylvester); `I` for `J = I 1`.
pub(super) fn leading_minors(arena: &mut Arena, inertia: &Coefficient) -> Vec<Polynomial> {
    match inertia {
        Coefficient::Scalar(i) => vec![Polynomial::normal_form(arena, *i)],
        Coefficient::Matrix(j) => {
            let mut normal_form = |e: &Expr| Polynomial::normal_form(arena, *e);
            let j: Vec<Vec<Polynomial>> =
                j.0.iter().map(|row| row.iter().map(&mut normal_form).collect()).collect();
            let leading =
                |k: usize| -> Vec<Vec<Polynomial>> { j[..k].iter().map(|row| row[..k].to_vec()).collect() };
            (1..=j.len()).map(|k| determinant(&leading(k))).collect()
        }
    }
}

/// By the first row.
fn determinant(rows: &[Vec<Polynomial>]) -> Polynomial {
    let Some((first, below)) = rows.split_first() else { return Polynomial::constant(Rational::ONE) };
    let mut sum = Polynomial::zero();
    for (column, value) in first.iter().enumerate() {
        let without = |row: &Vec<Polynomial>| [&row[..column], &row[column + 1..]].concat();
        let minor: Vec<Vec<Polynomial>> = below.iter().map(without).collect();
        let sign = if column % 2 == 0 { Rational::ONE } else { Rational::MINUS_ONE };
        sum.add_product(value, &determinant(&minor), &sign);
    }
    sum
}

/// The terms of a sum, each a polynomial: their sizes say how much of it rounding can make.
pub(super) fn summands(sum: &Polynomial) -> Vec<Polynomial> {
    sum.terms().map(|(monomial, c)| Polynomial::term(monomial.clone(), c.clone())).collect()
}

/// A program over the fields alone.
pub(super) fn unbound(arena: &mut Arena, values: impl Iterator<Item = Polynomial>) -> Program {
    let results = values.enumerate().map(|(k, p)| (format!("value_{}", k + 1), p)).collect();
    let batch = Batch { results, ..Batch::default() };
    fuse(&straight_line(arena, &batch, &mut Constants::new(Quantity::Coefficient), &|_| true))
}

pub(super) fn coefficient_program(arena: &mut Arena, coefficients: &Constants) -> Program {
    let results = coefficients.entries.iter().map(|(s, p)| (arena.symbol_name(*s), p.clone())).collect();
    let batch = Batch { results, ..Batch::default() };
    fuse(&straight_line(arena, &batch, &mut Constants::new(Quantity::Coefficient), &|_| true))
}

pub(super) fn numeric_blocks(arena: &mut Arena, h: &Hamiltonian, positive: bool) -> Vec<NumericBlock> {
    h.numeric_blocks
        .iter()
        .map(|block| {
            let name = |s: Expr| arena.symbol_name(s);
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
    let program = unbound(arena, entries.into_iter().chain(sizes));
    NumericBlock { program, inverse: Vec::new(), basis: Vec::new(), size, positive }
}

/// Places of an upper triangle, row after row.
fn upper(size: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..size).flat_map(move |i| (i..size).map(move |j| (i, j)))
}
