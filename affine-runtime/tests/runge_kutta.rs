//! Order, accuracy and cost of the Runge-Kutta method on nonlinear, non-autonomous problems with known solutions.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use affine_integrators::runge_kutta::Step;
use affine_integrators::{Failure, RungeKutta8, Statistics};
use affine_runtime::model::{Group, Quantity};

/// Rounding ends the convergence there; larger than the roundoff of a few hundred steps.
const FLOOR: f64 = 2e-14;

/// A classical test problem with the solution `exp(sin t^2), exp(5 sin t^2), sin t^2 + 1, cos t^2`.
fn four(t: f64, y: &[f64; 4]) -> [f64; 4] {
    [
        2.0 * t * y[1].powf(0.2) * y[3],
        10.0 * t * (5.0 * (y[2] - 1.0)).exp() * y[3],
        2.0 * t * y[3],
        -2.0 * t * y[0].ln(),
    ]
}

fn four_exact(t: f64) -> [f64; 4] {
    let (sin, cos) = (t * t).sin_cos();
    [sin.exp(), (5.0 * sin).exp(), sin + 1.0, cos]
}

/// A coupled pair with the solution `(sin t, 1/(1 + t^2))`.
fn pair(t: f64, y: &[f64; 2]) -> [f64; 2] {
    let (sin, cos) = t.sin_cos();
    [cos + (y[0] * y[0] - sin * sin) * y[1], -2.0 * t * y[1] * y[1] + y[0] * y[0] - sin * sin]
}

fn pair_exact(t: f64) -> [f64; 2] {
    [t.sin(), 1.0 / (1.0 + t * t)]
}

const FOUR: &[Group] = &[Group::new(Quantity::Other("y"), 4)];
const PAIR: &[Group] = &[Group::new(Quantity::Other("y"), 2)];

fn distance<const D: usize>(a: &[f64; D], b: &[f64; D]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs() / (1.0 + b.abs())).fold(0.0, f64::max)
}

/// Errors of `y_n` at `t_end` and of the dense output on the way, with `n` equal steps.
fn errors<const D: usize>(
    f: impl Fn(f64, &[f64; D]) -> [f64; D],
    exact: impl Fn(f64) -> [f64; D],
    t_end: f64,
    n: usize,
) -> (f64, f64) {
    let mut dense_error = 0.0f64;
    let time = |i: usize| t_end * i as f64 / n as f64;
    let mut step = Step::start(&f, 0.0, exact(0.0));
    for i in 0..n {
        step.begin_next();
        // From the exact solution: the error of the polynomial without that of the steps before.
        let mut local = Step::start(&f, time(i), exact(time(i)));
        local.attempt(&f, time(i + 1));
        local.accept(&f);
        let dense = local.dense(&f);
        for theta in [0.15, 0.35, 0.5, 0.7, 0.9] {
            let t = time(i) + theta * t_end / n as f64;
            dense_error = dense_error.max(distance(&dense.at(t), &exact(t)));
        }
        step.attempt(&f, time(i + 1));
        step.accept(&f);
    }
    (distance(step.end(), &exact(t_end)), dense_error)
}

/// Slopes of `log error` against `log n` from the fewest steps to the most.
fn observed_orders<const D: usize>(
    f: impl Fn(f64, &[f64; D]) -> [f64; D],
    exact: impl Fn(f64) -> [f64; D],
    t_end: f64,
    (few, many): (usize, usize),
) -> (f64, f64) {
    let (first, last) = (errors(&f, &exact, t_end, few), errors(&f, &exact, t_end, many));
    assert!(last.0 > FLOOR && last.1 > FLOOR, "rounding hides the order: {last:?}");
    let ratio = (many as f64 / few as f64).ln();
    ((first.0 / last.0).ln() / ratio, (first.1 / last.1).ln() / ratio)
}

#[test]
fn solution_is_of_order_8_and_dense_output_of_order_7() {
    // The polynomial over one step has order 7: its error is of order h^8.
    let observed = [
        observed_orders(four, four_exact, 2.0, (50, 100)),
        observed_orders(pair, pair_exact, 1.0, (4, 9)),
        observed_orders(pair, pair_exact, 3.0, (12, 24)),
    ];
    for (solution, polynomial) in observed {
        assert!(solution >= 7.8, "order {solution}");
        assert!(polynomial >= 7.8, "error of order {polynomial}");
        assert!(solution < 9.0 && polynomial < 9.0, "no more than that: {solution}, {polynomial}");
    }
}

#[test]
fn errors_and_costs_follow_the_tolerance() {
    // Errors on the way grow with the solution, which varies by exp(10).
    let expected =
        [(1e-3, (16, 4, 238)), (1e-6, (31, 4, 418)), (1e-9, (75, 8, 990)), (1e-12, (175, 11, 2223))];
    for (tolerance, (steps, rejected, evaluations)) in expected {
        let mut run = RungeKutta8::new(four, FOUR, (0.0, four_exact(0.0)), 3.0, tolerance).unwrap();
        while !run.is_finished() {
            run.advance().unwrap();
        }
        assert_eq!(run.t(), 3.0);
        let error = distance(run.y(), &four_exact(3.0));
        assert!(error < 1e3 * tolerance, "{tolerance:e}: {error:e}");
        assert_eq!(
            run.statistics(),
            Statistics { steps, rejected, evaluations, ..Statistics::default() },
            "{tolerance:e}"
        );
    }
}

#[test]
fn dense_output_meets_the_steps() {
    let mut run = RungeKutta8::new(pair, PAIR, (0.0, pair_exact(0.0)), 2.0, 1e-9).unwrap();
    let (mut t, mut y) = (run.t(), *run.y());
    while !run.is_finished() {
        run.advance().unwrap();
        let dense = run.dense();
        assert_eq!(dense.at(t), y, "the beginning");
        assert_eq!(dense.at(run.t()), *run.y(), "the end");
        let middle = 0.5 * (t + run.t());
        assert!(distance(&dense.at(middle), &pair_exact(middle)) < 1e-8);
        (t, y) = (run.t(), *run.y());
    }
}

#[test]
fn backward_in_time() {
    let mut run = RungeKutta8::new(four, FOUR, (1.5, four_exact(1.5)), -0.5, 1e-12).unwrap();
    let mut before = run.t();
    while !run.is_finished() {
        run.advance().unwrap();
        assert!(run.t() < before);
        before = run.t();
    }
    assert_eq!(run.t(), -0.5);
    assert!(distance(run.y(), &four_exact(-0.5)) < 1e-10);
}

#[test]
fn nothing_to_do_costs_one_evaluation() {
    let mut run = RungeKutta8::new(pair, PAIR, (2.0, pair_exact(2.0)), 2.0, 1e-9).unwrap();
    run.advance().unwrap();
    assert_eq!((run.t(), *run.y()), (2.0, pair_exact(2.0)));
    assert_eq!(run.statistics(), Statistics { evaluations: 1, ..Statistics::default() });
}

/// A change of a state that is zero but for rounding, at a time that rounding resolves no further than steps would be.
#[test]
fn what_is_zero_but_for_rounding_begins_to_move() {
    const CHANGE: &[Group] = &[Group::new(Quantity::TangentVector, 1)];
    let mut run = RungeKutta8::new(|_, _: &[f64; 1]| [3.0], CHANGE, (0.2, [5e-16]), 1.7, 1e-13).unwrap();
    while !run.is_finished() {
        run.advance().unwrap();
    }
    assert!((run.y()[0] - 4.5).abs() < 1e-14, "{:?}", run.y());
}

/// An integration ends after as many steps as it may take, where a state that is rounding alone would ask for any number of them.
#[test]
fn steps_are_limited() {
    const CHANGE: &[Group] = &[Group::new(Quantity::TangentVector, 1)];
    let noise = |t: f64, _: &[f64; 1]| [(t * 1e20).sin()];
    let run = || RungeKutta8::new(noise, CHANGE, (0.0, [0.0]), 1.0, 1e-9).unwrap();
    assert_eq!(run().finish(2000), Err(Failure::StepLimit { limit: 2000 }));
    let smooth = RungeKutta8::new(|_, y: &[f64; 1]| [y[0]], CHANGE, (0.0, [1.0]), 1.0, 1e-9).unwrap();
    assert!((smooth.finish(2000).unwrap()[0] - 1.0_f64.exp()).abs() < 1e-8);
}

#[test]
fn blow_up_stops_before_the_pole_and_keeps_the_state() {
    // y' = y^2, y = 1/(1 - t).
    let square = |_: f64, y: &[f64; 1]| [y[0] * y[0]];
    const ONE: &[Group] = &[Group::new(Quantity::Other("y"), 1)];
    let mut run = RungeKutta8::new(square, ONE, (0.0, [1.0]), 2.0, 1e-10).unwrap();
    let failure = loop {
        if let Err(failure) = run.advance() {
            break failure;
        }
    };
    assert_eq!(failure, Failure::StepUnderflow);
    let (t, y) = (run.t(), run.y()[0]);
    assert!((t - 1.0).abs() < 1e-9, "the pole, up to the errors of the steps: {t}");
    assert!(y.is_finite() && y > 1e6);
    assert_eq!(run.advance(), Err(Failure::StepUnderflow), "and again");
    assert_eq!((run.t(), run.y()[0]), (t, y));
}

#[test]
fn what_is_not_finite_is_told_apart() {
    const ONE: &[Group] = &[Group::new(Quantity::Other("y"), 1)];
    let root = |_: f64, y: &[f64; 1]| [-1.0 / y[0].sqrt()];
    assert_eq!(RungeKutta8::new(root, ONE, (0.0, [-1.0]), 1.0, 1e-6).unwrap_err(), Failure::NotFinite);
    // Beyond t = 1 the right-hand side is NaN: rejections until the step underflows.
    let edge = |t: f64, _: &[f64; 1]| [if t > 1.0 { f64::NAN } else { 1.0 }];
    let mut run = RungeKutta8::new(edge, ONE, (0.0, [0.0]), 3.0, 1e-6).unwrap();
    let failure = loop {
        if let Err(failure) = run.advance() {
            break failure;
        }
    };
    assert_eq!(failure, Failure::NotFinite);
    assert!(run.t() <= 1.0 && run.t() > 1.0 - 1e-12, "{}", run.t());
    assert!((run.y()[0] - run.t()).abs() < 1e-12);
}

#[test]
fn units_of_time_and_state_do_not_matter() {
    // The same problem with time in another unit and the state in another: powers of two, so that even rounding
    // is the same.
    let (second, metre) = (1024.0, 0.125);
    let scaled = move |t: f64, y: &[f64; 2]| {
        let slopes = pair(t / second, &[y[0] / metre, y[1] / metre]);
        [slopes[0] * metre / second, slopes[1] * metre / second]
    };
    let mut plain = RungeKutta8::new(pair, PAIR, (0.0, pair_exact(0.0)), 2.0, 1e-9).unwrap();
    let start = pair_exact(0.0).map(|y| y * metre);
    let mut other = RungeKutta8::new(scaled, PAIR, (0.0, start), 2.0 * second, 1e-9).unwrap();
    while !plain.is_finished() {
        plain.advance().unwrap();
        other.advance().unwrap();
        assert_eq!(other.t(), plain.t() * second);
        assert_eq!(*other.y(), plain.y().map(|y| y * metre));
    }
    assert!(other.is_finished());
    assert_eq!(other.statistics(), plain.statistics());
}

/// The integration may run on wider vectors than the step by itself, which is compiled for every processor.
#[test]
fn steps_do_not_depend_on_the_vectors() {
    let start = four_exact(0.0);
    let mut run = RungeKutta8::new(four, FOUR, (0.0, start), 2.0, 1e-9).unwrap();
    let mut step = Step::start(&four, 0.0, start);
    for _ in 0..20 {
        run.advance().unwrap();
        step.attempt(&four, run.t());
        step.accept(&four);
        step.begin_next();
        assert_eq!(step.end().map(f64::to_bits), run.y().map(f64::to_bits), "at t = {}", run.t());
    }
}
