//! Order, accuracy and cost of the Runge-Kutta-Nystrom methods on a nonlinear, non-autonomous problem with a known solution.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use affine_integrators::nystrom::{SecondOrder, Tableau};
use affine_integrators::{Failure, RungeKuttaNystrom, Statistics};
use affine_runtime::model::{Group, Quantity};

const MASSES: [f64; 2] = [2.0, 0.5];
const GROUPS: &[Group] = &[
    Group::new(Quantity::Placement, 2),
    Group::new(Quantity::CanonicalMomentum, 2),
    Group::new(Quantity::InverseDilatation, 1),
];

/// `q_1'' = q_1 (q_2^2 - sin t)`, `q_2'' = ln q_1 - sin t - q_2` with the solution `exp(sin t), cos t`; the state carries
/// `1/q_1`.
#[derive(Clone)]
struct Coupled;

impl SecondOrder<[f64; 5], ()> for Coupled {
    type Half = [f64; 2];
    fn drift(&self, (): &(), momenta: &[f64; 2]) -> [f64; 2] {
        [momenta[0] / MASSES[0], momenta[1] / MASSES[1]]
    }
    fn force(&self, t: f64, (): &(), q: &[f64; 2]) -> [f64; 2] {
        let sin = t.sin();
        [MASSES[0] * q[0] * (q[1] * q[1] - sin), MASSES[1] * (q[0].ln() - sin - q[1])]
    }
    fn renewed(&self, state: &[f64; 5]) -> [f64; 5] {
        [state[0], state[1], state[2], state[3], 1.0 / state[0]]
    }
}

fn exact(t: f64) -> [f64; 5] {
    let (sin, cos) = t.sin_cos();
    let q = sin.exp();
    [q, cos, MASSES[0] * q * cos, -MASSES[1] * sin, 1.0 / q]
}

fn distance(a: &[f64; 5], b: &[f64; 5]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

type Run = RungeKuttaNystrom<[f64; 5], (), Coupled>;

const METHODS: [&Tableau; 2] = [&Tableau::ORDER_12, &Tableau::ORDER_8];

fn started(method: &'static Tableau, (t0, t_end): (f64, f64), tolerance: f64) -> Run {
    RungeKuttaNystrom::new((Coupled, ()), method, GROUPS, (t0, exact(t0)), t_end, tolerance).unwrap()
}

fn run(method: &'static Tableau, interval: (f64, f64), tolerance: f64) -> Run {
    let mut run = started(method, interval, tolerance);
    while !run.is_finished() {
        run.advance().unwrap();
    }
    run
}

/// The error of one step of length `h` from the exact solution is of order `h^(p+1)`: in the mean over steps from six
/// times, at some of which the leading term is small.
fn assert_order(method: &'static Tableau, longest: f64) {
    let observed = (0..6).map(f64::from).map(|begin| {
        let mut run = started(method, (begin, 50.0), 0.999);
        run.advance().unwrap();
        let mut error = |part: f64| {
            let t = begin + part * longest;
            distance(&run.at(t).unwrap(), &exact(t))
        };
        let [long, short] = [error(1.0), error(0.8)];
        assert!(short > 2e-14, "rounding: {short}");
        (long / short).ln() / 1.25_f64.ln()
    });
    let order = observed.sum::<f64>() / 6.0;
    assert!((order - f64::from(method.order()) - 1.0).abs() < 1.0, "order {order}");
}

#[test]
fn solutions_are_of_their_orders() {
    assert_order(&Tableau::ORDER_12, 0.8);
    assert_order(&Tableau::ORDER_8, 0.5);
}

#[test]
fn errors_and_costs_follow_the_tolerance() {
    let costs = |method: &'static Tableau, each: (u64, u64), rows: [(f64, u64); 4]| {
        for (tolerance, steps) in rows {
            let run = run(method, (0.0, 6.0), tolerance);
            let error = distance(&Coupled.renewed(run.y()), &exact(6.0));
            let Statistics { steps: taken, rejected, evaluations, .. } = run.statistics();
            assert!(error < 10.0 * tolerance, "{tolerance:e}: {error:e}");
            assert!(taken <= steps, "{tolerance:e}: {taken} steps, {rejected} rejected");
            // The force at the start is that of the first step.
            let first = each.0 - each.1;
            assert_eq!(evaluations, 2 - first + each.0 * taken + each.1 * rejected, "{tolerance:e}");
        }
    };
    costs(&Tableau::ORDER_12, (17, 16), [(1e-3, 17), (1e-6, 21), (1e-9, 31), (1e-12, 45)]);
    costs(&Tableau::ORDER_8, (8, 8), [(1e-3, 17), (1e-6, 30), (1e-9, 60), (1e-12, 150)]);
}

#[test]
fn forth_and_back() {
    for method in METHODS {
        let there = run(method, (0.5, 8.0), 1e-13);
        let start = (8.0, Coupled.renewed(there.y()));
        let mut back = RungeKuttaNystrom::new((Coupled, ()), method, GROUPS, start, 0.5, 1e-13).unwrap();
        let mut before = back.t();
        while !back.is_finished() {
            back.advance().unwrap();
            assert!(back.t() < before);
            before = back.t();
        }
        assert_eq!(back.t(), 0.5);
        assert!(distance(&Coupled.renewed(back.y()), &exact(0.5)) < 1e-11);
    }
}

/// And looking there changes nothing of the steps.
#[test]
fn between_steps_the_error_is_that_of_a_step() {
    for method in METHODS {
        let mut run = started(method, (0.0, 10.0), 1e-11);
        let mut undisturbed = run.clone();
        assert_eq!(run.at(0.0).unwrap(), exact(0.0));
        let mut before = 0.0;
        while !run.is_finished() {
            run.advance().unwrap();
            undisturbed.advance().unwrap();
            assert_eq!((run.t(), run.y()), (undisturbed.t(), undisturbed.y()));
            for part in [0.1, 0.5, 0.9] {
                let t = before + part * (run.t() - before);
                assert!(distance(&run.at(t).unwrap(), &exact(t)) < 1e-9, "t = {t}");
            }
            assert_eq!(run.at(run.t()).unwrap(), Coupled.renewed(run.y()));
            before = run.t();
        }
    }
}

#[test]
fn nothing_to_do_costs_one_evaluation() {
    for method in METHODS {
        let mut run = started(method, (2.0, 2.0), 1e-9);
        run.advance().unwrap();
        assert_eq!((run.t(), *run.y()), (2.0, exact(2.0)));
        assert_eq!(run.statistics(), Statistics { evaluations: 1, ..Statistics::default() });
    }
}

/// `q'' = 6 q^2`, `q = 1/(1 - t)^2`.
struct Pole;

impl SecondOrder<[f64; 2], ()> for Pole {
    type Half = [f64; 1];
    fn drift(&self, (): &(), momenta: &[f64; 1]) -> [f64; 1] {
        *momenta
    }
    fn force(&self, _: f64, (): &(), q: &[f64; 1]) -> [f64; 1] {
        [6.0 * q[0] * q[0]]
    }
    fn renewed(&self, state: &[f64; 2]) -> [f64; 2] {
        *state
    }
}

#[test]
fn blow_up_stops_before_the_pole_and_keeps_the_state() {
    const LINE: &[Group] = &[Group::new(Quantity::Placement, 1), Group::new(Quantity::CanonicalMomentum, 1)];
    for method in METHODS {
        let start = (0.0, [1.0, 2.0]);
        let mut run = RungeKuttaNystrom::new((Pole, ()), method, LINE, start, 2.0, 1e-10).unwrap();
        let failure = loop {
            if let Err(failure) = run.advance() {
                break failure;
            }
        };
        assert!(matches!(failure, Failure::StepUnderflow | Failure::NotFinite), "{failure}");
        let (t, y) = (run.t(), *run.y());
        assert!((t - 1.0).abs() < 1e-6, "{t}");
        assert!(y[0] > 1e6 && y[0].is_finite());
        assert_eq!(run.advance(), Err(failure), "and again");
        assert_eq!((run.t(), *run.y()), (t, y));
        let nowhere = (0.0, [f64::NAN, 0.0]);
        let nowhere = RungeKuttaNystrom::new((Pole, ()), method, LINE, nowhere, 1.0, 1e-6);
        assert_eq!(nowhere.map(|run| run.t()), Err(Failure::NotFinite));
    }
}
