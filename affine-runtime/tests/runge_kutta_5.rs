//! Order, accuracy and cost of the Runge-Kutta method of order 5.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use affine_integrators::RungeKutta5;
use affine_integrators::lie::Chart;
use affine_integrators::runge_kutta::{DormandPrince54, OneStep};
use affine_runtime::model::{Constraint, Group, Quantity};

const PAIR: &[Group] = &[Group::new(Quantity::Other("y"), 2)];

/// A coupled pair with the solution `(sin t, 1/(1 + t^2))`.
fn pair(t: f64, y: &[f64; 2]) -> [f64; 2] {
    let (sin, cos) = t.sin_cos();
    [cos + (y[0] * y[0] - sin * sin) * y[1], -2.0 * t * y[1] * y[1] + y[0] * y[0] - sin * sin]
}

fn exact(t: f64) -> [f64; 2] {
    [t.sin(), 1.0 / (1.0 + t * t)]
}

fn distance(a: &[f64; 2], b: &[f64; 2]) -> f64 {
    (a[0] - b[0]).abs().max((a[1] - b[1]).abs())
}

/// Errors at t = 2 after `n` equal steps, and of the dense output of each step from the exact solution.
fn errors(n: usize) -> (f64, f64) {
    let time = |i: usize| 2.0 * i as f64 / n as f64;
    let mut step = OneStep::<DormandPrince54, _>::start(&pair, 0.0, exact(0.0));
    let mut dense_error = 0.0f64;
    for i in 0..n {
        step.begin_next();
        let mut local = OneStep::<DormandPrince54, _>::start(&pair, time(i), exact(time(i)));
        local.attempt(&pair, time(i + 1));
        local.accept(&pair);
        let dense = local.dense(&pair);
        for theta in [0.15, 0.5, 0.8] {
            let t = time(i) + theta * 2.0 / n as f64;
            dense_error = dense_error.max(distance(&dense.at(t), &exact(t)));
        }
        step.attempt(&pair, time(i + 1));
        step.accept(&pair);
    }
    (distance(step.end(), &exact(2.0)), dense_error)
}

#[test]
fn solution_is_of_order_5_and_dense_output_of_order_4() {
    let (few, many) = (errors(150), errors(300));
    let orders = ((few.0 / many.0).log2(), (few.1 / many.1).log2());
    // The error of the polynomial over one step is of order h^5.
    assert!((orders.0 - 5.0).abs() < 0.3 && (orders.1 - 5.0).abs() < 0.3, "{orders:?}");
}

#[test]
fn errors_and_costs_follow_the_tolerance() {
    for tolerance in [1e-3, 1e-6, 1e-9] {
        let mut run = RungeKutta5::new(pair, PAIR, (0.0, exact(0.0)), 4.0, tolerance).unwrap();
        while !run.is_finished() {
            run.advance().unwrap();
            let (t, y) = (run.t(), *run.y());
            assert_eq!(run.dense().at(t), y);
        }
        let cost = run.statistics();
        assert!(distance(run.y(), &exact(4.0)) < 20.0 * tolerance, "{tolerance:e}");
        assert_eq!(
            cost.evaluations,
            2 + 6 * (cost.steps + cost.rejected),
            "six for a step, dense output free"
        );
    }
}

/// Turns about an axis at a rate that changes: `phi' = cos(t) phi w`.
#[test]
fn stays_on_the_group_in_its_chart() {
    const GROUPS: &[Group] = &[Group::new(Quantity::Placement, 4)];
    let chart = Chart::<2>::new(Constraint::Rigid, 0);
    let turning = |t: f64, y: &[f64; 4]| [y[1], -y[0], y[3], -y[2]].map(|v| v * t.cos());
    let start = (0.0, [1.0, 0.0, 0.0, 1.0]);
    let mut run = RungeKutta5::within(chart, turning, GROUPS, start, 5.0, 1e-9).unwrap();
    while !run.is_finished() {
        run.advance().unwrap();
    }
    let angle = 5.0_f64.sin();
    let expected = [angle.cos(), -angle.sin(), angle.sin(), angle.cos()];
    let error = run.y().iter().zip(expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(error < 1e-7, "{error:e}");
    assert!((run.y()[0] * run.y()[3] - run.y()[1] * run.y()[2] - 1.0).abs() < 1e-14);
}
