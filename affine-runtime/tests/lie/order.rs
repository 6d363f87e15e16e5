//! Measured orders on nonlinear, non-autonomous equations.

use affine_integrators::gauss::Tableau;
use affine_integrators::lie::{Chart, Coordinates, Sum};
use affine_integrators::runge_kutta::Step;
use affine_integrators::{Gauss, RungeKutta8};
use affine_runtime::model::{Constraint, Group, Quantity};

use crate::curve::{GROUPS, defect, distance, equations, solution};

const T_END: f64 = 2.0;

/// Error at the end after `n` equal steps of order 8 in the chart around the beginning of each.
fn of_runge_kutta<const N: usize, const D: usize>(constraint: Constraint, n: usize) -> f64 {
    let (chart, f) = (Chart::<N>::new(constraint, 0), equations::<N, D>(constraint));
    let mut base = Sum::of(solution::<N, D>(constraint, 0.0));
    let time = |i: usize| T_END * i as f64 / n as f64;
    for i in 0..n {
        let field = |t: f64, z: &[f64; D]| {
            let state = chart.state(&base, z).value;
            chart.velocity(&state, z, &f(t, &state))
        };
        let mut step = Step::start(&field, time(i), chart.origin(&base).value);
        step.attempt(&field, time(i + 1));
        step.accept(&field);
        base = chart.state(&base, step.end());
    }
    distance(&base.value, &solution::<N, D>(constraint, T_END))
}

fn of_gauss<const N: usize, const D: usize>(
    constraint: Constraint,
    tableau: &'static Tableau,
    n: usize,
) -> f64 {
    let start = (0.0, solution::<N, D>(constraint, 0.0));
    let chart = Chart::<N>::new(constraint, 0);
    let f = equations::<N, D>(constraint);
    let mut run = Gauss::within(chart, f, tableau, start, T_END, T_END / n as f64).unwrap();
    while !run.is_finished() {
        run.advance().unwrap();
    }
    assert_eq!(run.statistics().steps, n as u64);
    distance(run.y(), &solution::<N, D>(constraint, T_END))
}

fn observed(error: impl Fn(usize) -> f64, n: usize) -> f64 {
    let (first, last) = (error(n), error(2 * n));
    assert!(last > 2e-14, "rounding hides the order: {last:e}");
    (first / last).log2()
}

#[test]
fn runge_kutta_is_of_order_8() {
    for constraint in GROUPS {
        let plane = observed(|n| of_runge_kutta::<2, 5>(constraint, n), 10);
        let space = observed(|n| of_runge_kutta::<3, 10>(constraint, n), 10);
        for order in [plane, space] {
            assert!((order - 8.0).abs() < 0.8, "{constraint:?} {plane} {space}");
        }
    }
}

#[test]
fn gauss_is_of_orders_4_and_6() {
    for constraint in GROUPS {
        for (tableau, order, n) in [(&Tableau::TWO, 4.0, 80), (&Tableau::THREE, 6.0, 40)] {
            let plane = observed(|n| of_gauss::<2, 5>(constraint, tableau, n), n);
            let space = observed(|n| of_gauss::<3, 10>(constraint, tableau, n), n);
            for found in [plane, space] {
                assert!((found - order).abs() < 0.25, "{constraint:?} {plane} {space}");
            }
        }
    }
}

const SPACE: &[Group] = &[Group::new(Quantity::Placement, 9), Group::new(Quantity::Other("s"), 1)];

#[test]
fn adaptive_steps_and_dense_output_follow_the_tolerance() {
    for constraint in GROUPS {
        for tolerance in [1e-6, 1e-9, 1e-12] {
            let f = equations::<3, 10>(constraint);
            let start = (0.0, solution::<3, 10>(constraint, 0.0));
            let chart = Chart::<3>::new(constraint, 0);
            let mut run = RungeKutta8::within(chart, f, SPACE, start, T_END, tolerance).unwrap();
            let (mut between, mut off) = (0.0f64, 0.0f64);
            while !run.is_finished() {
                let begin = run.t();
                run.advance().unwrap();
                let dense = run.dense();
                for part in [0.1, 0.35, 0.5, 0.8] {
                    let t = begin + part * (run.t() - begin);
                    let state = dense.at(t);
                    between = between.max(distance(&state, &solution::<3, 10>(constraint, t)));
                    let phi = affine_runtime::frames::Matrix::<3>::from_row_slice(&state[..9]);
                    off = off.max(defect(constraint, &phi));
                }
                assert_eq!(dense.at(run.t()), *run.y());
            }
            let error = distance(run.y(), &solution::<3, 10>(constraint, T_END));
            // The equations pull away from the solution: errors grow by a few powers of ten on the way.
            assert!(error < 3e3 * tolerance, "{constraint:?} {tolerance:e}: {error:e}");
            assert!(between < 1e4 * tolerance, "{constraint:?} {tolerance:e}: {between:e} between steps");
            assert!(off < 3e-14, "dense output is on the group: {constraint:?} {off:e}");
            let steps = run.statistics();
            assert!(steps.evaluations < 16 * (steps.steps + steps.rejected) + 20, "{steps:?}");
        }
    }
}

#[test]
fn gauss_is_symmetric() {
    // Forth and back by steps far too long to be accurate.
    for constraint in GROUPS {
        for tableau in [&Tableau::TWO, &Tableau::THREE] {
            let chart = Chart::<3>::new(constraint, 0);
            let f = equations::<3, 10>(constraint);
            let start = solution::<3, 10>(constraint, 0.0);
            let go = |from: f64, y: [f64; 10], to: f64| {
                let mut run = Gauss::within(chart, f, tableau, (from, y), to, 0.1).unwrap();
                while !run.is_finished() {
                    run.advance().unwrap();
                }
                *run.y()
            };
            let there = go(0.0, start, 1.0);
            let missed = distance(&there, &solution::<3, 10>(constraint, 1.0));
            let back = distance(&go(1.0, there, 0.0), &start);
            assert!(back < 1e-12 && missed > 1e3 * back, "{constraint:?} {back:e} {missed:e}");
        }
    }
}
