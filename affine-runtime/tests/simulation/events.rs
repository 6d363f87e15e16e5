//! Events against closed forms of the motion.

use affine_runtime::__private::point;
use affine_runtime::Simulation;
use affine_runtime::frames::{Matrix, TwoPoint, Vector};
use affine_runtime::simulate::{Event, Method, Reason, Setting};
use affine_runtime::state::{Centre, Phase, Pinned};

use crate::models::drunk_missile::{self, DrunkMissile};
use crate::models::planar::{self, Disc, Planar};

/// Times: the error of the motion at the finest tolerances over rates of order 1.
const TIME: f64 = 1e-12;

const METHODS: [Method; 2] = [Method::RungeKutta8, Method::Gauss { stages: 3, step: 0.005 }];

fn swinging() -> Simulation<'static, 2, Planar> {
    Simulation::new(&Planar::SPRING, planar::start(0.5)).until(7.0).tolerance(1e-15)
}

/// `phi12 = 0.2 cos t`, `phi22 = 1.5 cos t - 0.2 sin t`; a function without orientation to lose.
fn phi(i: usize, k: usize) -> impl Fn(f64, &Disc) -> f64 {
    move |_, point| point.phi()[(i, k)]
}

/// `phi11 = cos t + 0.5 sin t` and `phi22` meet where `tan t = 0.5/0.7`: all the while `det phi > 0`.
fn meeting() -> Event<'static, 2, Disc> {
    Event::new("meeting", |_, point: &Disc| point.phi()[(0, 0)] - point.phi()[(1, 1)])
}

#[test]
fn a_collapse_is_located() {
    // det phi = (1 - t)(1.5 - 0.2 t) - 0.02 t.
    let exact = (1.72 - (1.72_f64 * 1.72 - 4.0 * 0.2 * 1.5).sqrt()) / 0.4;
    for method in [Method::ClosedForm, Method::RungeKutta8, Method::Gauss { stages: 2, step: 0.1 }] {
        let run = Simulation::new(&Planar::FREE, planar::start(-1.0))
            .until(2.0)
            .every(0.25)
            .method(method)
            .event(Event::determinant(0.0).falling().stop())
            .run()
            .unwrap();
        assert_eq!(run.stopped_by(), Some("det phi"), "{method:?}");
        assert!((run.end().0 - exact).abs() < TIME, "{method:?}: {} and {exact}", run.end().0);
        assert_eq!(run.times(), [0.0, 0.25, 0.5, 0.75, run.end().0]);
        assert!(run.end().1.phi().determinant().abs() < 1e-14);
    }
}

#[test]
fn several_in_one_step_come_in_order_and_between_outputs() {
    // phi11, phi22 = f with f = a cos t + b sin t, whose levels are met at known times.
    let level = |a: f64, b: f64, value: f64| (value / a.hypot(b)).acos() + b.atan2(a);
    let (first, second) = (level(1.5, -0.2, 1.3), level(1.0, 0.5, 1.05));
    let names = ["first", "second"];
    for method in METHODS {
        // The order of statement is not that of time.
        let run = swinging()
            .until(1.0)
            .method(method)
            .output([0.3, 0.4, 0.6, 1.0])
            .event(Event::new("second", |t, p: &Disc| phi(0, 0)(t, p) - 1.05).falling())
            .event(Event::new("first", |t, p: &Disc| phi(1, 1)(t, p) - 1.3))
            .run()
            .unwrap();
        let found: Vec<_> = run.events().iter().map(|event| event.name).collect();
        let mut expected = [(first, names[0]), (second, names[1])];
        expected.sort_by(|a, b| a.0.total_cmp(&b.0));
        assert_eq!(found, expected.map(|(_, name)| name));
        for (event, (t, _)) in run.events().iter().zip(expected) {
            assert!((event.t - t).abs() < TIME, "{method:?} {}: {} and {t}", event.name, event.t);
            assert!(!event.rising);
        }
        assert_eq!(run.times(), [0.3, 0.4, 0.6, 1.0], "outputs are where they were");
    }
}

/// Two levels on both sides of where phi11 and phi22 meet, crossed between the same samples.
#[test]
fn events_of_one_sample_come_in_the_order_of_the_run() {
    let level = |name, value: f64| {
        Event::new(name, move |_, point: &Disc| point.phi()[(0, 0)] - point.phi()[(1, 1)] - value)
    };
    let end = *swinging().until(1.2).run().unwrap().end().1;
    for method in METHODS {
        for stated in [["low", "high"], ["high", "low"]] {
            let [one, other] = stated.map(|name| level(name, if name == "low" { -1e-4 } else { 1e-4 }));
            let there = swinging().until(1.2).method(method).event(one).event(other).run().unwrap();
            let names = |run: &affine_runtime::Trajectory<2, Disc>| -> Vec<_> {
                run.events().iter().map(|event| (event.name, event.rising)).collect()
            };
            assert_eq!(names(&there), [("low", true), ("high", true)], "{method:?}");
            let [one, other] = stated.map(|name| level(name, if name == "low" { -1e-4 } else { 1e-4 }));
            let back = Simulation::new(&Planar::SPRING, end).from(1.2).until(0.0).tolerance(1e-15);
            let back = back.method(method).event(one).event(other).run().unwrap();
            assert_eq!(names(&back), [("high", false), ("low", false)], "{method:?}");
            for (there, back) in there.events().iter().zip(back.events().iter().rev()) {
                assert!((there.t - back.t).abs() < TIME, "{method:?}: {} and {}", there.t, back.t);
            }
        }
    }
}

/// A change that moves the point by a rounding, to the side from which the function has come.
#[test]
fn a_change_by_rounding_does_not_meet_itself() {
    for method in METHODS {
        for by in [-1e-15, -1e-16, 0.0, 1e-16, 1e-15] {
            let shift = move |_: f64, p: &Disc| {
                let mut phi = *p.phi();
                phi[(0, 0)] += by;
                Ok(point(phi, p.pi(), Pinned))
            };
            let run = swinging().until(1.2).method(method).event(meeting().change(shift)).run().unwrap();
            assert_eq!(run.events().len(), 1, "{method:?} {by:e}");
        }
    }
}

#[test]
fn directions_are_those_of_the_run() {
    let exact = (0.5_f64 / 0.7).atan();
    let forward = |event: Event<'static, 2, Disc>| swinging().until(1.2).event(event).run().unwrap();
    assert_eq!(forward(meeting()).events().len(), 1);
    let there = forward(meeting().rising());
    assert_eq!(there.events().len(), 1);
    assert!(there.events()[0].rising && (there.events()[0].t - exact).abs() < TIME);
    assert!(forward(meeting().falling()).events().is_empty());
    let (t, end) = there.end();
    let back = Simulation::new(&Planar::SPRING, *end)
        .from(t)
        .until(0.0)
        .tolerance(1e-15)
        .event(meeting().falling())
        .run()
        .unwrap();
    assert_eq!(back.events().len(), 1, "a run backward meets it falling");
    assert!((back.events()[0].t - exact).abs() < TIME);
    assert!((back.end().1.phi() - planar::start(0.5).phi()).norm() < 1e-13, "forward and back");
}

#[test]
fn a_stop_ends_the_run_at_the_event_alone() {
    for (stop, listed) in [
        (swinging().event(meeting().stop()), false),
        (swinging().output([0.1, 2.0]).event(meeting().stop()), true),
    ] {
        let run = stop.run().unwrap();
        let exact = (0.5_f64 / 0.7).atan();
        assert_eq!((run.stopped_by(), run.events().len()), (Some("meeting"), 1));
        assert!((run.end().0 - exact).abs() < TIME);
        assert_eq!(*run.times().last().unwrap() == run.end().0, !listed, "an output unless times are listed");
        assert!(run.checkpoint().is_some());
    }
    let past = swinging().until(0.5).event(meeting().stop()).run().unwrap();
    assert_eq!((past.stopped_by(), past.end().0), (None, 0.5), "the event comes later");
    assert!(past.checkpoint().is_none());
}

#[test]
fn a_changed_point_starts_anew() {
    // Where phi11 = phi22 all momenta are reversed: the body goes back the way it came.
    let exact = (0.5_f64 / 0.7).atan();
    let reverse = |_: f64, p: &Disc| Ok(point(*p.phi(), TwoPoint(-p.pi().0.0), Pinned));
    for method in METHODS {
        let run =
            swinging().until(2.0 * exact).method(method).event(meeting().change(reverse)).run().unwrap();
        assert_eq!(run.events().len(), 1, "the change does not meet itself: {method:?}");
        assert!((run.end().1.phi() - planar::start(0.5).phi()).norm() < 1e-12);
        assert!(run.times().windows(2).all(|w| w[0] <= w[1]));
    }
    // In closed form a wall at phi11 = 0.5 and one at phi11 = 1.25.
    let bounce = |_: f64, p: &Disc| {
        let mut momentum = p.pi().0.0;
        momentum[(0, 0)] = -momentum[(0, 0)];
        Ok(point(*p.phi(), TwoPoint(momentum), Pinned))
    };
    let run = Simulation::new(&Planar::FREE, planar::start(-1.0))
        .until(3.0)
        .event(Event::new("low", |_, p: &Disc| p.phi()[(0, 0)] - 0.5).change(bounce))
        .event(Event::new("high", |_, p: &Disc| p.phi()[(0, 0)] - 1.25).change(bounce))
        .run()
        .unwrap();
    let times: Vec<f64> = run.events().iter().map(|event| event.t).collect();
    assert_eq!(times.len(), 4);
    for (t, exact) in times.iter().zip([0.5, 1.25, 2.0, 2.75]) {
        assert!((t - exact).abs() < TIME, "{t} and {exact}");
    }
    let failing = swinging().event(meeting().change(|_, p| {
        Err(affine_runtime::Error::OffConstraint {
            constraint: affine_runtime::model::Constraint::Rigid,
            quantity: "phi",
            defect: p.phi().norm(),
            threshold: 0.0,
        })
    }));
    assert_eq!(failing.run().unwrap_err().stop.reason, Reason::Change { event: "meeting" });
}

#[test]
fn events_in_turns_without_end_reach_the_step_limit() {
    // The function rises through zero again right behind every event.
    let restless = Event::new("restless", |t: f64, _: &Disc| (1e9 * t).sin()).change(|_, p| Ok(*p));
    let halt = swinging().until(1.0).max_steps(50).event(restless).run().unwrap_err();
    assert_eq!(halt.stop.reason, Reason::StepLimit { limit: 50 });
}

#[test]
fn ready_made_events() {
    // Drawn apart with unit rates the placement is diag(1 + t/2, 1.5 - t/4).
    let start =
        point(Matrix::<2>::new(1.0, 0.0, 0.0, 1.5), TwoPoint(Matrix::<2>::new(0.5, 0.0, 0.0, -0.25)), Pinned);
    for method in [Method::ClosedForm, Method::RungeKutta8] {
        let run = Simulation::new(&Planar::FREE, start)
            .until(3.0)
            .method(method)
            .event(Event::smallest_stretch(1.125))
            .event(Event::largest_stretch(1.75).named("wide"))
            .event(Event::determinant(1.0 * 1.5 * 0.75))
            .run()
            .unwrap();
        let found: Vec<_> = run.events().iter().map(|event| (event.name, event.t)).collect();
        // det = (1 + t/2)(1.5 - t/4) = 1.125 at t = 2 + sqrt(7).
        let expected = [("smallest stretch", 0.25), ("wide", 1.5), ("smallest stretch", 1.5)];
        assert_eq!(found.len(), 3, "{found:?}");
        for ((name, t), (_, exact)) in found.iter().zip(expected) {
            assert!((t - exact).abs() < TIME, "{name} {t}");
        }
    }
    let run = Simulation::new(&DrunkMissile, drunk_missile::start())
        .until(1.0)
        .event(Event::position(3, 0.1))
        .run();
    let run = run.unwrap();
    assert_eq!(run.events().len(), 1);
    assert!((run.events()[0].point.x()[2] - 0.1).abs() < 1e-15);
    let start = drunk_missile::start();
    let thrown = Simulation::new(&DrunkMissile, start)
        .until(1.0)
        .event(Event::position(3, 0.1).change(|_, p: &drunk_missile::Missile| {
            let centre = Centre { x: p.x(), p: Vector::<3>::zeros() };
            Ok(point(*p.phi(), p.sigma_hat(), centre))
        }))
        .run()
        .unwrap();
    assert!(thrown.end().1.p().norm() == 0.0, "at rest from there on");
    let wrong =
        Simulation::new(&DrunkMissile, start).until(1.0).event(Event::position(4, 0.0)).run().unwrap_err();
    assert_eq!(wrong.stop.reason, Reason::Setting(Setting::EventIndex { event: "x", index: 4 }));
}

/// A name that has commas and quotation marks is one field.
#[test]
fn names_of_events_are_one_field() {
    for name in ["stretch, largest", "the \"first\" meeting", "two\nlines"] {
        let run = swinging().until(1.0).event(meeting().named(name)).run().unwrap();
        let mut written = Vec::new();
        run.events_csv(&mut written).unwrap();
        let mut read = csv::Reader::from_reader(written.as_slice());
        let columns = read.headers().unwrap().len();
        let rows: Vec<csv::StringRecord> = read.records().collect::<Result<_, _>>().unwrap();
        assert_eq!(rows.len(), 1);
        assert_eq!((&rows[0][0], rows[0].len()), (name, columns));
    }
}

#[test]
fn events_as_comma_separated_values() {
    let run = swinging().until(1.0).event(meeting()).run().unwrap();
    let mut written = Vec::new();
    run.events_csv(&mut written).unwrap();
    let text = String::from_utf8(written).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines.len(), 2);
    assert!(lines[0].starts_with("event,rising,t,phi11,phi12"));
    let t: f64 = lines[1].split(',').nth(2).unwrap().parse().unwrap();
    assert_eq!(t.to_bits(), run.events()[0].t.to_bits());
    assert!(lines[1].starts_with("meeting,true,"));
}
