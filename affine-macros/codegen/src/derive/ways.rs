//! The way in which the forces of a potential are written: the shortest of those that lose no digits.

use crate::algebra::bind::Constants;
use crate::algebra::evaluate::evaluate;
use crate::algebra::{Arena, Expr};
use crate::ir::Program;
use crate::ir::rounding::Rounding;
use crate::mechanics::charts::{Chart, Linear, Momentum};
use crate::mechanics::potential::{Potential, Writing};
use crate::optimise::{Batch, straight_line};

/// A way may lose so many times what the best one loses where a body may be at rest, and so many times far from there.
const AS_GOOD: [f64; 2] = [3.0, 100.0];

/// Where the ways are compared: `1 + strain R` near the undeformed state, `A diag(stretches) A^T` with `A = 1 + strain R` elsewhere.
struct Place {
    strain: f64,
    stretches: [f64; 3],
}

const fn strained(strain: f64) -> Place {
    Place { strain, stretches: [1.0; 3] }
}

const fn stretched(stretches: [f64; 3]) -> Place {
    Place { strain: 0.3, stretches }
}

/// From hardly strained to far away.
const PLACES: [Place; 9] = [
    strained(1e-6),
    strained(1e-4),
    strained(1e-2),
    strained(0.3),
    stretched([30.0, 0.05, 2.0]),
    stretched([5.0; 3]),
    stretched([0.1; 3]),
    stretched([1e40; 3]),
    stretched([1e-40; 3]),
];

/// Entries of no particular kind, in units of 1/100.
const DIRECTION: [[f64; 3]; 3] = [[43.0, 17.0, 91.0], [29.0, 31.0, 87.0], [-83.0, 37.0, -61.0]];

impl Place {
    /// `phi_ia` in dimension `n`, and its size as rounding sees it: near the undeformed state the difference from it.
    fn placement(&self, n: usize, i: usize, a: usize) -> (f64, f64) {
        let unit = |i: usize, a: usize| f64::from(u8::from(i == a));
        let side = |i: usize, a: usize| unit(i, a) + self.strain * DIRECTION[i][a] / 100.0;
        if !self.is_far() {
            return (side(i, a), (side(i, a) - unit(i, a)).abs());
        }
        let value: f64 = (0..n).map(|k| side(i, k) * self.stretches[k] * side(a, k)).sum();
        (value, value.abs())
    }

    /// Is a body there far from rest?
    fn is_far(&self) -> bool {
        self.stretches != [1.0; 3]
    }

    /// Beyond these only the range of numbers matters.
    fn is_extreme(&self) -> bool {
        self.stretches.iter().any(|stretch| !(1e-3..1e3).contains(stretch))
    }
}

/// The potential with the best way of writing its forces beside each affine momentum.
pub(super) fn written(arena: &mut Arena, potential: &Potential, n: usize, momenta: &[Momentum]) -> Potential {
    momenta.iter().fold(potential.clone(), |potential, momentum| {
        if potential.is_written(*momentum) {
            return potential;
        }
        let chart = Chart::new(arena, n, *momentum, Some(Linear::Space));
        let ways = potential.writings(arena, &chart);
        let drafts: Vec<Draft> =
            ways.into_iter().map(|writing| Draft::new(arena, &potential, &chart, writing)).collect();
        match best(&drafts) {
            Some(writing) => potential.written(*momentum, writing),
            None => potential,
        }
    })
}

/// Forces in one way of writing.
struct Draft {
    writing: Writing,
    weight: usize,
    /// What is lost at each place, in units of what the rounding of the placement does; infinite where there is no value.
    losses: Vec<f64>,
}

impl Draft {
    fn new(arena: &mut Arena, potential: &Potential, chart: &Chart, writing: Writing) -> Self {
        let load = potential.load_in(arena, chart, writing);
        let results =
            load.forces.into_iter().enumerate().map(|(k, (_, force))| (format!("force_{k}"), force));
        let batch = Batch { shared: load.shared, kernels: load.kernels, results: results.collect() };
        let batch = batch.pruned(arena);
        let mut inputs: Vec<Expr> = [chart.phi.0.concat(), chart.x.clone()].concat();
        inputs.extend(potential.time());
        let mut constants = Constants::new("c");
        let program = straight_line(arena, &batch, &mut constants, &|atom| inputs.contains(&atom));
        let parameters: Vec<(String, f64)> = constants
            .entries
            .iter()
            .map(|(symbol, form)| {
                let form = form.expression(arena);
                let value = evaluate(arena, form, &|name| Some(sample(name)));
                (arena.name(*symbol).unwrap_or_default().to_owned(), value.unwrap_or(f64::NAN))
            })
            .collect();
        let losses = PLACES.iter().map(|place| loss(&program, place, chart.dim, &parameters)).collect();
        Self { writing, weight: program.operations().weight(), losses }
    }
}

/// The lightest of those that are nowhere worse than the best there.
fn best(drafts: &[Draft]) -> Option<Writing> {
    let least = |place: usize| drafts.iter().map(|draft| draft.losses[place]).fold(f64::INFINITY, f64::min);
    let limit = |(k, place): (usize, &Place)| AS_GOOD[usize::from(place.is_far())] * least(k);
    let limits: Vec<f64> = PLACES.iter().enumerate().map(limit).collect();
    let holds = |draft: &&Draft| draft.losses.iter().zip(&limits).all(|(loss, limit)| loss <= limit);
    drafts.iter().filter(holds).min_by_key(|draft| draft.weight).map(|draft| draft.writing)
}

/// What the program loses at a place.
fn loss(program: &Program, place: &Place, n: usize, parameters: &[(String, f64)]) -> f64 {
    let entry = |name: &str| {
        let at = (0..n).flat_map(|i| (0..n).map(move |a| (i, a)));
        at.into_iter().find(|(i, a)| name == format!("phi_{}{}", i + 1, a + 1))
    };
    let input = |name: &str| {
        let known = parameters.iter().find(|(known, _)| known == name).map(|(_, value)| *value);
        let placed = entry(name).map(|(i, a)| place.placement(n, i, a).0);
        // What a call provides has no value here.
        known.or(placed).or_else(|| (name == "t" || name.starts_with("x_")).then(|| sample(name)))
    };
    let size = |name: &str| entry(name).map_or(0.0, |(i, a)| place.placement(n, i, a).1);
    let Some(Rounding { results, own, of_inputs }) = program.rounding(&input, &size) else { return 0.0 };
    let norm = |list: &[f64]| list.iter().map(|value| value * value).sum::<f64>().sqrt();
    if place.is_extreme() {
        return if results.iter().all(|result| result.is_finite()) { 1.0 } else { f64::INFINITY };
    }
    let loss = norm(&own) / (norm(&of_inputs) + norm(&results));
    if loss.is_nan() { f64::INFINITY } else { loss }
}

/// A value for a field, the position or the time, between 1/2 and 3/2.
fn sample(name: &str) -> f64 {
    name.bytes().fold(0.5, |value, byte| 0.5 + (31.0 * value + 0.618 * f64::from(byte)).fract())
}
