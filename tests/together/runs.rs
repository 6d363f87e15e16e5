//! Flows of pieces, forces, series and lanes: against the equations that are integrated, which `canonical` holds against the
//! oracle, and against runs of Hamilton's equations by another method.

use affine_integrators::{RungeKutta8, splitting};
use affine_runtime::model::{Group, Quantity};
use affine_tests::reference::norm;

use crate::body::{Canonical, Trajectory};
use crate::capabilities::Flows;
use crate::case::{Case, T0, cases};

/// Roundings of some hundred operations. The largest error seen is 3e-15.
const ROUNDING: f64 = 1e-13;
/// Differences of order 6 in steps of 2^-9. The largest error seen is 2e-13.
const DIFFERENCES: f64 = 1e-11;
/// How long runs are.
const TIME: f64 = 0.25;

/// A plain array or a reduced state, and zeros.
type Padded = [f64; 32];
const GROUPS: &[Group] = &[Group::new(Quantity::Other("y"), 32)];

fn padded(values: &[f64]) -> Padded {
    let mut all = [0.0; 32];
    all[..values.len()].copy_from_slice(values);
    all
}

/// Hamilton's equations of the plain array, after a time.
pub(crate) fn through_the_chart(case: &Case, full: &[f64], time: f64) -> Vec<f64> {
    let rates = |t: f64, y: &Padded| padded(&case.subject.body.hamilton(t, &y[..full.len()]));
    let mut steps = RungeKutta8::new(rates, GROUPS, (T0, padded(full)), T0 + time, 1e-14).unwrap();
    while !steps.is_finished() {
        steps.advance().unwrap();
    }
    steps.y()[..full.len()].to_vec()
}

/// Its four parts.
pub(crate) fn in_order(point: &Canonical) -> [Vec<f64>; 4] {
    [&point.x, &point.phi, &point.p, &point.pi].map(Vec::clone)
}

/// The derivative at 0 of a curve, by differences of order 6.
pub(crate) fn slope(curve: impl Fn(f64) -> Vec<f64>) -> Vec<f64> {
    let step = 1.0 / 512.0;
    let [near, far, farther] = [1.0, 2.0, 3.0].map(|k| (curve(k * step), curve(-k * step)));
    let difference = |k: usize, (ahead, behind): &(Vec<f64>, Vec<f64>)| ahead[k] - behind[k];
    let of = |k: usize| 45.0 * difference(k, &near) - 9.0 * difference(k, &far) + difference(k, &farther);
    (0..near.0.len()).map(|k| of(k) / (60.0 * step)).collect()
}

/// Every piece is a flow, and together they move as the equations do.
#[test]
fn pieces_are_flows_and_add_up() {
    let mut tried = 0;
    for case in cases() {
        let Some(flows) = &case.subject.splitting else { continue };
        tried += 1;
        for full in case.points() {
            let (body, from) = (&case.subject.body, Trajectory { t0: T0, full: &full });
            let (start, t) = (body.reduced(from), T0 + 0.375);
            let after = |piece: usize, times: &[f64]| {
                let (mut y, mut carry) = (start.clone(), vec![0.0; start.len()]);
                times.iter().for_each(|h| flows.flow(from, piece, [t, *h], &mut y, &mut carry));
                body.renewed(&y)
            };
            let mut sum = vec![0.0; start.len()];
            for piece in 0..flows.pieces() {
                let (once, twice) = (after(piece, &[0.1875]), after(piece, &[0.25, -0.0625]));
                case.assert_close(
                    &format!("the flow of piece {piece}"),
                    &twice,
                    &once,
                    norm(&once),
                    ROUNDING,
                );
                let rate = slope(|h| after(piece, &[h]));
                sum.iter_mut().zip(&rate).for_each(|(sum, rate)| *sum += rate);
            }
            let expected = body.rates(from, t, &start);
            case.assert_close("the sum of pieces", &sum, &expected, norm(&expected), DIFFERENCES);
        }
    }
    assert_eq!(tried, count("splitting"));
}

/// Pieces as integrators take them.
struct InTurn<'a, const COUNT: usize, const NYSTROM: bool, const DILATES: bool> {
    flows: &'a dyn Flows,
    from: Trajectory<'a>,
    len: usize,
}

impl<const COUNT: usize, const NYSTROM: bool, const DILATES: bool> splitting::Pieces<Padded, ()>
    for InTurn<'_, COUNT, NYSTROM, DILATES>
{
    const COUNT: usize = COUNT;
    const NYSTROM: bool = NYSTROM;
    const DILATES: bool = DILATES;

    fn flow(&self, piece: usize, t: f64, h: f64, (): &(), state: &mut affine_integrators::lie::Sum<Padded>) {
        let (value, carry) = (&mut state.value[..self.len], &mut state.carry[..self.len]);
        self.flows.flow(self.from, piece, [t, h], value, carry);
    }
}

fn split<const COUNT: usize, const NYSTROM: bool, const DILATES: bool>(
    (flows, from): (&dyn Flows, Trajectory),
    start: &[f64],
    steps: u32,
) -> Vec<f64> {
    let pieces = InTurn::<COUNT, NYSTROM, DILATES> { flows, from, len: start.len() };
    let step = TIME / f64::from(steps);
    let begin = (T0, padded(start));
    let mut run = splitting::Splitting::new((pieces, ()), 4, begin, T0 + TIME, step).unwrap().unwrap();
    while !run.is_finished() {
        run.advance().unwrap();
    }
    run.y()[..start.len()].to_vec()
}

/// Steps of order 4 lead where Hamilton's equations do, and the work is what the energy has grown by.
#[test]
fn splitting_runs() {
    for case in cases() {
        let Some(flows) = &case.subject.splitting else { continue };
        let run = match (flows.pieces(), flows.kind()) {
            (0, [false, false]) => split::<0, false, false>,
            (1, [false, false]) => split::<1, false, false>,
            (2, [false, false]) => split::<2, false, false>,
            (2, [true, false]) => split::<2, true, false>,
            (2, [true, true]) => split::<2, true, true>,
            (2, [false, true]) => split::<2, false, true>,
            (3, [false, false]) => split::<3, false, false>,
            (3, [false, true]) => split::<3, false, true>,
            (4, [false, false]) => split::<4, false, false>,
            other => panic!("{}: pieces {other:?}", case.name),
        };
        let full = &case.points()[0];
        let (body, from) = (&case.subject.body, Trajectory { t0: T0, full });
        let there = through_the_chart(&case, full, TIME);
        let expected = body.point(&there);
        let start = body.reduced(from);
        let end = |steps: u32| body.renewed(&run((&**flows, from), &start, steps));
        let error = |y: &[f64]| {
            let found = in_order(&body.expanded(from, T0 + TIME, y));
            let all = found.concat().into_iter().zip(in_order(&expected).concat());
            norm(&all.map(|(f, e)| f - e).collect::<Vec<f64>>())
        };
        let fine = end(8);
        assert_order(&case, 4.0, [error(&end(4)), error(&fine)]);
        if let (Some([work]), Some([before])) =
            (case.of_reduced(Quantity::Work, &fine), case.of_reduced(Quantity::Work, &start))
        {
            let energy = |t: f64, full: &[f64]| body.energy(t, full)[0];
            let grown = energy(T0 + TIME, &there) - energy(T0, full);
            case.assert_close("work", &[work - before], &[grown], 1.0, 1e-5);
        }
    }
}

/// Errors of steps and of half of them are as those of an order, unless they are rounding alone.
fn assert_order(case: &Case, order: f64, [coarse, fine]: [f64; 2]) {
    let seen = (coarse / fine).log2();
    assert!(fine < 1e-4, "{}: error {fine:e}", case.name);
    assert!(fine < 1e-10 || seen > order - 0.75, "{}: order {seen}, {coarse:e} {fine:e}", case.name);
}

/// `q' = V(p)` and `p' = F(t, q)` are the reduced equations, and steps of them lead where Hamilton's equations do.
#[test]
fn equations_of_second_order() {
    let mut tried = 0;
    for case in cases() {
        let Some(forces) = &case.subject.nystrom else { continue };
        tried += 1;
        let body = &case.subject.body;
        for full in case.points() {
            let from = Trajectory { t0: T0, full: &full };
            let (start, half, t) = (body.reduced(from), forces.half(), T0 + 0.375);
            let (positions, momenta) = start[..2 * half].split_at(half);
            let found = [forces.drift(from, momenta), forces.force(from, t, positions)].concat();
            let expected = &body.rates(from, t, &start)[..2 * half];
            case.assert_close("drift and force", &found, expected, norm(expected), ROUNDING);

            let expected = in_order(&body.point(&through_the_chart(&case, &full, TIME)));
            let leaps = |steps: u32| {
                let (mut q, mut p) = (positions.to_vec(), momenta.to_vec());
                let h = TIME / f64::from(steps);
                let add = |to: &mut [f64], by: f64, rate: &[f64]| {
                    to.iter_mut().zip(rate).for_each(|(value, rate)| *value += by * rate);
                };
                for step in 0..steps {
                    add(&mut q, 0.5 * h, &forces.drift(from, &p));
                    add(&mut p, h, &forces.force(from, T0 + (f64::from(step) + 0.5) * h, &q));
                    add(&mut q, 0.5 * h, &forces.drift(from, &p));
                }
                let mut end = start.clone();
                end[..2 * half].copy_from_slice(&[q, p].concat());
                in_order(&body.expanded(from, T0 + TIME, &body.renewed(&end))).concat()
            };
            let error = |found: Vec<f64>| {
                let all = found.into_iter().zip(expected.concat());
                norm(&all.map(|(f, e)| f - e).collect::<Vec<f64>>())
            };
            assert_order(&case, 2.0, [error(leaps(64)), error(leaps(128))]);
        }
    }
    assert_eq!(tried, count("nystrom"));
}

/// The recurrence gives the series of the reduced equations.
#[test]
fn coefficients_of_series() {
    let mut tried = 0;
    for case in cases() {
        let Some(taylor) = &case.subject.taylor else { continue };
        tried += 1;
        for full in case.points() {
            let from = Trajectory { t0: T0, full: &full };
            let (found, expected) = (taylor.by_recurrence(from), taylor.by_series(from));
            let rates = case.subject.body.rates(from, T0, &found[0]);
            case.assert_close("first order", &found[1], &rates, norm(&rates), ROUNDING);
            // In the unit of time in which the first order is as large as the state.
            let (size, rate) = (norm(&expected[0]), norm(&expected[1]) / norm(&expected[0]).max(1e-300));
            for (k, (found, expected)) in found.iter().zip(&expected).enumerate() {
                let unit = norm(expected).max(size * rate.powi(k as i32));
                let unit = if unit > 0.0 { unit } else { 1.0 };
                let [found, expected] =
                    [found, expected].map(|c| c.iter().map(|v| v / unit).collect::<Vec<_>>());
                case.assert_close(&format!("order {k}"), &found, &expected, 1.0, ROUNDING);
            }
        }
    }
    assert_eq!(tried, count("taylor"));
}

/// Several bodies at once have the rates of each.
#[test]
fn rates_in_lanes() {
    let mut tried = 0;
    for case in cases() {
        let Some(lanes) = &case.subject.lanes else { continue };
        tried += 1;
        let points: Vec<Vec<f64>> = (0..3).map(|seed| case.drawn(seed).0).collect();
        let from: Vec<Trajectory> = points.iter().map(|full| Trajectory { t0: T0, full }).collect();
        let times = [T0, T0 + 0.375, T0 + 1.0];
        let found = lanes.at_once(&from, &times);
        for ((from, t), found) in from.iter().zip(times).zip(&found) {
            let body = &case.subject.body;
            let expected = body.rates(*from, t, &body.reduced(*from));
            case.assert_close("rates in lanes", found, &expected, norm(&expected), ROUNDING);
        }
    }
    assert_eq!(tried, cases().len());
}

/// How many models the table lets have a capability.
pub(crate) fn count(capability: &str) -> usize {
    use affine_codegen::spec::Named;
    let has = |case: &&Case| case.pair.accepted().unwrap().iter().any(|other| other.name() == capability);
    cases().iter().filter(has).count()
}
