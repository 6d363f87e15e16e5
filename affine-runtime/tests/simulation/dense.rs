//! What lies between the outputs of runs that do not go straight to their end.

use core::cell::Cell;
use core::ops::ControlFlow;

use affine_runtime::Simulation;
use affine_runtime::simulate::{Event, Method};
use affine_runtime::state::Phase;

use crate::models::planar::{self, Disc, Planar};

fn simulation() -> Simulation<'static, 2, Planar> {
    Simulation::new(&Planar::SPRING, planar::start(0.5))
        .until(1.25)
        .tolerance(1e-9)
        .method(Method::RungeKutta8)
}

fn distance(a: &Disc, b: &Disc) -> f64 {
    (a.phi() - b.phi()).norm() / b.phi().norm() + (a.pi().0.0 - b.pi().0.0).norm()
}

/// An interrupted run is dense as far as it came, and the rest from there on: together they are the whole.
#[test]
fn parts_of_an_interrupted_run() {
    let whole = simulation().dense().run().unwrap();
    let left = Cell::new(3);
    let interrupt = move |_: &_| {
        left.set(left.get() - 1);
        if left.get() == 0 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    };
    let halt = simulation().dense().progress(interrupt).run().unwrap_err();
    let first = *halt.trajectory;
    let second = simulation().dense().resume(first.checkpoint().unwrap()).run().unwrap();
    let between = first.end().0;
    assert!(between > 0.0 && between < 1.25);
    for k in 0..=100 {
        let t = 1.25 * f64::from(k) / 100.0;
        let part = if t <= between { &first } else { &second };
        assert_eq!(part.at(t).unwrap(), whole.at(t).unwrap(), "{t}");
    }
    assert!(first.at(between.next_up()).is_err() && second.at(between.next_down()).is_err());
    assert_eq!(first.at(between).unwrap(), second.at(between).unwrap());
}

/// A body that collapses within a step is where an output shows it up to the last good point.
#[test]
fn up_to_a_collapse() {
    let falling =
        || Simulation::new(&Planar::FREE, planar::start(-1.0)).until(3.0).method(Method::RungeKutta8);
    let halt = falling().dense().every(0.03).run().unwrap_err();
    let run = halt.trajectory;
    let (end, last) = run.end();
    assert!(end > 0.5 && end < 3.0, "{halt}", halt = halt.stop);
    assert_eq!(run.at(end).unwrap(), *last);
    assert!(run.at(end.next_up()).is_err());
    for (t, point) in run.iter() {
        assert!(distance(&run.at(t).unwrap(), point) < 1e-10, "{t}");
    }
}

/// An event at the very start that changes the point: the start is the one before.
#[test]
fn a_change_at_the_start() {
    let begun = || {
        let at_once = Event::new("at once", |t, _: &Disc| t).rising().change(|_, _| Ok(planar::start(0.25)));
        simulation().event(at_once)
    };
    let run = begun().dense().run().unwrap();
    assert_eq!(run.events().len(), 1);
    let outputs = begun().output([0.0, 0.3]).run().unwrap();
    assert_eq!(run.at(0.0).unwrap(), outputs.points()[0]);
    assert!(distance(&run.at(0.3).unwrap(), &outputs.points()[1]) < 1e-9);
}

/// What is evaluated to keep a step counts, also of one that an event ends: as many as outputs within every step take.
#[test]
fn what_it_costs_counts() {
    let ends = || simulation().event(Event::new("end", |t, _: &Disc| t - 0.9).stop());
    let plain = ends().output([]).run().unwrap().statistics();
    let dense = ends().dense().output([]).run().unwrap().statistics();
    assert_eq!(dense.steps, plain.steps);
    // The event has formed the dense output of the last step already.
    assert_eq!(dense.evaluations, plain.evaluations + 3 * (plain.steps - 1));
    let each = (0..=2000).map(|k| 1.25 * f64::from(k) / 2000.0);
    let outputs = simulation().output(each).run().unwrap().statistics();
    let dense = simulation().dense().output([]).run().unwrap().statistics();
    assert_eq!(dense, outputs, "what outputs within every step cost");
    // Each time within a step of collocation costs about a step: the step that an event ends is counted like the others.
    let step = 0.25;
    let gauss = |t: f64| {
        let end = Event::new("end", move |now, _: &Disc| now - t).stop();
        simulation().method(Method::Gauss { stages: 2, step }).event(end).output([])
    };
    let kept = |t: f64| {
        let plain = gauss(t).run().unwrap().statistics().evaluations;
        gauss(t).dense().run().unwrap().statistics().evaluations - plain
    };
    assert!(kept(0.2) > 0, "the only step is the one that the event ends");
}
