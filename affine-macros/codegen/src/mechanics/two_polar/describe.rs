//! The lattice as formulas, in hyperbolic functions.

use crate::algebra::{Arena, Expr, Polynomial};
use crate::mechanics::describe::{Notation, Sentence, Sum, Summand};
use crate::mechanics::notation::{letters, rate, slope};
use crate::mechanics::potential::Potential;

use super::{Coordinate, Equations};

/// `H` and the equations, component by component; those of constants are left out. Where the volume is kept, forces are less
/// their mean.
pub fn formulas(
    arena: &mut Arena,
    notation: &Notation,
    equations: &Equations,
    potential: Option<&Potential>,
    keeps_volume: bool,
) -> (Sentence, Vec<Sentence>) {
    let mut sum = Sum::new([Summand::plus(notation.polynomial(arena, &equations.kinetic))]);
    if let Some(potential) = potential {
        sum.add_expression(arena, notation, potential.energy);
    }
    let definitions = notation.definitions(arena, std::iter::once(&equations.kinetic));
    let energy = sum.of(letters::HAMILTONIAN).with(definitions);
    let moves = |z: &Coordinate, rate: &Polynomial| {
        !rate.is_zero() || matches!(z, Coordinate::Q(_) | Coordinate::P(_))
    };
    let slope_by = |arena: &mut Arena, place: Expr| slope(letters::POTENTIAL, notation.scalar(arena, place));
    let is_place = |z: &Coordinate| matches!(z, Coordinate::Q(_));
    let places: Vec<Expr> =
        equations.rates.iter().filter(|(z, ..)| is_place(z)).map(|(_, place, _)| *place).collect();
    let mut list = Vec::new();
    for (z, symbol, derived) in equations.rates.iter().filter(|(z, _, rate)| moves(z, rate)) {
        let mut sum = Sum::new([Summand::plus(notation.polynomial(arena, derived))]);
        if let (Coordinate::P(a), Some(_)) = (z, potential) {
            sum.push(Summand::minus(slope_by(arena, places[*a])));
            if keeps_volume {
                let mean = Sum::new(places.iter().map(|place| Summand::plus(slope_by(arena, *place))));
                sum.push(Summand::plus(Sentence::Over(Box::new(mean.value()), places.len())));
            }
        }
        list.push(sum.of(rate(notation.scalar(arena, *symbol))));
    }
    (energy, list)
}
