//! The way in which the forces of a potential are written: the shortest of those that lose no digits.
//!
//! At a given point a force may be as good as the difference of `phi` from 1 allows. Along a motion `phi` is rounded itself, and
//! a force need not be better than that.

use crate::algebra::bind::Constants;
use crate::algebra::evaluate::evaluate;
use crate::algebra::substitute::listed;
use crate::algebra::{Arena, Expr};
use crate::ir::Program;
use crate::ir::rounding::Rounding;
use crate::mechanics::charts::{Chart, Linear, Momentum};
use crate::mechanics::potential::{Potential, Way, Writing};
use crate::optimise::{Batch, straight_line};
use crate::symbol::{Quantity, Symbol};

/// A way may lose so much, and so many times what the best one loses, where a body may be at rest and far from there. The bounds
/// are sums over all operations; errors are a tenth of them.
const AS_GOOD: [f64; 2] = [10.0, 100.0];

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
const PLACES: [Place; 11] = [
    strained(1e-6),
    strained(1e-4),
    strained(1e-2),
    strained(0.3),
    stretched([30.0, 0.05, 2.0]),
    stretched([5.0; 3]),
    stretched([0.1; 3]),
    stretched([1e40; 3]),
    stretched([1e-40; 3]),
    stretched([1e130; 3]),
    stretched([1e-130; 3]),
];

/// Entries of no particular kind, in units of 1/100.
const DIRECTION: [[f64; 3]; 3] = [[43.0, 17.0, 91.0], [29.0, 31.0, 87.0], [-83.0, 37.0, -61.0]];

impl Place {
    /// `phi_ia` in dimension `n`.
    fn placement(&self, n: usize, i: usize, a: usize) -> f64 {
        let side = |i: usize, a: usize| unit(i, a) + self.strain * DIRECTION[i][a] / 100.0;
        match self.is_far() {
            true => (0..n).map(|k| side(i, k) * self.stretches[k] * side(a, k)).sum(),
            false => side(i, a),
        }
    }

    /// Its size as rounding sees it: where a body is `near` the undeformed state and `phi - 1` is exact, that of the difference.
    fn size(&self, n: usize, (i, a): (usize, usize), near: bool) -> f64 {
        let value = self.placement(n, i, a);
        let from = if near && self.strain < 0.1 { unit(i, a) } else { 0.0 };
        (value - from).abs()
    }

    /// `D` of `s A A^T`.
    fn dilatation(&self, n: usize) -> f64 {
        let side = |i: usize, a: usize| unit(i, a) + self.strain * DIRECTION[i][a] / 100.0;
        let minor = |r: [usize; 2], c: [usize; 2]| {
            side(r[0], c[0]) * side(r[1], c[1]) - side(r[0], c[1]) * side(r[1], c[0])
        };
        let (det, root) = match n {
            2 => (minor([0, 1], [0, 1]), 1.0),
            _ => {
                let others = [[1, 2], [2, 0], [0, 1]];
                ((0..3).map(|a| side(0, a) * minor([1, 2], others[a])).sum(), 2.0 / 3.0)
            }
        };
        self.stretches[0] * f64::powf(det, root)
    }

    /// Is a body there far from rest?
    fn is_far(&self) -> bool {
        self.stretches != [1.0; 3]
    }

    /// What is asked of a force there.
    fn reach(&self) -> Reach {
        let within = |size: f64| self.stretches.iter().all(|s| (1.0 / size..size).contains(s));
        match (within(1e3), within(1e100)) {
            (true, _) => Reach::Ordinary,
            (_, true) => Reach::Far,
            _ => Reach::Extreme,
        }
    }
}

/// How far from the undeformed state a placement is.
#[derive(Clone, Copy)]
enum Reach {
    /// What rounding does to it counts.
    Ordinary,
    /// A force has a value.
    Far,
    /// A force along a motion has a value.
    Extreme,
}

/// What counts as lost where a force is zero.
const UNDERFLOW: f64 = 1e6;

/// The unit matrix.
fn unit(i: usize, a: usize) -> f64 {
    f64::from(u8::from(i == a))
}

/// A potential with the best ways of writing its forces, at given points and along motions.
pub(super) struct Ways {
    pub(super) at_points: Potential,
    pub(super) along_motions: Potential,
}

impl Ways {
    /// Those beside the given affine momenta.
    pub(super) fn new(arena: &mut Arena, potential: &Potential, n: usize, momenta: &[Momentum]) -> Self {
        let mut ways = Self { at_points: potential.clone(), along_motions: potential.clone() };
        for (k, momentum) in momenta.iter().enumerate() {
            if momenta[..k].contains(momentum) {
                continue;
            }
            let chart = Chart::new(arena, n, *momentum, Some(Linear::Space));
            let drafts: Vec<Draft> = potential
                .ways(arena, &chart)
                .into_iter()
                .map(|way| Draft::new(arena, potential, &chart, way))
                .collect();
            let chosen = |of: Potential, near: bool| match best(&drafts, near) {
                Some(way) => of.written(*momentum, way),
                None => of,
            };
            ways = Self {
                at_points: chosen(ways.at_points, true),
                along_motions: chosen(ways.along_motions, false),
            };
        }
        ways
    }
}

/// Forces in one way of writing.
struct Draft {
    way: Way,
    weight: usize,
    /// What is lost at each place, in units of what the rounding of `phi` does, and of what that of `phi - 1` does where it is
    /// small; infinite where there is no value.
    losses: Vec<[f64; 2]>,
    /// Has a call a part in it, whose rounding is not seen here?
    calls: bool,
}

impl Draft {
    fn new(arena: &mut Arena, potential: &Potential, chart: &Chart, way: Way) -> Self {
        let load = potential.load_by(arena, chart, way);
        let is_zero = load.forces.iter().all(|(_, force)| force.is_zero());
        let results =
            load.forces.into_iter().enumerate().map(|(k, (_, force))| (Quantity::Value.at([k]), force));
        let batch = Batch { shared: load.shared, kernels: load.kernels, results: results.collect() };
        let batch = batch.pruned(arena);
        let mut inputs: Vec<Expr> = [chart.phi.0.concat(), chart.x.clone()].concat();
        inputs.extend(potential.time());
        let mut constants = Constants::new(Quantity::Coefficient);
        let program = straight_line(arena, &batch, &mut constants, &|atom| inputs.contains(&atom));
        let parameters = parameters(arena, &constants);
        let losses = match is_zero {
            // Exactly, everywhere: terms of it cancel.
            true => vec![[0.0; 2]; PLACES.len()],
            false => PLACES.iter().map(|place| loss(&program, place, chart.dim, &parameters)).collect(),
        };
        Self { way, weight: program.operations().weight(), losses, calls: !program.calls.is_empty() }
    }
}

/// Values for what depends on fields alone.
fn parameters(arena: &mut Arena, constants: &Constants) -> Vec<(Symbol, f64)> {
    // Fields by their order, not by their names, which must not matter.
    let mut fields: Vec<Symbol> = Vec::new();
    let mut parameters: Vec<(Symbol, f64)> = Vec::new();
    for (symbol, form) in &constants.entries {
        let form = form.expression(arena);
        arena.for_each_symbol(form, &mut |field| {
            if !fields.contains(field) {
                fields.push(field.clone());
            }
        });
        let place = |field: &Symbol| fields.iter().position(|known| known == field);
        let value = evaluate(arena, form, &|field| Some(sample(&format!("field {}", place(field)?))));
        parameters.push((arena.symbol_of(*symbol), value.unwrap_or(f64::NAN)));
    }
    parameters
}

/// A program of reduced equations that is run far from the undeformed state.
pub(super) struct Run<'a> {
    program: &'a Program,
    parameters: Vec<(Symbol, f64)>,
}

impl<'a> Run<'a> {
    pub(super) fn new(arena: &mut Arena, program: &'a Program, constants: &Constants) -> Self {
        Self { program, parameters: parameters(arena, constants) }
    }

    /// Has it the values of another wherever that has any, up to dilatations that square to the end of the range of numbers?
    pub(super) fn reaches_as_far_as(&self, other: &Self, n: usize) -> bool {
        (1..=15).flat_map(|k| [10 * k, -10 * k]).all(|power| {
            let place = stretched([10.0_f64.powi(power); 3]);
            let wanted = other.rates(&place, n);
            let found = self.rates(&place, n);
            let pairs = wanted.into_iter();
            let pairs: Vec<(f64, f64)> =
                pairs.filter_map(|(symbol, value)| Some((value, listed(&found)(symbol)?))).collect();
            let is_near = |(value, own): &(f64, f64)| (value - own).abs() <= NEAR * value.abs();
            !pairs.iter().all(|(value, _)| value.is_finite()) || pairs.iter().all(is_near)
        })
    }

    fn rates(&self, place: &Place, n: usize) -> Vec<(Symbol, f64)> {
        let root = place.dilatation(n);
        let input = |symbol: &Symbol| match symbol {
            Symbol::Component(Quantity::Placement, entry) => {
                Some(place.placement(n, entry[0] - 1, entry[1] - 1))
            }
            _ => match symbol.quantity() {
                Some(Quantity::InverseDilatation) => Some(1.0 / root),
                Some(Quantity::MeanLogStretch) => Some(root.ln()),
                _ => {
                    let known = listed(&self.parameters)(symbol.clone());
                    known.or_else(|| Some(sample(&symbol.to_string())))
                }
            },
        };
        let values = self.program.run(&input).unwrap_or_default();
        self.program.outputs.iter().map(|(symbol, _)| symbol.clone()).zip(values).collect()
    }
}

/// Values that differ by less are the same, whatever rounding does to them.
const NEAR: f64 = 1e-6;

/// The lightest of those that are nowhere worse than the best there.
fn best(drafts: &[Draft], near: bool) -> Option<Way> {
    // Principal stretches that are counted from the undeformed state keep their digits there by construction.
    if drafts.iter().any(|draft| draft.calls) {
        return drafts.iter().map(|draft| draft.way).find(|way| way.writing.counts() == near);
    }
    // What is integrated may carry functions of `det phi`, and is written through its powers.
    let mut drafts: Vec<&Draft> = drafts.iter().filter(|draft| near || !draft.way.writing.counts()).collect();
    // Powers of `D` that a motion carries leave the range of numbers later than those of a determinant, which is formed here.
    let is_isochoric = |draft: &Draft| draft.way.writing == Writing::Isochoric;
    if !near && drafts.iter().any(|draft| is_isochoric(draft)) {
        drafts.retain(|draft| is_isochoric(draft));
    }
    let loss = |draft: &Draft, place: usize| draft.losses[place][usize::from(near)];
    let least = |place: usize| drafts.iter().map(|draft| loss(draft, place)).fold(f64::INFINITY, f64::min);
    let limit = |(k, place): (usize, &Place)| AS_GOOD[usize::from(place.is_far())] * least(k).max(1.0);
    let limits: Vec<f64> = PLACES.iter().enumerate().map(limit).collect();
    let excess = |draft: &Draft| {
        let over = limits.iter().enumerate().map(|(place, limit)| loss(draft, place) / limit);
        over.filter(|over| !over.is_nan()).fold(0.0, f64::max)
    };
    let good = drafts.iter().filter(|draft| excess(draft) <= 1.0).min_by_key(|draft| draft.weight);
    let least_bad = || drafts.iter().min_by(|a, b| excess(a).total_cmp(&excess(b)));
    good.or_else(least_bad).map(|draft| draft.way)
}

/// What the program loses at a place.
fn loss(program: &Program, place: &Place, n: usize, parameters: &[(Symbol, f64)]) -> [f64; 2] {
    let entry = |symbol: &Symbol| match symbol {
        Symbol::Component(Quantity::Placement, entry) => Some((entry[0] - 1, entry[1] - 1)),
        _ => None,
    };
    let input = |symbol: &Symbol| match symbol.quantity() {
        Some(Quantity::Placement) => entry(symbol).map(|(i, a)| place.placement(n, i, a)),
        Some(Quantity::Time | Quantity::Position) => Some(sample(&symbol.to_string())),
        // What a call provides has no value here.
        _ => listed(parameters)(symbol.clone()),
    };
    let norm = |list: &[f64]| list.iter().map(|value| value * value).sum::<f64>().sqrt();
    [false, true].map(|near| {
        let size = |symbol: &Symbol| entry(symbol).map_or(0.0, |(i, a)| place.size(n, (i, a), near));
        let Some(Rounding { results, own, of_inputs }) = program.rounding(&input, &size) else { return 0.0 };
        let size = results.iter().fold(0.0, |size: f64, result| size.max(result.abs()));
        let is_finite = results.iter().all(|result| result.is_finite());
        match place.reach() {
            Reach::Ordinary if is_finite => norm(&own) / (norm(&of_inputs) + norm(&results)),
            Reach::Extreme if near => 1.0,
            // Nothing but the range of numbers: a force that is zero may have left it below.
            _ if is_finite => {
                if size > 0.0 {
                    1.0
                } else {
                    UNDERFLOW
                }
            }
            _ => f64::INFINITY,
        }
    })
}

/// A value for a field, the position or the time, between 1/2 and 3/2.
fn sample(name: &str) -> f64 {
    name.bytes().fold(0.5, |value, byte| 0.5 + (31.0 * value + 0.618 * f64::from(byte)).fract())
}
