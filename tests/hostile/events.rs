//! Events whose functions, indices and changes make no sense.

use std::cell::Cell;

use affine_runtime::prelude::*;
use affine_runtime::simulate::{Reason, Setting};

use crate::sweep::{Ask, Outputs, Sweep, arrives, refused, sound, stops, sweep};

struct NotANumber;

impl Sweep for NotANumber {
    fn over<const N: usize, M: Model<N>>(&self, model: &M, start: M::Point<f64>, methods: &[Method]) {
        for &method in methods {
            let simulation = || sound().of(model, start, method);
            let label = |what: &str| format!("{method:?}: {what}");
            // At the start alone: looked at from the next sample on.
            let late = Event::new("late", |t, _: &M::Point<f64>| if t == 0.0 { f64::NAN } else { t - 0.3 });
            let run = arrives(simulation().event(late), 0.5, &label("NaN at the start"));
            let times: Vec<f64> = run.events().iter().map(|event| event.t).collect();
            assert!(times.len() == 1 && (times[0] - 0.3).abs() < 1e-9, "{method:?}: {times:?}");
            // From a time on, beside an event that is a number.
            let undefined = |t: f64, _: &M::Point<f64>| if t < 0.25 { -1.0 } else { f64::NAN };
            let good = Event::new("good", |t, _: &M::Point<f64>| t - 0.1);
            let run = simulation().event(good).event(Event::new("undefined", undefined).stop());
            let halt = stops(run, &label("NaN from 0.25 on"));
            let Reason::Event { event: "undefined", t } = halt.stop.reason else {
                panic!("{method:?}: {halt}")
            };
            assert!((0.25..=0.5).contains(&t) && halt.stop.t <= t, "{method:?}: {halt}");
            let message = halt.to_string();
            assert!(
                message.contains("`undefined` is NaN") && message.contains(&format!("t = {t}")),
                "{message}"
            );
            // At an output, which is recorded once.
            let ask = Ask { outputs: Outputs::Every(0.125), ..sound() };
            let run = ask.of(model, start, method).event(Event::new("due", |t, _: &M::Point<f64>| t - 0.25));
            assert_eq!(arrives(run, 0.5, &label("an event at an output")).len(), 5, "{method:?}");
            // Infinities have a sign.
            let jump = |t: f64, _: &M::Point<f64>| if t < 0.3 { f64::NEG_INFINITY } else { f64::INFINITY };
            let run =
                arrives(simulation().event(Event::new("jump", jump)), 0.5, &label("a jump of infinities"));
            let times: Vec<f64> = run.events().iter().map(|event| event.t).collect();
            assert!(times.len() == 1 && (times[0] - 0.3).abs() < 1e-12, "{method:?}: {times:?}");
        }
    }
}

#[test]
fn functions_that_are_no_numbers() {
    sweep(NotANumber);
}

struct Indices;

impl Sweep for Indices {
    fn over<const N: usize, M: Model<N>>(&self, model: &M, start: M::Point<f64>, methods: &[Method]) {
        for &method in methods {
            for index in [0, N + 1, usize::MAX] {
                let run = sound().of(model, start, method).event(Event::position(index, 0.0).named("gate"));
                let reason = refused(run, &["`gate`", &format!("component {index}")], &format!("{method:?}"));
                assert_eq!(reason, Reason::Setting(Setting::EventIndex { event: "gate", index }));
            }
        }
    }
}

#[test]
fn components_that_there_are_not() {
    sweep(Indices);
}

struct Levels;

impl Sweep for Levels {
    fn over<const N: usize, M: Model<N>>(&self, model: &M, start: M::Point<f64>, methods: &[Method]) {
        for &method in methods {
            let refused_level = |event: Event<'static, N, M::Point<f64>>, given: f64| {
                let run = sound().of(model, start, method).event(event.named("gate"));
                let reason = refused(run, &["`gate`", "levels are finite"], &format!("{method:?}"));
                let Reason::Setting(Setting::EventLevel { event: "gate", given: told }) = reason else {
                    panic!("{method:?}: {reason}")
                };
                assert!(told == given || told.is_nan() && given.is_nan(), "{method:?}: {told}");
            };
            for given in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
                refused_level(Event::determinant(given), given);
                refused_level(Event::position(1, given), given);
            }
            for given in [f64::NAN, f64::INFINITY, -1.0, 0.0] {
                refused_level(Event::largest_stretch(given), given);
                refused_level(Event::smallest_stretch(given), given);
            }
        }
    }
}

#[test]
fn levels_that_nothing_has() {
    sweep(Levels);
}

struct Changes;

impl Sweep for Changes {
    fn over<const N: usize, M: Model<N>>(&self, model: &M, start: M::Point<f64>, methods: &[Method]) {
        for &method in methods {
            let simulation = || Ask { max_steps: 200, ..sound() }.of(model, start, method);
            let at = |t0: f64| Event::new("change", move |t, _: &M::Point<f64>| t - t0);
            let label = |what: &str| format!("{method:?}: changed to {what}");
            // A point that is none.
            let nan = |_: f64, p: &M::Point<f64>| Ok(p.with_entries(&mut || f64::NAN));
            let halt = stops(simulation().event(at(0.2).change(nan)), &label("NaN"));
            let none = Reason::Change { event: "change" };
            assert_eq!(halt.stop.reason, none, "{method:?}");
            let flat = |_: f64, p: &M::Point<f64>| Ok(p.with_entries(&mut || 0.0));
            let halt = stops(simulation().event(at(0.2).change(flat)), &label("a point"));
            assert_eq!(halt.stop.reason, none, "{method:?}");
            assert!(
                halt.trajectory.events().last().is_some_and(|event| (event.t - 0.2).abs() < 1e-9),
                "{halt}"
            );
            // The errors of its function.
            for error in [
                affine_runtime::Error::CoincidentStretches,
                affine_runtime::Error::NotFinite { quantity: "p" },
                affine_runtime::Error::Placement { determinant: -1.0 },
            ] {
                let change = move |_: f64, _: &M::Point<f64>| Err(error.clone());
                let halt = stops(simulation().event(at(0.2).change(change)), &label("an error"));
                assert_eq!(halt.stop.reason, none, "{method:?}");
                assert!(halt.stop.t <= 0.2, "{halt}");
            }
            // A function with a memory, which happens without end.
            let sign = Cell::new(1.0);
            let restless = |_: f64, _: &M::Point<f64>| sign.replace(-sign.get());
            let endless = Event::new("restless", restless).change(|_, p| Ok(*p));
            match simulation().event(endless).run() {
                Ok(run) => assert!(run.events().len() < 10_000),
                Err(halt) => assert_eq!(halt.stop.reason, Reason::StepLimit { limit: 200 }, "{method:?}"),
            }
        }
    }
}

#[test]
fn changes_to_what_is_no_point_or_without_end() {
    sweep(Changes);
}
