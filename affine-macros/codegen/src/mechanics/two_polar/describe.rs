//! The lattice as formulas, in hyperbolic functions.

use crate::algebra::{Arena, Polynomial};
use crate::mechanics::describe::Formula;
use crate::mechanics::notation::{latex, plain};
use crate::mechanics::potential::Potential;

use super::{Coordinate, Equations};

/// `H` and the equations, component by component; those of constants are left out.
pub fn formulas(
    arena: &mut Arena,
    equations: &Equations,
    potential: Option<&Potential>,
) -> (Formula, Vec<Formula>) {
    let kinetic = equations.kinetic.expression(arena);
    let (mut text, mut formula) =
        (format!("H = {}", plain(arena, kinetic)), format!("H = {}", latex(arena, kinetic)));
    if let Some(potential) = potential {
        text += &format!(" + {}", plain(arena, potential.energy));
        formula += &format!(" + {}", latex(arena, potential.energy));
    }
    let force = |z: &Coordinate| match (z, potential) {
        (Coordinate::P(_), Some(_)) => (" - dU/dq", " - \\partial U/\\partial q"),
        _ => ("", ""),
    };
    let rates: Vec<(&Coordinate, crate::algebra::Expr, Polynomial)> = equations
        .rates
        .iter()
        .filter(|(z, _, rate)| !rate.is_zero() || matches!(z, Coordinate::Q(_) | Coordinate::P(_)))
        .map(|(z, symbol, rate)| (z, *symbol, rate.clone()))
        .collect();
    let list = rates
        .into_iter()
        .map(|(z, symbol, rate)| {
            let form = rate.expression(arena);
            let (force, force_latex) = force(z);
            Formula {
                text: format!("d{}/dt = {}{force}", plain(arena, symbol), plain(arena, form)),
                latex: format!("\\dot{{{}}} = {}{force_latex}", latex(arena, symbol), latex(arena, form)),
            }
        })
        .collect();
    (Formula { text, latex: formula }, list)
}
