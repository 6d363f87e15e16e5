//! What is looked at on the way of each body: outputs, events, folds.

use std::sync::atomic::{AtomicU64, Ordering};

use affine_runtime::lanes::{F64x8, Lanes};
use affine_runtime::prelude::*;
use affine_runtime::simulate::{Reason, Setting};

use crate::models::{Elastic, Sampled, Top, Unprotected, vibrating};

const BODIES: usize = 2 * <F64x8 as Lanes>::LANES + 5;

type Point = <Elastic as Model<3>>::Point<f64>;

/// Events of a body that expands and contracts: recorded, or the end.
fn events<'a>() -> Vec<Event<'a, 3, Point>> {
    vec![Event::determinant(1.0), Event::new("level", |_, point: &Point| point.phi()[(0, 0)] - 1.1).rising()]
}

fn alone(start: Point, t_end: f64) -> Simulation<'static, 3, Elastic> {
    Simulation::new(&Elastic, start).until(t_end).tolerance(1e-9).method(Method::RungeKutta8)
}

/// To the bit: outputs, events with their points, and ends, in both directions of time.
#[test]
fn outputs_and_events_are_those_of_each_body_alone() {
    let starts = Elastic.samples(BODIES, 51);
    for t_end in [3.0, -2.0] {
        let mut seen = 0;
        Ensemble::new(&Elastic, starts.clone())
            .until(t_end)
            .tolerance(1e-9)
            .every(0.3)
            .events(events)
            .each(|body| {
                let start = starts[body.number as usize];
                let run = events()
                    .into_iter()
                    .fold(alone(start, t_end).every(0.3), Simulation::event)
                    .run()
                    .unwrap();
                let outputs: Vec<_> = run.iter().map(|(t, point)| (t, *point)).collect();
                assert_eq!(body.folded, outputs, "body {}", body.number);
                assert_eq!(body.events, run.events(), "body {}", body.number);
                assert_eq!(body.end.unwrap(), *run.end().1);
                seen += body.events.len();
            })
            .unwrap();
        assert!(seen > BODIES, "{seen} events");
    }
}

#[test]
fn outputs_do_not_change_ends() {
    let starts = Elastic.samples(BODIES, 52);
    let ensemble = || Ensemble::new(&Elastic, starts.clone()).until(2.0).tolerance(1e-9);
    let plain = ensemble().run().unwrap();
    let mut with = Vec::new();
    ensemble().every(0.05).each(|body| with.push(body.end)).unwrap();
    assert_eq!(plain, with);
}

/// First passages: the event is the end of the body.
#[test]
fn an_event_ends_a_body_and_no_other() {
    let starts = Elastic.samples(BODIES, 53);
    let stop = || vec![Event::new("level", |_, point: &Point| point.phi()[(0, 0)] - 1.15).rising().stop()];
    let (mut passed, mut not) = (0, 0);
    Ensemble::new(&Elastic, starts.clone())
        .until(1.0)
        .tolerance(1e-9)
        .every(0.1)
        .events(stop)
        .each(|body| {
            let start = starts[body.number as usize];
            let run = stop().into_iter().fold(alone(start, 1.0).every(0.1), Simulation::event).run().unwrap();
            let outputs: Vec<_> = run.iter().map(|(t, point)| (t, *point)).collect();
            assert_eq!((&body.folded, &body.events[..]), (&outputs, run.events()));
            assert_eq!(body.end.unwrap(), *run.end().1);
            let count = if run.stopped_by().is_some() { &mut passed } else { &mut not };
            *count += 1;
        })
        .unwrap();
    assert!(passed > 2 && not > 2, "{passed} and {not}");
}

/// Events that change the point, and bodies that collapse: they leave their lanes, and what was folded of them begins anew.
#[test]
fn bodies_that_leave_their_lanes_are_folded_once() {
    type Planar = <Unprotected as Model<2>>::Point<f64>;
    let mut starts = Unprotected.samples(BODIES, 54);
    for place in [1, 9] {
        let collapsing = TwoPoint(Matrix::<2>::new(-5.0, 0.0, 0.0, 0.1));
        let (zero, one) = (Vector::<2>::zeros(), Matrix::<2>::identity());
        starts[place] = Unprotected.at_momentum(zero, one, zero, collapsing).unwrap();
    }
    let turn = |_: f64, point: &Planar| {
        Unprotected.at_momentum(point.x(), *point.phi(), -point.p(), TwoPoint(point.pi().0.0))
    };
    let turns = || vec![Event::position(2, 0.22).rising().change(turn)];
    let (mut stopped, mut turned) = (0, 0);
    Ensemble::new(&Unprotected, starts.clone())
        .until(0.6)
        .tolerance(1e-10)
        .every(0.1)
        .events(turns)
        .fold(
            |_, _| 0.0,
            |sum: &mut f64, t, point| *sum += t * point.phi().norm(),
            |body| {
                let start = starts[body.number as usize];
                let alone = Simulation::new(&Unprotected, start).until(0.6).tolerance(1e-10).every(0.1);
                let alone = alone.method(Method::RungeKutta8).event(turns().remove(0)).run();
                let (end, run) = match alone {
                    Ok(run) => (Ok(*run.end().1), run),
                    Err(halt) => (Err(halt.stop), *halt.trajectory),
                };
                let sum = run.iter().fold(0.0, |sum, (t, point)| sum + t * point.phi().norm());
                assert_eq!((body.folded, &body.events[..]), (sum, run.events()));
                turned += run.events().len();
                stopped += usize::from(end.is_err());
                assert_eq!(body.end, end);
            },
        )
        .unwrap();
    assert_eq!(stopped, 2, "errors stay with their bodies");
    assert!(turned > 3, "{turned}");
}

/// Bodies that are not taken into lanes have outputs and events too.
#[test]
fn bodies_apart_are_seen_too() {
    let spin = |s: f64| Matrix::<3>::new(0.0, -2.0 * s, 0.1, 2.0 * s, 0.0, -0.3, -0.1, 0.3, 0.0);
    let starts = [1.0, 1.3, 0.2].map(|s| Top.at_velocity(Matrix::<3>::identity(), spin(s)).unwrap());
    let mut bodies = Vec::new();
    Ensemble::new(&Top, starts).until(1.0).tolerance(1e-9).every(0.5).each(|body| bodies.push(body)).unwrap();
    for (start, body) in starts.iter().zip(bodies) {
        let run = Simulation::new(&Top, *start).until(1.0).tolerance(1e-9).every(0.5).run().unwrap();
        assert_eq!(body.folded, run.iter().map(|(t, point)| (t, *point)).collect::<Vec<_>>());
    }
}

#[test]
fn progress_is_told_of_every_body() {
    let model = vibrating();
    let (calls, last) = (AtomicU64::new(0), AtomicU64::new(0));
    let told = |done: u64| {
        calls.fetch_add(1, Ordering::Relaxed);
        last.fetch_max(done, Ordering::Relaxed);
    };
    let ends = Ensemble::new(&model, model.samples(30, 8)).until(0.2).progress(told).run().unwrap();
    assert_eq!((ends.len(), calls.into_inner(), last.into_inner()), (30, 30, 30));
}

#[test]
fn settings_are_looked_at_first() {
    let ensemble = || Ensemble::new(&Elastic, Elastic.samples(1, 2)).until(1.0);
    let refused = |ensemble: Ensemble<'static, 3, &'static Elastic>| ensemble.each(|_| ()).unwrap_err();
    assert!(matches!(refused(ensemble().every(-1.0)), Setting::OutputSpacing { .. }));
    assert!(matches!(refused(ensemble().output([2.0])), Setting::OutputOutside { .. }));
    assert!(matches!(
        refused(ensemble().events(|| vec![Event::position(7, 0.0)])),
        Setting::EventIndex { .. }
    ));
    assert_eq!(refused(ensemble().shard(2, 2)), Setting::Shard { k: 2, of: 2 });
    assert_eq!(refused(ensemble().shard(0, 0)), Setting::Shard { k: 0, of: 0 });
    // Whatever is chosen of it.
    assert_eq!(refused(ensemble().shard(5, 2).shard(0, 1)), Setting::Shard { k: 5, of: 2 });
    let nan = || {
        vec![Event::new("nan", |t, point: &Point| if t > 0.3 { f64::NAN } else { point.phi()[(0, 0)] + 9.0 })]
    };
    let mut ends = Vec::new();
    ensemble().events(nan).each(|body| ends.push(body.end)).unwrap();
    assert!(matches!(ends[0].as_ref().unwrap_err().reason, Reason::Event { event: "nan", .. }));
}
