//! The lattice as formulas, in hyperbolic functions.

use crate::algebra::{Arena, Polynomial};
use crate::mechanics::describe::{Formula, Notation, Sum};
use crate::mechanics::potential::Potential;

use super::{Coordinate, Equations};

/// `H` and the equations, component by component; those of constants are left out.
pub fn formulas(
    arena: &mut Arena,
    notation: &Notation,
    equations: &Equations,
    potential: Option<&Potential>,
) -> (Formula, Vec<Formula>) {
    let mut sum = Sum::default();
    let kinetic = notation.polynomial(arena, &equations.kinetic);
    sum.push(false, &kinetic.text, &kinetic.latex);
    if let Some(potential) = potential {
        let Formula { text, latex } = notation.formula(arena, potential.energy);
        sum.push(false, &text, &latex);
    }
    let definitions = notation.definitions(arena, std::iter::once(&equations.kinetic));
    let energy = sum.of("H", "H").with(definitions);
    let moves = |z: &Coordinate, rate: &Polynomial| {
        !rate.is_zero() || matches!(z, Coordinate::Q(_) | Coordinate::P(_))
    };
    let mut list = Vec::new();
    for (z, symbol, rate) in equations.rates.iter().filter(|(z, _, rate)| moves(z, rate)) {
        let mut sum = Sum::default();
        let kinetic = notation.polynomial(arena, rate);
        sum.push(false, &kinetic.text, &kinetic.latex);
        if let (Coordinate::P(a), Some(_)) = (z, potential) {
            let place = equations.rates.iter().find(|(other, ..)| *other == Coordinate::Q(*a));
            let place = notation.formula(arena, place.map_or(*symbol, |(_, place, _)| *place));
            let slope = (format!("dU/d{}", place.text), format!("\\partial U/\\partial {}", place.latex));
            sum.push(true, &slope.0, &slope.1);
        }
        let left = notation.formula(arena, *symbol);
        let right = sum.value();
        list.push(right.of(&format!("d{}/dt", left.text), &format!("\\dot{{{}}}", left.latex)));
    }
    (energy, list)
}
