//! Order, stiff accuracy and cost of Radau IIA collocation on problems with known solutions.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use affine_integrators::radau::{Differences, Exact, Tableau};
use affine_integrators::{Failure, Radau};
use affine_runtime::model::{Group, Quantity};

const ONE: &[Group] = &[Group::new(Quantity::Other("y"), 1)];
/// Two of different units.
const EACH: &[Group] = &[Group::new(Quantity::Other("x"), 1), Group::new(Quantity::Other("v"), 1)];
const PAIR: &[Group] = &[Group::new(Quantity::Other("y"), 2)];
const METHODS: [(&Tableau, i32); 3] = [(&Tableau::THREE, 5), (&Tableau::FIVE, 9), (&Tableau::SEVEN, 13)];

/// One step of a rotation errs as `h^(2 s)`.
#[test]
fn measured_orders() {
    let turn = |_: f64, y: &[f64; 2]| [-y[1], y[0]];
    for ((tableau, order), h) in METHODS.into_iter().zip([0.25, 2.0, 3.0]) {
        // The last step, after one of unit length where it is longer: a tolerance that any step meets, and linear equations,
        // which one correction solves.
        let error = |h: f64| {
            let t_end = if h < 1.0 { h } else { 1.0 + h };
            let start = (0.0, [1.0, 0.0]);
            let mut radau = Radau::new((turn, Differences), tableau, PAIR, start, t_end, 1e3).unwrap();
            let mut before = start;
            radau.advance().unwrap();
            while !radau.is_finished() {
                before = (radau.t(), *radau.y());
                radau.advance().unwrap();
            }
            assert!((t_end - before.0 - h).abs() < 1e-12, "a step of {h}: from {} to {t_end}", before.0);
            let ([x, y], (sin, cos)) = (before.1, h.sin_cos());
            (radau.y()[0] - (x * cos - y * sin)).hypot(radau.y()[1] - (x * sin + y * cos))
        };
        let measured = (error(h) / error(0.5 * h)).log2();
        assert!((measured - f64::from(order + 1)).abs() < 0.35, "order {order}: one step as h^{measured}");
    }
}

/// The problem of Prothero and Robinson: `y' = -k (y - cos t) - sin t`. The solution is `cos t`, whatever `k`.
#[test]
fn stiffness_costs_nothing() {
    for (tableau, _) in METHODS {
        let steps = [1e2, 1e5, 1e8, 1e11].map(|k: f64| {
            let f = move |t: f64, y: &[f64; 1]| [-k * (y[0] - t.cos()) - t.sin()];
            let slope = Exact(move |_: f64, _: &[f64; 1], _: usize| [-k]);
            let mut radau = Radau::new((f, slope), tableau, ONE, (0.0, [2.0]), 3.0, 1e-7).unwrap();
            while !radau.is_finished() {
                radau.advance().unwrap();
            }
            assert!((radau.y()[0] - 3.0_f64.cos()).abs() < 1e-6, "k = {k:e}: {radau:?}");
            radau.statistics().steps
        });
        assert!(steps[3] <= steps[0] + 40, "steps grow by those of the start alone: {steps:?}");
    }
}

/// The oscillator of van der Pol, with stiffness 1e6: the values at t = 2 that the Test Set for IVP Solvers gives
/// to 15 digits (F. Mazzia, C. Magherini, release 2.4, problem VDPOL).
#[test]
fn the_oscillator_of_van_der_pol() {
    const EPSILON: f64 = 1e-6;
    let f = |_: f64, y: &[f64; 2]| [y[1], ((1.0 - y[0] * y[0]) * y[1] - y[0]) / EPSILON];
    let exact = [0.170_616_773_217_048_3e1, -0.892_809_701_024_797_6];
    for tolerance in [1e-3, 1e-6, 1e-9, 1e-12] {
        let tableau = Tableau::for_tolerance(tolerance);
        let start = (0.0, [2.0, 0.0]);
        let mut radau = Radau::new((f, Differences), tableau, EACH, start, 2.0, tolerance).unwrap();
        while !radau.is_finished() {
            radau.advance().unwrap();
        }
        let [x, y] = *radau.y();
        let error = (x - exact[0]).hypot(y - exact[1]);
        assert!(error < 200.0 * tolerance + 1e-12, "{tolerance:e}: errs by {error:e}");
    }
}

/// Within a step the polynomial is as good as the steps, and the ends of a step are those of the steps.
#[test]
fn between_steps() {
    let f = |t: f64, y: &[f64; 1]| [-50.0 * (y[0] - t.cos())];
    let exact = |t: f64| (2500.0 * t.cos() + 50.0 * t.sin()) / 2501.0;
    let start = (0.0, [exact(0.0)]);
    let mut radau = Radau::new((f, Differences), &Tableau::FIVE, ONE, start, 2.0, 1e-8).unwrap();
    let mut before = start;
    while !radau.is_finished() {
        radau.advance().unwrap();
        let (t, y) = (radau.t(), *radau.y());
        for part in [0.1, 0.3, 0.5, 0.7, 0.9] {
            let between = before.0 + part * (t - before.0);
            let error = (radau.at(between).unwrap()[0] - exact(between)).abs();
            assert!(error < 1e-7, "{error:e} at {between}");
        }
        assert_eq!(radau.at(t), Ok(y));
        assert!((radau.at(before.0).unwrap()[0] - before.1[0]).abs() < 1e-15);
        before = (t, y);
    }
}

#[test]
fn what_has_no_solution_ends() {
    let new = |f: fn(f64, &[f64; 1]) -> [f64; 1], t_end: f64, tolerance: f64| {
        Radau::new((f, Differences), &Tableau::THREE, ONE, (0.0, [1.0]), t_end, tolerance)
    };
    assert_eq!(new(|_, _| [f64::NAN], 1.0, 1e-6).unwrap_err(), Failure::NotFinite);
    assert!(matches!(new(|_, y| *y, 1.0, 0.0).unwrap_err(), Failure::Tolerance { .. }));
    assert!(matches!(new(|_, y| *y, f64::INFINITY, 1e-6).unwrap_err(), Failure::Time { .. }));
    // `y = 1/(1 - t)`.
    let mut radau = new(|_, y| [y[0] * y[0]], 2.0, 1e-6).unwrap();
    let failure = loop {
        if let Err(failure) = radau.advance() {
            break failure;
        }
        assert!(radau.t() < 1.0 + 1e-6 && radau.statistics().steps < 10_000, "{radau:?}");
    };
    assert!((radau.t() - 1.0).abs() < 1e-3, "{failure}: {radau:?}");
    assert_eq!(radau.advance(), Err(failure), "now and ever after");
    // No number from `t = 1` on: there is no step, and no defect of one.
    let mut radau = new(|t, _| [(1.0 - t).sqrt()], 2.0, 1e-6).unwrap();
    let failure = (0..10_000).find_map(|_| radau.advance().err()).unwrap();
    assert!((radau.t() - 1.0).abs() < 1e-3, "{radau:?}");
    assert_eq!((failure, radau.advance()), (Failure::StepUnderflow, Err(failure)));
}
