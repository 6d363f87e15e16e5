//! Order, accuracy and cost of the Taylor series method on nonlinear problems with known solutions.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use affine_integrators::taylor::{Series, order_for};
use affine_integrators::{Failure, Statistics, Taylor};
use affine_runtime::__private::numerics::HIGHEST_ORDER;
use affine_runtime::model::{Group, Quantity};

const PAIR: &[Group] = &[Group::new(Quantity::Other("y"), 2)];
const ONE: &[Group] = &[Group::new(Quantity::Other("y"), 1)];

/// `sum_(j = 0..=k) a_j b_(k-j)`.
fn product(k: usize, a: impl Fn(usize) -> f64, b: impl Fn(usize) -> f64) -> f64 {
    (0..=k).map(|j| a(j) * b(k - j)).sum()
}

/// A coupled pair with the solution `(sin t, 1/(1 + t^2))`, in units of time and state:
/// `y_0' = cos t + (y_0^2 - sin^2 t) y_1`, `y_1' = -2 t y_1^2 + y_0^2 - sin^2 t`. By the book: every convolution alone.
struct Pair {
    second: f64,
    metre: f64,
}

impl Pair {
    const PLAIN: Self = Self { second: 1.0, metre: 1.0 };

    fn exact(&self, t: f64) -> [f64; 2] {
        let t = t / self.second;
        [self.metre * t.sin(), self.metre / (1.0 + t * t)]
    }
}

impl Series<[f64; 2], ()> for Pair {
    type Row = [f64; 0];

    fn coefficients(
        &self,
        (t, unit): (f64, f64),
        (): &(),
        coefficients: &mut [[f64; 2]],
        _rows: &mut [[f64; 0]],
    ) {
        let (t, order) = (t / self.second, coefficients.len() - 1);
        let factorial = |k: usize| (1..=k).map(|i| i as f64).product::<f64>();
        let (sin, cos) = t.sin_cos();
        let sine = |k: usize| [sin, cos, -sin, -cos][k % 4] / factorial(k);
        let cosine = |k: usize| [cos, -sin, -cos, sin][k % 4] / factorial(k);
        let time = |k: usize| [t, 1.0].get(k).copied().unwrap_or(0.0);
        let mut y = vec![coefficients[0].map(|y| y / self.metre)];
        for k in 0..order {
            let excess = |k: usize| product(k, |j| y[j][0], |j| y[j][0]) - product(k, sine, sine);
            let square = |k: usize| product(k, |j| y[j][1], |j| y[j][1]);
            let rates =
                [cosine(k) + product(k, excess, |j| y[j][1]), -2.0 * product(k, time, square) + excess(k)];
            y.push(rates.map(|rate| rate / (k as f64 + 1.0)));
            coefficients[k + 1] = y[k + 1].map(|c| c * self.metre * (unit / self.second).powi(k as i32 + 1));
        }
    }
}

/// `y' = y^2`, `y = 1/(1 - t)`; not a number beyond `t = edge`.
struct Pole {
    edge: f64,
}

impl Series<[f64; 1], ()> for Pole {
    type Row = [f64; 0];

    fn coefficients(
        &self,
        (t, unit): (f64, f64),
        (): &(),
        coefficients: &mut [[f64; 1]],
        _rows: &mut [[f64; 0]],
    ) {
        for k in 1..coefficients.len() {
            let square = product(k - 1, |j| coefficients[j][0], |j| coefficients[j][0]);
            coefficients[k] = [if t > self.edge { f64::NAN } else { square * unit / k as f64 }];
        }
    }
}

fn pair(t0: f64, t_end: f64, tolerance: f64, order: Option<usize>) -> Taylor<[f64; 2], (), Pair> {
    Taylor::new((Pair::PLAIN, ()), PAIR, (t0, Pair::PLAIN.exact(t0)), t_end, tolerance, order).unwrap()
}

fn distance(a: &[f64; 2], b: &[f64; 2]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs() / (1.0 + b.abs())).fold(0.0, f64::max)
}

/// Largest error on the way, at steps and between them; the statistics.
fn run(mut integration: Taylor<[f64; 2], (), Pair>) -> (f64, f64, Statistics) {
    let (mut at_steps, mut between) = (0.0f64, 0.0f64);
    while !integration.is_finished() {
        let t = integration.t();
        integration.advance().unwrap();
        at_steps = at_steps.max(distance(integration.y(), &Pair::PLAIN.exact(integration.t())));
        for theta in [0.2, 0.5, 0.9] {
            let t = t + theta * (integration.t() - t);
            between = between.max(distance(&integration.at(t).unwrap(), &Pair::PLAIN.exact(t)));
        }
    }
    (at_steps, between, integration.statistics())
}

#[test]
fn order_follows_the_tolerance() {
    // Six more than ceil(1 - ln(eps)/2), which is from Jorba and Zou, section 3.2; at 1e-15 for a hundredth of it.
    for (tolerance, order) in [(1e-3, 11), (1e-6, 14), (1e-9, 18), (1e-12, 21), (1e-14, 24), (1e-15, 27)] {
        assert_eq!(order_for(tolerance), order);
        assert_eq!(pair(0.0, 1.0, tolerance, None).order(), order);
    }
    assert_eq!((order_for(0.9), order_for(1e-300)), (8, HIGHEST_ORDER));
}

#[test]
fn measured_orders() {
    // At a fixed order steps go as tolerance^(1/p): the slope of log(error) over log(steps) is -p.
    for order in [2, 3, 4, 6, 8, 10] {
        let coarse = 1e-4f64;
        let fine = coarse * 3.0f64.powi(-(order as i32));
        let (first, last) =
            (run(pair(0.0, 3.0, coarse, Some(order))), run(pair(0.0, 3.0, fine, Some(order))));
        assert!(last.0 > 1e-13, "rounding hides the order: {last:?}");
        let ratio = (last.2.steps as f64 / first.2.steps as f64).ln();
        let (at_steps, between) = ((first.0 / last.0).ln() / ratio, (first.1 / last.1).ln() / ratio);
        // Few steps make the ratio of their numbers coarse.
        let slack = 0.15 * order as f64;
        assert!((at_steps - order as f64).abs() < slack, "order {order}: {at_steps}");
        assert!((between - order as f64).abs() < slack, "order {order} between steps: {between}");
    }
}

#[test]
fn errors_and_costs_follow_the_tolerance() {
    let mut steps = Vec::new();
    for tolerance in [1e-3, 1e-6, 1e-9, 1e-12, 1e-15] {
        let (at_steps, between, statistics) = run(pair(0.0, 3.0, tolerance, None));
        // What a step does wrong grows by some tens until t = 3.
        assert!(at_steps < 30.0 * tolerance.max(f64::EPSILON), "{tolerance:e}: {at_steps:e}");
        assert!(between < 30.0 * tolerance.max(f64::EPSILON), "{tolerance:e} between steps: {between:e}");
        assert_eq!(statistics.rejected, 0);
        assert_eq!(
            (statistics.series, statistics.evaluations),
            (statistics.steps, 1),
            "and the slope at the start"
        );
        let order = order_for(tolerance) as u64;
        assert_eq!(statistics.series_worth, statistics.series * order * (order + 1) / 2);
        assert_eq!(statistics.equivalent_evaluations(), statistics.series_worth + 1);
        steps.push(statistics.steps);
    }
    assert_eq!(steps, [5, 6, 7, 8, 9]);
}

#[test]
fn backward_in_time() {
    let mut integration = pair(1.5, -0.5, 1e-14, None);
    let mut before = integration.t();
    while !integration.is_finished() {
        integration.advance().unwrap();
        assert!(integration.t() < before);
        before = integration.t();
    }
    assert_eq!(integration.t(), -0.5);
    assert!(distance(integration.y(), &Pair::PLAIN.exact(-0.5)) < 1e-13);
}

#[test]
fn dense_output_meets_the_steps() {
    let mut integration = pair(0.0, 2.0, 1e-12, None);
    let (mut t, mut y) = (integration.t(), *integration.y());
    while !integration.is_finished() {
        integration.advance().unwrap();
        assert_eq!(integration.at(t), Ok(y), "the beginning");
        assert_eq!(integration.at(integration.t()), Ok(*integration.y()), "the end");
        (t, y) = (integration.t(), *integration.y());
    }
}

#[test]
fn nothing_to_do_costs_one_evaluation() {
    let mut integration = pair(2.0, 2.0, 1e-9, None);
    integration.advance().unwrap();
    assert_eq!((integration.t(), *integration.y()), (2.0, Pair::PLAIN.exact(2.0)));
    assert_eq!(integration.statistics(), Statistics { evaluations: 1, ..Statistics::default() });
}

fn until_failure(edge: f64, t_end: f64) -> (Failure, Taylor<[f64; 1], (), Pole>) {
    let mut integration = Taylor::new((Pole { edge }, ()), ONE, (0.0, [1.0]), t_end, 1e-12, None).unwrap();
    loop {
        if let Err(failure) = integration.advance() {
            return (failure, integration);
        }
    }
}

#[test]
fn blow_up_stops_before_the_pole_and_keeps_the_state() {
    let (failure, mut integration) = until_failure(f64::INFINITY, 2.0);
    assert_eq!(failure, Failure::StepUnderflow);
    let (t, y) = (integration.t(), integration.y()[0]);
    assert!((t - 1.0).abs() < 1e-9, "the pole, up to the errors of the steps: {t}");
    assert!(y.is_finite() && y > 1e6);
    assert_eq!(integration.advance(), Err(Failure::StepUnderflow), "and again");
    assert_eq!((integration.t(), integration.y()[0]), (t, y));
}

#[test]
fn what_is_not_finite_is_told_apart() {
    let (failure, integration) = until_failure(0.5, 0.9);
    assert_eq!(failure, Failure::NotFinite);
    assert!((integration.y()[0] - 1.0 / (1.0 - integration.t())).abs() < 1e-11, "the last state is good");
    let start = Taylor::new((Pole { edge: -1.0 }, ()), ONE, (0.0, [1.0]), 1.0, 1e-12, None);
    assert_eq!(start.unwrap_err(), Failure::NotFinite);
}

#[test]
fn units_of_time_and_state_do_not_matter() {
    // Powers of two, so that even rounding of the states is the same; lengths of steps come from logarithms.
    let scaled = Pair { second: 1024.0, metre: 0.125 };
    let start = (0.0, scaled.exact(0.0));
    let mut other = Taylor::new((scaled, ()), PAIR, start, 2048.0, 1e-9, None).unwrap();
    let mut plain = pair(0.0, 2.0, 1e-9, None);
    while !plain.is_finished() {
        plain.advance().unwrap();
        other.advance().unwrap();
        assert!((other.t() / 1024.0 - plain.t()).abs() < 1e-13);
        assert!(distance(&other.y().map(|y| y / 0.125), plain.y()) < 1e-13);
    }
    assert!(other.is_finished());
}

#[test]
fn coefficients_beyond_the_range_of_numbers_are_taken_in_another_unit_of_time() {
    let plain = pair(0.0, 2.0, 1e-12, None);
    let finished = |mut integration: Taylor<[f64; 2], (), Pair>| {
        while !integration.is_finished() {
            integration.advance().unwrap();
        }
        integration
    };
    let plain = finished(plain);
    for exponent in [-400, -60, 60, 400] {
        let unit = 2.0_f64.powi(exponent);
        let scaled = Pair { second: unit, metre: 1.0 };
        let start = (0.0, scaled.exact(0.0));
        let other = finished(Taylor::new((scaled, ()), PAIR, start, 2.0 * unit, 1e-12, None).unwrap());
        assert!(distance(other.y(), plain.y()) < 1e-12, "2^{exponent}: {other:?} {plain:?}");
        assert!(other.statistics().steps.abs_diff(plain.statistics().steps) <= 1, "2^{exponent}");
    }
}
