//! Settings that make no sense.

use affine_runtime::prelude::*;
use affine_runtime::simulate::{Reason, Setting};

use crate::sweep::{Ask, Outputs, Sweep, arrives, refused, sound, sweep};

/// No numbers of any use.
const NO_NUMBERS: [f64; 3] = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY];

/// What is asked for, and the words of the refusal.
fn asks() -> Vec<(Ask, Vec<String>)> {
    let mut asks = Vec::new();
    let mut add = |ask: Ask, words: &[&str]| {
        asks.push((ask, words.iter().map(|word| (*word).to_owned()).collect()));
    };
    for tolerance in
        [0.0, -0.0, -1e-6, 5e-324, 1e-310, 1e-30, 9.9e-16, 1.0, 1e300].into_iter().chain(NO_NUMBERS)
    {
        add(
            Ask { tolerance, ..sound() },
            &[&format!("tolerance {tolerance:e}"), "at least 1e-15", "below 1"],
        );
    }
    for t in NO_NUMBERS {
        add(Ask { until: t, ..sound() }, &[&format!("the time of the end is {t}"), "finite"]);
        add(Ask { from: t, ..sound() }, &[&format!("the time of the start is {t}"), "finite"]);
        add(Ask { outputs: Outputs::At(vec![0.1, t]), ..sound() }, &[&format!("an output time is {t}")]);
    }
    for (from, until) in [(-1e308, 1e308), (1e308, -1e308), (0.0, 5e-324), (0.0, -5e-324), (1e-300, 1.5e-300)]
    {
        add(
            Ask { from, until, ..sound() },
            &[&format!("the interval from {from:e} to {until:e}"), "at least 1e-300"],
        );
    }
    add(Ask { max_steps: 0, ..sound() }, &["max_steps(0)"]);
    // 1e-9: five hundred million outputs; all before any memory is taken.
    for dt in [0.0, -0.0, -0.1, 1e-9, 1e-300, 5e-324].into_iter().chain(NO_NUMBERS) {
        let words = [&*format!("output every {dt:e} between 0 and 0.5"), "positive", "at most 1e8 outputs"];
        add(Ask { outputs: Outputs::Every(dt), ..sound() }, &words);
    }
    let many = Ask { until: 1e9, outputs: Outputs::Every(1.0), ..sound() };
    add(many, &["output every 1e0 between 0 and 1000000000", "at most 1e8 outputs"]);
    let lost = Ask { from: 1e20, until: 1e20 + 1e5, outputs: Outputs::Every(1.0), ..sound() };
    // Equal steps are refused before outputs are looked at.
    add(lost, &["between 1e20 and 1.000000000000001e20", "coarser than the rounding of times"]);
    for (times, words) in [
        (vec![0.1, 0.6], "output time 0.6 (number 1 of the list, from 0) lies outside the run from 0 to 0.5"),
        (vec![-1e-300], "output time -1e-300 (number 0 of the list, from 0) lies outside"),
        (vec![0.3, 0.2], "output time 0.2 (number 1 of the list, from 0) does not come after 0.3"),
        (vec![0.1, 0.3, 0.3], "output time 0.3 (number 2 of the list, from 0) does not come after 0.3"),
        (vec![0.0, -0.0], "output time -0 (number 1 of the list, from 0) does not come after 0"),
    ] {
        add(Ask { outputs: Outputs::At(times), ..sound() }, &[words]);
    }
    let backward = Ask { until: -0.5, outputs: Outputs::At(vec![-0.3, -0.1]), ..sound() };
    add(backward, &["output time -0.1 (number 1", "does not come after -0.3"]);
    asks
}

struct Settings;

impl Sweep for Settings {
    fn over<const N: usize, M: Model<N>>(&self, model: &M, start: M::Point<f64>, methods: &[Method]) {
        for &method in methods {
            for (ask, words) in asks() {
                let words: Vec<&str> = words.iter().map(String::as_str).collect();
                let reason = refused(ask.of(model, start, method), &words, &format!("{method:?} {ask:?}"));
                assert!(matches!(reason, Reason::Setting(_)), "{reason:?}");
            }
            let no_end = Simulation::new(model, start).method(method);
            assert_eq!(refused(no_end, &["no end time"], "no end"), Reason::Setting(Setting::NoEnd));
        }
    }
}

#[test]
fn tolerances_times_and_outputs() {
    sweep(Settings);
}

/// The same method with another step, where it has one.
fn with_step(method: Method, step: f64) -> Option<Method> {
    match method {
        Method::Gauss { stages, .. } => Some(Method::Gauss { stages, step }),
        Method::Rattle { order, .. } => Some(Method::Rattle { order, step }),
        Method::Splitting { order, .. } => Some(Method::Splitting { order, step }),
        _ => None,
    }
}

struct Steps;

impl Sweep for Steps {
    fn over<const N: usize, M: Model<N>>(&self, model: &M, start: M::Point<f64>, methods: &[Method]) {
        for &method in methods {
            for step in [0.0, -0.0, -0.1, 1e-300, 5e-324].into_iter().chain(NO_NUMBERS) {
                let Some(method) = with_step(method, step) else { continue };
                let words = [&*format!("a step of {step:e} between 0 and 0.5"), "positive"];
                let reason = refused(sound().of(model, start, method), &words, &format!("{method:?}"));
                assert!(matches!(reason, Reason::Setting(Setting::Step { .. })), "{reason:?}");
            }
            // Longer than the interval: one step, which ends where it should.
            for step in [1e300, 0.5, 0.500_000_1] {
                let Some(method) = with_step(method, step) else { continue };
                let ask = Ask { until: 1e-3, ..sound() };
                let run = arrives(ask.of(model, start, method), 1e-3, &format!("{method:?}"));
                assert_eq!(run.statistics().steps, 1, "{method:?}");
            }
        }
    }
}

#[test]
fn lengths_of_steps() {
    sweep(Steps);
}

/// Orders that a method does not have.
fn of_other_orders(method: Method) -> Vec<(Method, String)> {
    let orders = [0, 1, 33, usize::MAX];
    let named = |method: Method, order: usize| (method, format!("order {order}:"));
    match method {
        Method::Gauss { step, .. } => [0, 1, 99, usize::MAX]
            .map(|stages| (Method::Gauss { stages, step }, format!("Gauss collocation with {stages} stages")))
            .to_vec(),
        Method::Radau { .. } => [0, 1, 4, usize::MAX]
            .map(|given| {
                let words = format!("Radau collocation with {given} stages");
                (Method::Radau { stages: Some(given) }, words)
            })
            .to_vec(),
        Method::Rattle { step, .. } => {
            [0, 3, 10, usize::MAX].map(|order| named(Method::Rattle { order, step }, order)).to_vec()
        }
        Method::Splitting { step, .. } => {
            [0, 3, 10, usize::MAX].map(|order| named(Method::Splitting { order, step }, order)).to_vec()
        }
        Method::AdaptiveSplitting { .. } => [0, 3, 10, usize::MAX]
            .map(|order| named(Method::AdaptiveSplitting { order: Some(order) }, order))
            .to_vec(),
        Method::Taylor { .. } => {
            orders.map(|order| named(Method::Taylor { order: Some(order) }, order)).to_vec()
        }
        _ => Vec::new(),
    }
}

/// One of every kind of method.
fn all_methods() -> [Method; 11] {
    let step = 0.1;
    [
        Method::Automatic,
        Method::ClosedForm,
        Method::RungeKutta8,
        Method::RungeKutta5,
        Method::Taylor { order: None },
        Method::RungeKuttaNystrom12,
        Method::RungeKuttaNystrom8,
        Method::Rattle { order: 4, step },
        Method::Splitting { order: 4, step },
        Method::AdaptiveSplitting { order: None },
        Method::Radau { stages: None },
    ]
}

struct Orders;

impl Sweep for Orders {
    fn over<const N: usize, M: Model<N>>(&self, model: &M, start: M::Point<f64>, methods: &[Method]) {
        for &method in methods {
            for (method, words) in of_other_orders(method) {
                let reason = refused(sound().of(model, start, method), &[&words], &format!("{method:?}"));
                assert!(matches!(reason, Reason::Setting(_)), "{reason:?}");
            }
        }
        // Methods that do not serve the model are refused by its name.
        let kind = core::mem::discriminant::<Method>;
        for method in all_methods() {
            if methods.iter().any(|served| kind(served) == kind(&method)) {
                continue;
            }
            let halt = sound().of(model, start, method).run().err();
            let halt = halt.unwrap_or_else(|| panic!("{}: {method:?} runs", M::DESCRIPTION.name));
            assert!(matches!(halt.stop.reason, Reason::Setting(_)), "{method:?}: {halt}");
            assert!(halt.to_string().contains(M::DESCRIPTION.name), "{method:?}: {halt}");
            assert_eq!(halt.stop.steps, 0);
        }
    }
}

#[test]
fn orders_stages_and_methods_that_there_are_not() {
    sweep(Orders);
}
