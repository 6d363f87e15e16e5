//! The lattice as formulas, in hyperbolic functions.

use crate::algebra::{Arena, Expr, Polynomial};
use crate::mechanics::describe::{Formula, Notation, Sum};
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
    let slope = |arena: &mut Arena, place: Expr| {
        let place = notation.formula(arena, place);
        [format!("dU/d{}", place.text), format!("\\partial U/\\partial {}", place.latex)]
    };
    let places: Vec<Expr> = equations
        .rates
        .iter()
        .filter(|(z, ..)| matches!(z, Coordinate::Q(_)))
        .map(|(_, place, _)| *place)
        .collect();
    let mean: Vec<[String; 2]> = match keeps_volume {
        true => places.iter().map(|place| slope(arena, *place)).collect(),
        false => Vec::new(),
    };
    let mut list = Vec::new();
    for (z, symbol, rate) in equations.rates.iter().filter(|(z, _, rate)| moves(z, rate)) {
        let mut sum = Sum::default();
        let kinetic = notation.polynomial(arena, rate);
        sum.push(false, &kinetic.text, &kinetic.latex);
        if let (Coordinate::P(a), Some(_)) = (z, potential) {
            let [text, latex] = slope(arena, places[*a]);
            sum.push(true, &text, &latex);
            if keeps_volume {
                let [text, latex] =
                    [0, 1].map(|k| mean.iter().map(|one| one[k].as_str()).collect::<Vec<_>>().join(" + "));
                let n = mean.len();
                sum.push(false, &format!("({text})/{n}"), &format!("\\frac{{{latex}}}{{{n}}}"));
            }
        }
        let left = notation.formula(arena, *symbol);
        let right = sum.value();
        list.push(right.of(&format!("d{}/dt", left.text), &format!("\\dot{{{}}}", left.latex)));
    }
    (energy, list)
}
