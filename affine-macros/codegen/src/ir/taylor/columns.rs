//! Vectors that stay vectors: where the rates of their states are the lanes of one sum, in their order, no coefficient is
//! taken out of a lane and put back into one.

use super::super::{Op, Program, Value};
use super::recurrence::{Column, Place, Rule, Series, Term};
use crate::symbol::Symbol;

/// The columns among the vectors of a row of slots.
pub(super) fn find(
    program: &Program,
    states: &[Symbol],
    rules: &[(Value, Rule)],
    (slots, lanes): (&[Option<Series>], usize),
) -> Vec<Column> {
    let column = |(index, vector): (usize, &[Option<Series>])| {
        let mut sum = None;
        for (lane, series) in vector.iter().enumerate().filter_map(|(lane, s)| Some((lane, (*s)?))) {
            let place = rate(program, states, rules, series)?;
            if !place.full || place.lane != lane || sum.is_some_and(|known| known != place.sum) {
                return None;
            }
            sum = Some(place.sum);
        }
        Some(Column { slot: index * lanes, sum: sum? })
    };
    slots.chunks(lanes).enumerate().filter_map(column).collect()
}

/// Where the rate of a state is found, if it is a lane and nothing else.
fn rate(program: &Program, states: &[Symbol], rules: &[(Value, Rule)], series: Series) -> Option<Place> {
    let Op::Input(name) = &program.steps[series.value] else { return None };
    let (_, rate) = &program.outputs[states.iter().position(|state| state == name)?];
    let (_, Rule::Sum(terms)) = rules.iter().find(|(value, _)| value == rate)? else { return None };
    match terms[..] {
        [(false, Term::Lane(place))] if !series.rate => Some(place),
        _ => None,
    }
}
