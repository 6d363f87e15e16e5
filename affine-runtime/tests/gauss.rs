//! Order, invariants, reversibility and cost of Gauss collocation on problems with known solutions or invariants.
//! The coefficients are checked in exact arithmetic beside them.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use affine_integrators::gauss::Tableau;
use affine_integrators::{Failure, Gauss, Statistics};

const METHODS: [&Tableau; 4] = [&Tableau::TWO, &Tableau::THREE, &Tableau::FOUR, &Tableau::SIX];

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

/// Euler's free rigid body with the moments of inertia 1, 2, 3: `L' = L x I^-1 L`.
fn rigid_body(_: f64, l: &[f64; 3]) -> [f64; 3] {
    let w = [l[0], l[1] / 2.0, l[2] / 3.0];
    [l[1] * w[2] - l[2] * w[1], l[2] * w[0] - l[0] * w[2], l[0] * w[1] - l[1] * w[0]]
}

const SPIN: [f64; 3] = [0.4, 1.1, -0.7];

/// The mathematical pendulum, `H = p^2/2 - cos q`: canonical, not quadratic.
fn pendulum(_: f64, y: &[f64; 2]) -> [f64; 2] {
    [y[1], -y[0].sin()]
}

fn distance<const D: usize>(a: &[f64; D], b: &[f64; D]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs() / (1.0 + b.abs())).fold(0.0, f64::max)
}

fn run<const D: usize, F: Fn(f64, &[f64; D]) -> [f64; D]>(
    f: F,
    tableau: &'static Tableau,
    start: (f64, [f64; D]),
    t_end: f64,
    step: f64,
) -> Gauss<[f64; D], F> {
    let mut run = Gauss::new(f, tableau, start, t_end, step).unwrap();
    while !run.is_finished() {
        run.advance().unwrap();
    }
    assert_eq!(run.t(), t_end);
    run
}

#[test]
fn orders_are_4_6_8_and_12() {
    let four = |tableau, n: f64| {
        distance(run(four, tableau, (0.0, four_exact(0.0)), 2.0, 2.0 / n).y(), &four_exact(2.0))
    };
    let pair = |tableau, n: f64| {
        distance(run(pair, tableau, (0.0, pair_exact(0.0)), 3.0, 6.0 / n).y(), &pair_exact(3.0))
    };
    let observed = |error: &dyn Fn(f64) -> f64, steps: [f64; 2]| {
        let [first, last] = steps.map(error);
        assert!(last > 1e-13, "rounding hides the order: {last:e}");
        (first / last).ln() / (steps[1] / steps[0]).ln()
    };
    // Steps that resolve the motion and leave errors above rounding.
    for (tableau, steps_of_four, steps_of_pair) in [
        (&Tableau::TWO, [100.0, 200.0], [100.0, 200.0]),
        (&Tableau::THREE, [60.0, 120.0], [60.0, 120.0]),
        (&Tableau::FOUR, [32.0, 64.0], [16.0, 32.0]),
        (&Tableau::SIX, [16.0, 26.0], [5.0, 9.0]),
    ] {
        let order = 2.0 * tableau.stages() as f64;
        for found in
            [observed(&|n| four(tableau, n), steps_of_four), observed(&|n| pair(tableau, n), steps_of_pair)]
        {
            assert!((found - order).abs() < 0.05 * order, "{order}: {found}");
        }
    }
}

#[test]
fn output_between_steps_is_of_the_order_of_the_steps_and_leaves_them_alone() {
    for (tableau, [order, step]) in
        METHODS.into_iter().zip([[4.0, 0.1], [6.0, 0.1], [8.0, 0.2], [12.0, 0.75]])
    {
        let error = |step: f64| {
            let mut plain = Gauss::new(pair, tableau, (0.0, pair_exact(0.0)), 3.0, step).unwrap();
            let mut watched = plain.clone();
            let mut largest = 0.0f64;
            while !plain.is_finished() {
                plain.advance().unwrap();
                watched.advance().unwrap();
                assert_eq!(plain.y(), watched.y());
                for part in [0.9, 0.2, 0.55] {
                    let t = watched.t() - part * watched.step_length();
                    largest = largest.max(distance(&watched.at(t).unwrap(), &pair_exact(t)));
                }
                assert_eq!(watched.at(watched.t()).unwrap(), *watched.y());
            }
            largest
        };
        let observed = (error(step) / error(step / 2.0)).log2();
        assert!((observed - order).abs() < 0.05 * order, "{order}: {observed}");
    }
}

#[test]
fn quadratic_invariants_are_kept_to_rounding() {
    // Rounding walks at random: sqrt(N) roundings of the state, with room for a lucky or unlucky seed.
    let steps = 100_000.0f64;
    let bound = 8.0 * f64::EPSILON * steps.sqrt();
    let energy = |l: &[f64; 3]| (l[0] * l[0] + l[1] * l[1] / 2.0 + l[2] * l[2] / 3.0) / 2.0;
    let casimir = |l: &[f64; 3]| l.iter().map(|l| l * l).sum::<f64>();
    for tableau in METHODS {
        let mut run = Gauss::new(rigid_body, tableau, (0.0, SPIN), 0.1 * steps, 0.1).unwrap();
        let mut worst = 0.0f64;
        while !run.is_finished() {
            run.advance().unwrap();
            worst = worst.max((energy(run.y()) / energy(&SPIN) - 1.0).abs());
            worst = worst.max((casimir(run.y()) / casimir(&SPIN) - 1.0).abs());
        }
        assert!(worst < bound, "{worst:e}");
        assert!(!run.is_stiff());
    }
}

/// Where the force vanishes at the start, the first guess of the placement is right: placement and momentum change in turn.
#[test]
fn a_start_without_forces_is_solved_to_rounding() {
    for tableau in METHODS {
        for step in [0.2, 0.1, 0.05, 0.02] {
            let there = run(pendulum, tableau, (0.0, [0.0, 1.0]), 1.0, step);
            let back = run(pendulum, tableau, (1.0, *there.y()), 0.0, step);
            let (residual, error) = (there.residual().unwrap(), distance(back.y(), &[0.0, 1.0]));
            assert!(
                residual < 1e-15 && error < 1e-14,
                "{} stages, {step}: {residual:e}, {error:e}",
                tableau.stages()
            );
        }
    }
}

#[test]
fn steps_are_symplectic() {
    // det of the derivative of the flow in one degree of freedom, by central differences of its own long steps.
    for tableau in METHODS {
        let flow = |q: f64, p: f64| *run(pendulum, tableau, (0.0, [q, p]), 2.0, 0.5).y();
        let d = 1e-4;
        let (q, p) = (0.8, 0.9);
        let (by_q, by_p) = ([flow(q + d, p), flow(q - d, p)], [flow(q, p + d), flow(q, p - d)]);
        let column = |[a, b]: [[f64; 2]; 2]| [(a[0] - b[0]) / (2.0 * d), (a[1] - b[1]) / (2.0 * d)];
        let (a, b) = (column(by_q), column(by_p));
        let determinant = a[0] * b[1] - a[1] * b[0];
        // The differences are right to d^2; the error of the steps themselves is larger than that.
        assert!((determinant - 1.0).abs() < 1e-7, "{determinant}");
    }
}

#[test]
fn energy_of_the_pendulum_does_not_drift() {
    let energy = |y: &[f64; 2]| y[1] * y[1] / 2.0 - y[0].cos();
    let steps = [(0.2, 2e-5), (0.2, 2e-7), (0.5, 2e-7), (1.0, 2e-7)];
    for (tableau, (step, amplitude)) in METHODS.into_iter().zip(steps) {
        let start = [1.5, 0.3];
        let mut run = Gauss::new(pendulum, tableau, (0.0, start), 4000.0, step).unwrap();
        let mut halves = [0.0f64; 2];
        while !run.is_finished() {
            run.advance().unwrap();
            let half = usize::from(run.t() > 2000.0);
            halves[half] = halves[half].max((energy(run.y()) - energy(&start)).abs());
        }
        assert!(halves[1] < amplitude && halves[1] > 1e-12, "{halves:?}");
        assert!(halves[1] < 1.001 * halves[0], "no secular growth: {halves:?}");
    }
}

#[test]
fn back_to_the_start() {
    for (tableau, step) in METHODS.into_iter().zip([0.2, 0.2, 0.5, 1.0]) {
        let there = *run(pendulum, tableau, (0.0, [1.5, 0.3]), 100.0, step).y();
        let back = *run(pendulum, tableau, (100.0, there), 0.0, step).y();
        let error = distance(&back, &[1.5, 0.3]);
        let forth = distance(&there, run(pendulum, tableau, (0.0, [1.5, 0.3]), 100.0, 0.01).y());
        assert!(error < 1e-12 && forth > 1e3 * error, "{error:e} {forth:e}");
    }
    let backward = run(four, &Tableau::THREE, (1.5, four_exact(1.5)), -0.5, 0.01);
    assert!(distance(backward.y(), &four_exact(-0.5)) < 1e-9);
}

#[test]
fn output_leaves_stiff_steps_alone() {
    let mut plain = Gauss::new(van_der_pol, &Tableau::THREE, (0.0, [2.0, -2.0 / 3.0]), 0.3, 0.01).unwrap();
    let mut watched = plain.clone();
    while !plain.is_finished() {
        plain.advance().unwrap();
        watched.advance().unwrap();
        assert_eq!(plain.y(), watched.y(), "to the last bit");
        let t = watched.t() - 0.3 * watched.step_length();
        let between = watched.at(t).unwrap();
        assert!((between[0] - watched.y()[0]).abs() < 0.01, "{between:?}");
    }
    assert!(watched.is_stiff());
    assert!(watched.statistics().evaluations > plain.statistics().evaluations);
}

/// Prothero and Robinson: `y' = -1e6 (y - cos t) - sin t`, with the solution `cos t`.
fn stiff(t: f64, y: &[f64; 1]) -> [f64; 1] {
    [-1e6 * (y[0] - t.cos()) - t.sin()]
}

/// Van der Pol's oscillator at `mu = 1000` in the time of its slow motion.
fn van_der_pol(_: f64, y: &[f64; 2]) -> [f64; 2] {
    [y[1], 1e6 * ((1.0 - y[0] * y[0]) * y[1]) - 1e6 * y[0]]
}

#[test]
fn stiff_equations_are_solved_by_newton() {
    for tableau in METHODS {
        // h lambda = 5e4: fixed-point iteration would grow by that.
        let run = run(stiff, tableau, (0.0, [1.0]), 2.0, 0.05);
        assert!(run.is_stiff());
        assert!(run.residual().unwrap() < 1e-10, "{:?}", run.residual());
        // Stage order s, multiplied by 1 because |R(inf)| = 1.
        assert!(distance(run.y(), &[2.0f64.cos()]) < 1e-4, "{:?}", run.y());
    }
    // The slow branch y^2 > 1 obeys y' = y/(1 - y^2) up to 1e-6.
    let start = [2.0, 2.0 / (1.0 - 4.0)];
    let slow = |_: f64, y: &[f64; 1]| [y[0] / (1.0 - y[0] * y[0])];
    let expected = run(slow, &Tableau::THREE, (0.0, [2.0]), 0.5, 0.01).y()[0];
    let found = run(van_der_pol, &Tableau::THREE, (0.0, start), 0.5, 0.01);
    assert!(found.is_stiff());
    assert!((found.y()[0] - expected).abs() < 1e-5, "{:?} {expected}", found.y());
}

#[test]
fn equations_without_solution_are_refused() {
    // y' = 1 + y^2 over a step of 10: L = h (1 + (y + L/2)^2) and the like have no real solution.
    let tangent = |_: f64, y: &[f64; 1]| [1.0 + y[0] * y[0]];
    for tableau in METHODS {
        let mut run = Gauss::new(tangent, tableau, (0.0, [0.0]), 10.0, 10.0).unwrap();
        let failure = run.advance().unwrap_err();
        let Failure::NoSolution { residual } = failure else { panic!("{failure:?}") };
        assert!(residual > 1e-6, "{residual:e}");
        assert_eq!((run.t(), run.y()[0], run.statistics().steps), (0.0, 0.0, 0), "the start stands");
        assert_eq!(run.advance(), Err(failure), "and again");
        assert!(failure.to_string().contains("no solution"));
    }
}

#[test]
fn a_correction_that_blows_up_is_no_small_residual() {
    // Of the same equations: where Newton's matrix is nearly singular, a defect is small beside what it makes of it.
    let tangent = |_: f64, y: &[f64; 1]| [1.0 + y[0] * y[0]];
    let mut least = f64::INFINITY;
    for tableau in METHODS {
        for k in 0..400 {
            let y0 = 0.01 * f64::from(k) - 2.0;
            let mut run = Gauss::new(tangent, tableau, (0.0, [y0]), 10.0, 10.0).unwrap();
            match run.advance() {
                Err(Failure::NoSolution { residual }) => least = least.min(residual),
                other => panic!("{y0}: {other:?}"),
            }
        }
    }
    assert!(least > 0.1, "{least:e}");
}

/// An iteration that leaves a good guess says where it ended: a residual that would count as solved is none of equations that are
/// not.
#[test]
fn an_iteration_that_diverges_is_no_small_residual() {
    // More components than Newton's iteration takes, one of which gains while the changes of another grow, from 1e-12 or less.
    let rates = |k: usize| [0.0, 20.0, 0.5].get(k).copied().unwrap_or(0.0);
    let growing = |_: f64, y: &[f64; 40]| core::array::from_fn(|k| rates(k) * y[k]);
    for tableau in METHODS {
        let start: [f64; 40] = core::array::from_fn(|k| [1.0, 1e-14, 1e-11].get(k).copied().unwrap_or(0.0));
        let mut run = Gauss::new(growing, tableau, (0.0, start), 1.0, 1.0).unwrap();
        let Err(Failure::NoSolution { residual }) = run.advance() else {
            panic!("a step of ten times the rate")
        };
        assert!(residual > 1e-10, "{residual:e}");
    }
}

#[test]
fn what_is_not_finite_and_steps_that_make_no_sense_are_refused() {
    let edge = |t: f64, _: &[f64; 1]| [if t > 1.0 { f64::NAN } else { 1.0 }];
    let mut run = Gauss::new(edge, &Tableau::TWO, (0.0, [0.0]), 3.0, 0.25).unwrap();
    let failure = loop {
        if let Err(failure) = run.advance() {
            break failure;
        }
    };
    assert_eq!((failure, run.t()), (Failure::NotFinite, 1.0));
    assert!((run.y()[0] - 1.0).abs() < 1e-15);
    let new = |y: f64, step: f64| Gauss::new(edge, &Tableau::TWO, (0.0, [y]), 3.0, step).map(|run| run.t());
    assert_eq!(new(f64::NAN, 0.1), Err(Failure::NotFinite));
    for step in [0.0, -0.1, f64::NAN, 1e-17] {
        assert!(matches!(new(0.0, step), Err(Failure::Step { t_end: 3.0, .. })), "{step}");
    }
    assert_eq!(Tableau::of_stages(5), None);
}

#[test]
fn steps_are_equal_and_hit_the_end() {
    let count = |t_end: f64, step: f64| {
        let mut run = Gauss::new(pendulum, &Tableau::TWO, (0.0, [1.0, 0.0]), t_end, step).unwrap();
        let mut count = 0;
        while !run.is_finished() {
            run.advance().unwrap();
            count += 1;
        }
        assert_eq!((run.t(), run.statistics().steps), (t_end, count));
        count
    };
    assert_eq!(
        [count(1.0, 0.1), count(1.0, 0.3), count(0.3, 0.1), count(-1.0, 0.3), count(0.5, 2.0)],
        [10, 4, 3, 4, 1]
    );
    assert_eq!(count(0.0, 0.1), 0);
}

#[test]
fn evaluations_are_counted() {
    // Arithmetic alone, the same everywhere but where the target fuses multiply-adds: there iterations may end elsewhere.
    let is_counted = |found: Statistics, (steps, evaluations): (u64, u64)| {
        if cfg!(target_feature = "fma") {
            assert!(
                found.evaluations.abs_diff(evaluations) <= evaluations / 50,
                "{found:?} for {evaluations}"
            );
        } else {
            assert_eq!(found, Statistics { steps, evaluations, ..Statistics::default() });
        }
    };
    // Fixed-point: one at the start, then stages times iterations.
    let of = |tableau, step| run(rigid_body, tableau, (0.0, SPIN), 20.0, step).statistics();
    is_counted(of(&Tableau::TWO, 0.1), (200, 3391));
    is_counted(of(&Tableau::THREE, 0.1), (200, 4360));
    is_counted(of(&Tableau::THREE, 0.4), (50, 1624));
    is_counted(of(&Tableau::FOUR, 0.4), (50, 1877));
    is_counted(of(&Tableau::SIX, 0.4), (50, 2485));
    // Newton: the three of a Jacobian now and then.
    let stiff = run(van_der_pol, &Tableau::THREE, (0.0, [2.0, -2.0 / 3.0]), 0.5, 0.01);
    assert!(stiff.is_stiff());
    is_counted(stiff.statistics(), (50, 1750));
}
