//! An interrupted run that goes on is the run that was not interrupted, bit for bit.

use core::cell::Cell;
use core::ops::ControlFlow;

#[cfg(feature = "serde")]
use affine_integrators::FusedArithmetic;
use affine_runtime::__private::point;
use affine_runtime::Simulation;
use affine_runtime::frames::TwoPoint;
use affine_runtime::simulate::{Checkpoint, Event, Method, Reason, Setting};
use affine_runtime::state::{Phase, Pinned};

use crate::models::planar::{self, Disc, Planar};

type Run = affine_runtime::Trajectory<2, Disc>;

const METHODS: [Method; 2] = [Method::RungeKutta8, Method::Gauss { stages: 2, step: 0.05 }];

fn whole(method: Method) -> Simulation<'static, 2, Planar> {
    Simulation::new(&Planar::SPRING, planar::start(0.5)).until(1.25).tolerance(1e-9).method(method)
}

/// The same with an event that changes the point, and one that is only recorded.
fn eventful(simulation: Simulation<'static, 2, Planar>) -> Simulation<'static, 2, Planar> {
    let meeting = Event::new("meeting", |_, p: &Disc| p.phi()[(0, 0)] - p.phi()[(1, 1)]);
    simulation
        .event(meeting.change(|_, p| Ok(point(*p.phi(), TwoPoint(p.pi().0.0 * -0.5), Pinned))))
        .event(Event::new("level", |_, p: &Disc| p.phi()[(1, 1)] - 1.35))
}

fn assert_same(parts: &[Run], whole: &Run) {
    let times: Vec<u64> = parts.iter().flat_map(|run| run.times()).map(|t| t.to_bits()).collect();
    let expected: Vec<u64> = whole.times().iter().map(|t| t.to_bits()).collect();
    assert_eq!(times, expected);
    let points: Vec<Disc> = parts.iter().flat_map(|run| run.points().to_vec()).collect();
    assert!(points.iter().zip(whole.points()).all(|(a, b)| a == b));
    let events: Vec<_> = parts.iter().flat_map(|run| run.events().to_vec()).collect();
    assert_eq!(events, whole.events());
    let last = parts.last().unwrap();
    assert_eq!(last.end(), whole.end());
    assert_eq!(last.statistics().steps, whole.statistics().steps);
}

/// Runs on from checkpoint to checkpoint, each part interrupted by `interrupt`.
fn in_parts(
    simulation: impl Fn() -> Simulation<'static, 2, Planar>,
    interrupt: impl Fn(Simulation<'static, 2, Planar>) -> Simulation<'static, 2, Planar>,
) -> Vec<Run> {
    let mut parts: Vec<Run> = Vec::new();
    loop {
        let next = match parts.last() {
            None => simulation(),
            Some(last) => simulation().resume(last.checkpoint().unwrap()),
        };
        match interrupt(next).run() {
            Ok(run) => {
                parts.push(run);
                return parts;
            }
            Err(halt) => {
                assert!(matches!(halt.stop.reason, Reason::Interrupted(_)), "{halt}");
                parts.push(*halt.trajectory);
            }
        }
    }
}

/// Ends the run after so many calls.
fn after(calls: u32) -> impl FnMut() -> ControlFlow<()> {
    let left = Cell::new(calls);
    move || {
        left.set(left.get() - 1);
        if left.get() == 0 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

#[test]
fn interrupted_runs_go_on_with_the_same_bits() {
    type Outputs = fn(Simulation<'static, 2, Planar>) -> Simulation<'static, 2, Planar>;
    let outputs: [Outputs; 3] = [|s| s, |s| s.every(0.07), |s| s.output([0.0, 0.31, 0.32, 0.9])];
    for method in METHODS {
        for outputs in outputs {
            for events in [false, true] {
                let run = || {
                    let run = outputs(whole(method));
                    if events { eventful(run) } else { run }
                };
                let expected = run().run().unwrap();
                assert!(!events || expected.events().len() >= 2);
                let by_step = in_parts(run, |s| {
                    let mut next = after(1);
                    s.progress(move |_| next())
                });
                assert!(by_step.len() > 3, "{method:?}: {} parts", by_step.len());
                assert_same(&by_step, &expected);
                let by_output = in_parts(run, |s| {
                    let mut next = after(2);
                    s.observe(move |_, _| next())
                });
                assert!(by_output.len() > 2);
                assert_same(&by_output, &expected);
            }
        }
    }
}

#[test]
fn closed_forms_go_on_likewise() {
    let run = || {
        let gate = Event::new("gate", |_, p: &Disc| p.phi()[(0, 0)] - 0.7);
        let halt = Event::new("wall", |_, p: &Disc| p.phi()[(0, 0)] - 0.4);
        Simulation::new(&Planar::FREE, planar::start(-1.0))
            .until(1.3)
            .event(gate)
            .event(halt.change(|_, p| Ok(point(*p.phi(), TwoPoint(-p.pi().0.0), Pinned))))
    };
    let expected = run().run().unwrap();
    assert_eq!(expected.events().len(), 3);
    let parts = in_parts(run, |s| {
        let mut next = after(7);
        s.observe(move |_, _| next())
    });
    assert!(parts.len() > 10);
    assert_same(&parts, &expected);
}

#[test]
fn a_step_limit_and_a_stop_leave_a_checkpoint() {
    let expected = whole(Method::RungeKutta8).every(0.1).run().unwrap();
    let halt = whole(Method::RungeKutta8).every(0.1).max_steps(3).run().unwrap_err();
    assert_eq!(halt.stop.reason, Reason::StepLimit { limit: 3 });
    let checkpoint = halt.trajectory.checkpoint().unwrap().clone();
    let rest = whole(Method::RungeKutta8).every(0.1).resume(&checkpoint).run().unwrap();
    assert_same(&[*halt.trajectory, rest], &expected);

    let listed = || whole(Method::RungeKutta8).output([0.2, 0.6, 0.65, 1.0]);
    let event = || Event::new("meeting", |_, p: &Disc| p.phi()[(0, 0)] - p.phi()[(1, 1)]);
    let expected = listed().event(event()).run().unwrap();
    let stopped = listed().event(event().stop()).run().unwrap();
    assert_eq!(stopped.stopped_by(), Some("meeting"));
    let rest = listed().event(event().stop()).resume(stopped.checkpoint().unwrap()).run().unwrap();
    assert_eq!(rest.stopped_by(), None, "the same event is not met again");
    assert_same(&[stopped, rest], &expected);
}

#[test]
fn backward_in_time() {
    let run = || whole(Method::RungeKutta8).from(1.25).until(0.4).every(0.2);
    let expected = run().run().unwrap();
    let parts = in_parts(run, |s| {
        let mut next = after(2);
        s.observe(move |_, _| next())
    });
    assert_same(&parts, &expected);
}

#[test]
fn a_checkpoint_of_another_run_is_refused() {
    let halt = whole(Method::RungeKutta8).max_steps(2).run().unwrap_err();
    let checkpoint: &Checkpoint = halt.trajectory.checkpoint().unwrap();
    for other in [whole(METHODS[1]), whole(METHODS[0]).tolerance(1e-8), eventful(whole(METHODS[0]))] {
        let refused = other.resume(checkpoint).run().unwrap_err();
        assert_eq!(refused.stop.reason, Reason::Setting(Setting::Checkpoint { model: "Planar" }));
    }
}

#[test]
#[cfg(feature = "serde")]
fn checkpoints_are_written_and_read() {
    let halt = whole(Method::RungeKutta8).max_steps(2).run().unwrap_err();
    let checkpoint = halt.trajectory.checkpoint().unwrap();
    let text = serde_json::to_string(checkpoint).unwrap();
    let read: Checkpoint = serde_json::from_str(&text).unwrap();
    assert_eq!(&read, checkpoint);
}

/// Numbers are missing, or too many, or others: of none of it a run is made.
#[test]
#[cfg(feature = "serde")]
fn a_checkpoint_that_was_edited_is_refused() {
    use serde_json::{Value, json};
    let simulation = || eventful(whole(Method::RungeKutta8)).every(0.1);
    let halt = simulation().max_steps(2).run().unwrap_err();
    let written = serde_json::to_value(halt.trajectory.checkpoint().unwrap()).unwrap();
    let goes_on = |edited: &Value| {
        let checkpoint: Checkpoint = serde_json::from_value(edited.clone()).unwrap();
        simulation().resume(&checkpoint).run().map_err(|halt| halt.stop.reason)
    };
    assert!(goes_on(&written).is_ok());
    let others = |value: &Value| match value {
        Value::Array(list) if list.len() == 5 && list[0].is_u64() => vec![json!([u64::MAX, 0, 0, 0, 0])],
        Value::Array(list) => {
            let (shorter, longer) = (&list[..list.len() - 1], [list.as_slice(), &list[..1]].concat());
            vec![json!(shorter), json!(longer)]
        }
        Value::Bool(flag) => vec![json!(!flag)],
        number => vec![json!(number.as_u64().unwrap() ^ 1), json!(u64::MAX)],
    };
    for (name, value) in written["place"].as_object().unwrap() {
        for other in others(value) {
            let mut edited = written.clone();
            edited["place"][name] = other;
            let refused = Reason::Setting(Setting::Checkpoint { model: "Planar" });
            assert_eq!(goes_on(&edited).unwrap_err(), refused, "{name}");
        }
    }
}

#[test]
#[cfg(feature = "serde")]
fn a_run_that_goes_on_in_another_class_of_arithmetic_says_so() {
    let halt = whole(Method::RungeKutta8).max_steps(2).run().unwrap_err();
    let text = serde_json::to_string(halt.trajectory.checkpoint().unwrap()).unwrap();
    let fused = |place: FusedArithmetic| format!("\"fused\":\"{place:?}\"");
    let here = FusedArithmetic::here();
    let said = |text: &str| {
        let checkpoint: Checkpoint = serde_json::from_str(text).unwrap();
        whole(Method::RungeKutta8).resume(&checkpoint).run().unwrap().why().to_string()
    };
    assert!(text.contains(&fused(here)), "{text}");
    assert!(!said(&text).contains("another machine"));
    for there in [FusedArithmetic::Nowhere, FusedArithmetic::InVectors, FusedArithmetic::Everywhere] {
        let elsewhere = said(&text.replace(&fused(here), &fused(there)));
        let expected = format!("multiply-adds were fused {there} there, and are fused {here} here");
        assert_eq!(elsewhere.contains(&expected), there != here, "{elsewhere}");
    }
}
