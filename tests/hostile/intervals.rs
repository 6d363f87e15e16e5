//! Intervals that look as if they made no sense.

use affine_runtime::prelude::*;
use affine_runtime::simulate::Reason;

use crate::sweep::{Ask, Outputs, Sweep, arrives, sound, stops, sweep};

/// The components of two points, apart by at most so much.
fn apart<const N: usize, M: Model<N>>(model: &M, a: &M::Point<f64>, b: &M::Point<f64>) -> f64 {
    let (a, b) = (model.flatten(a), model.flatten(b));
    let differences = a.as_ref().iter().zip(b.as_ref()).map(|(a, b)| (a - b).abs());
    differences.fold(0.0, |most: f64, d| if d <= most || most.is_nan() { most } else { d })
}

struct Short;

impl Sweep for Short {
    fn over<const N: usize, M: Model<N>>(&self, model: &M, start: M::Point<f64>, methods: &[Method]) {
        // Shorter than what can be told apart, or no interval at all; in either direction.
        let next = |t: f64| [t.next_up(), t.next_down()];
        let ends =
            [1.0, 1e6, -1e6].map(|from| [from, next(from)[0], next(from)[1]].map(|until| (from, until)));
        let tiny = [(0.0, 0.0), (0.0, 1e-300), (0.0, -1e-300), (1.0, 1.0 + 1e-14)];
        for &method in methods {
            for (from, until) in ends.into_iter().flatten().chain(tiny) {
                let label = format!("{method:?} from {from:e} to {until:e}");
                for outputs in
                    [Outputs::Steps, Outputs::Every(1.0), Outputs::At(vec![until]), Outputs::At(vec![])]
                {
                    let ask = Ask { from, until, outputs, ..sound() };
                    let run = arrives(ask.of(model, start, method), until, &label);
                    let off = apart(model, run.end().1, &start);
                    // Velocities and forces are of the order of ten.
                    assert!(off <= 20.0 * (until - from).abs() + 1e-15, "{label}: {off:e}");
                    assert!(until != from || off == 0.0, "{label}: {off:e}");
                }
            }
        }
    }
}

#[test]
fn of_no_length_and_hardly_any() {
    sweep(Short);
}

struct Endless;

impl Sweep for Endless {
    fn over<const N: usize, M: Model<N>>(&self, model: &M, start: M::Point<f64>, methods: &[Method]) {
        for &method in methods {
            for until in [1e308, -1e308, 1e100] {
                for outputs in [Outputs::Steps, Outputs::At(vec![until])] {
                    let ask = Ask { until, outputs, max_steps: 20, ..sound() };
                    let label = format!("{method:?} until {until:e}");
                    let halt = stops(ask.of(model, start, method), &label);
                    let reason = halt.stop.reason;
                    let is_plain = match method.step_length() {
                        Some(_) => matches!(reason, Reason::Setting(_)),
                        // No step is 1e-30 of the interval.
                        None => matches!(
                            reason,
                            Reason::StepLimit { limit: 20 }
                                | Reason::NotFinite
                                | Reason::StepUnderflow { .. }
                                | Reason::Unresolved { .. }
                        ),
                    };
                    assert!(is_plain, "{label}: {halt}");
                }
            }
        }
    }
}

/// The length of equal steps.
trait StepLength {
    fn step_length(&self) -> Option<f64>;
}

impl StepLength for Method {
    fn step_length(&self) -> Option<f64> {
        match self {
            Method::Gauss { step, .. } | Method::Rattle { step, .. } | Method::Splitting { step, .. } => {
                Some(*step)
            }
            _ => None,
        }
    }
}

#[test]
fn that_no_run_comes_to_the_end_of() {
    sweep(Endless);
}

/// An end between two steps, and more steps than are allowed.
struct Unfinished;

impl Sweep for Unfinished {
    fn over<const N: usize, M: Model<N>>(&self, model: &M, start: M::Point<f64>, methods: &[Method]) {
        let exact = |until: f64| {
            let run = Simulation::new(model, start).until(until).tolerance(1e-13).method(Method::RungeKutta8);
            *run.run().unwrap().end().1
        };
        for &method in methods.iter().filter(|method| method.step_length().is_some()) {
            for until in [0.1, -0.1] {
                // Fourteen steps of 0.007 and a rest: fifteen equal ones.
                let method = with_step(method, 0.007);
                let ask = Ask { until, outputs: Outputs::Every(0.03), ..sound() };
                let run = arrives(ask.of(model, start, method), until, &format!("{method:?}"));
                assert_eq!((run.statistics().steps, run.len()), (15, 5), "{method:?}");
                let off = apart(model, run.end().1, &exact(until));
                assert!(off < 1e-4, "{method:?}: {off:e}");
            }
            let method = with_step(method, 1e-7);
            let ask = Ask { max_steps: 10, ..sound() };
            let halt = stops(ask.of(model, start, method), &format!("{method:?}"));
            assert_eq!(halt.stop.reason, Reason::StepLimit { limit: 10 }, "{method:?}");
            assert!(halt.to_string().contains("10, is used up"), "{halt}");
            assert!((halt.stop.t - 1e-6).abs() < 1e-15, "{method:?}: {halt}");
        }
    }
}

fn with_step(method: Method, step: f64) -> Method {
    match method {
        Method::Gauss { stages, .. } => Method::Gauss { stages, step },
        Method::Rattle { order, .. } => Method::Rattle { order, step },
        Method::Splitting { order, .. } => Method::Splitting { order, step },
        other => other,
    }
}

#[test]
fn that_steps_do_not_divide_or_are_too_many_for() {
    sweep(Unfinished);
}
