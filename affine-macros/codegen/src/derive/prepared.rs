//! What is computed when the fields have values: conditions, coefficients, inverse blocks.

use crate::algebra::bind::Constants;
use crate::algebra::{Arena, Expr, Polynomial};
use crate::ir::Program;
use crate::ir::fuse::fuse;
use crate::mechanics::hamiltonian::Hamiltonian;
use crate::mechanics::hessian::Direction;
use crate::mechanics::kinetic::{Frame, Kinetic};
use crate::optimise::{Batch, straight_line};

use super::{Condition, NumericBlock};

/// What `prepare()` has to check once the fields have values.
pub(super) fn conditions(
    arena: &mut Arena,
    kinetic: &Kinetic,
    eigenvalues: Vec<(Direction, Polynomial)>,
    require_positive: bool,
) -> Vec<Condition> {
    let dalembert = kinetic.frame == Frame::Flat;
    let mut list: Vec<(&'static str, &'static str, bool, Polynomial)> = eigenvalues
        .into_iter()
        .map(|(direction, value)| {
            let (name, directions) = match direction {
                Direction::Shear => ("I + A", "symmetric traceless velocities (shear)"),
                Direction::Rotation => ("I - A", "skew velocities (rotation)"),
                Direction::Dilatation => ("I + A + n B", "multiples of the identity (dilatation)"),
                Direction::Entry => ("J", "a row of phi_dot"),
            };
            (if dalembert { "J" } else { name }, directions, require_positive || dalembert, value)
        })
        .collect();
    if let Some(t) = kinetic.translation
        && arena.as_constant(t.mass).is_none()
    {
        let mass = Polynomial::normal_form(arena, t.mass);
        list.push(("m", "the velocity of the centre of mass", require_positive || dalembert, mass));
    }
    list.into_iter()
        .map(|(name, directions, positive, value)| {
            let sizes: Vec<Polynomial> =
                value.terms().map(|(m, c)| Polynomial::term(m.clone(), c.clone())).collect();
            let program = unbound(arena, std::iter::once(value).chain(sizes));
            Condition { name, directions, positive, program }
        })
        .collect()
}

/// A program over the fields alone.
fn unbound(arena: &mut Arena, values: impl Iterator<Item = Polynomial>) -> Program {
    let results = values.enumerate().map(|(k, p)| (format!("value_{}", k + 1), p)).collect();
    let batch = Batch { shared: Vec::new(), results };
    fuse(&straight_line(arena, &batch, &mut Constants::new("c"), &|_| true))
}

pub(super) fn coefficient_program(arena: &mut Arena, coefficients: &Constants) -> Program {
    let results = coefficients
        .entries
        .iter()
        .map(|(s, p)| (arena.name(*s).unwrap_or("c").to_owned(), p.clone()))
        .collect();
    let batch = Batch { shared: Vec::new(), results };
    fuse(&straight_line(arena, &batch, &mut Constants::new("c"), &|_| true))
}

pub(super) fn numeric_blocks(arena: &mut Arena, h: &Hamiltonian, positive: bool) -> Vec<NumericBlock> {
    h.numeric_blocks
        .iter()
        .map(|block| {
            let size = block.form.len();
            let upper: Vec<(usize, usize)> = (0..size).flat_map(|i| (i..size).map(move |j| (i, j))).collect();
            let name = |s: Expr| arena.name(s).unwrap_or("inverse").to_owned();
            let inverse = upper.iter().map(|(i, j)| name(block.inverse[*i][*j])).collect();
            let program = unbound(arena, upper.iter().map(|(i, j)| block.form[*i][*j].clone()));
            NumericBlock { program, inverse, size, positive }
        })
        .collect()
}
