//! When a trajectory is recorded, and what callbacks see.

use core::ops::ControlFlow;
use std::cell::RefCell;

use affine_runtime::Simulation;
use affine_runtime::simulate::{Event, Method};
use affine_runtime::state::Phase;

use crate::models::drunk_missile::{self, DrunkMissile, Missile};
use crate::models::planar::{self, Planar};

fn simulation() -> Simulation<'static, 3, DrunkMissile> {
    Simulation::new(&DrunkMissile, drunk_missile::start()).until(2.0).tolerance(1e-12)
}

#[test]
fn every_accepted_step_by_default() {
    let run = simulation().run().unwrap();
    assert_eq!(run.len() as u64, run.statistics().steps + 1, "the start and every step");
    assert_eq!((run.times()[0], run.times()[run.len() - 1]), (0.0, 2.0));
    assert!(run.times().windows(2).all(|w| w[0] < w[1]));
    assert_eq!(run.points()[0], drunk_missile::start(), "the start itself, not what became of it");
}

#[test]
fn a_closed_form_has_101_times_by_default() {
    let run = Simulation::new(&Planar::FREE, planar::start(0.5)).until(2.0).run().unwrap();
    assert_eq!(run.len(), 101);
    assert_eq!((run.times()[0], run.times()[50], run.times()[100]), (0.0, 1.0, 2.0));
}

#[test]
fn equidistant_times_and_the_end() {
    let run = simulation().every(0.7).run().unwrap();
    assert_eq!(run.times(), [0.0, 0.7, 1.4, 2.0]);
    // The dense output is as good as a run that ends there, up to what its lower order costs.
    for (t, point) in run.iter().skip(1) {
        let direct = Simulation::new(&DrunkMissile, drunk_missile::start()).until(t).tolerance(1e-13).run();
        let direct = *direct.unwrap().end().1;
        assert!((point.phi() - direct.phi()).norm() < 2e-11, "t = {t}");
        assert!((point.p() - direct.p()).norm() < 2e-11, "t = {t}");
    }
}

#[test]
fn outputs_do_not_disturb_the_steps() {
    let plain = simulation().run().unwrap().statistics();
    let times: Vec<f64> = (0..=1000).map(|k| f64::from(k) * 0.002).collect();
    let run = simulation().output(times.clone()).run().unwrap();
    let dense = run.statistics();
    assert_eq!(run.times(), times);
    assert_eq!((dense.steps, dense.rejected), (plain.steps, plain.rejected));
    assert_eq!(dense.evaluations, plain.evaluations + 3 * plain.steps, "three more in every step");
    assert_eq!(run.points()[1000], *simulation().run().unwrap().end().1, "the end is the last step's");
}

#[test]
fn only_the_times_asked_for() {
    let run = simulation().output([0.5, 0.500_000_1, 1.25]).run().unwrap();
    assert_eq!(run.times(), [0.5, 0.500_000_1, 1.25]);
    assert_eq!(run.end().0, 2.0, "the run goes on to its end");
    assert_eq!((run.start().0, *run.start().1), (0.0, drunk_missile::start()));
    let none = simulation().output([]).run().unwrap();
    assert!(none.is_empty() && none.end().0 == 2.0);
    let one = simulation().output([2.0]).run().unwrap();
    assert_eq!(one.statistics(), simulation().run().unwrap().statistics(), "the end needs no dense output");
    assert_eq!((one.times(), one.points()[0]), (&[2.0][..], *one.end().1));
}

/// Backward in time, the start is an output only where it was asked for, also where an event starts the motion again.
#[test]
fn only_the_times_asked_for_backward() {
    let backward = || simulation().until(-2.0);
    let run = backward().output([-0.5, -1.25]).run().unwrap();
    assert_eq!(run.times(), [-0.5, -1.25]);
    for (t, point) in run.iter() {
        let direct = *simulation().until(t).run().unwrap().end().1;
        assert!((point.phi() - direct.phi()).norm() < 2e-11, "t = {t}");
    }
    let run = backward().output([0.0, -2.0]).run().unwrap();
    assert_eq!((run.times(), run.points()[0]), (&[0.0, -2.0][..], drunk_missile::start()));
    let again = Event::new("again", |t, _: &Missile| t + 1.2).change(|_, point| Ok(*point));
    let run = backward().every(0.5).event(again).run().unwrap();
    assert_eq!(run.times(), [0.0, -0.5, -1.0, -1.5, -2.0]);
    assert_eq!(run.events().len(), 1);
}

#[test]
fn an_empty_interval_is_the_start() {
    for method in [Method::Automatic, Method::RungeKutta8] {
        let at = || Simulation::new(&Planar::FREE, planar::start(0.5)).from(3.0).until(3.0).method(method);
        for run in [at().run(), at().every(0.1).run(), at().output([3.0]).run()] {
            let run = run.unwrap();
            assert_eq!((run.times(), run.points()), (&[3.0][..], &[planar::start(0.5)][..]));
            assert_eq!(run.statistics().steps, 0);
        }
    }
}

#[test]
fn observer_sees_every_output_once() {
    for method in [Method::ClosedForm, Method::RungeKutta8] {
        let seen = RefCell::new(Vec::new());
        let run = Simulation::new(&Planar::FREE, planar::start(0.5))
            .until(1.0)
            .every(0.125)
            .method(method)
            .observe(|t, point| {
                seen.borrow_mut().push((t, *point));
                ControlFlow::Continue(())
            })
            .run()
            .unwrap();
        let recorded: Vec<_> = run.iter().map(|(t, point)| (t, *point)).collect();
        assert_eq!(*seen.borrow(), recorded);
        assert_eq!(recorded.len(), 9);
    }
}

#[test]
fn progress_rises_to_one() {
    let mut fractions = Vec::new();
    let run = Simulation::new(&DrunkMissile, drunk_missile::start())
        .from(1.0)
        .until(-1.0)
        .progress(|progress| {
            fractions.push((progress.fraction(), progress.steps));
            ControlFlow::Continue(())
        })
        .run()
        .unwrap();
    assert_eq!(fractions.len() as u64, run.statistics().steps);
    assert!(fractions.windows(2).all(|w| w[0].0 < w[1].0 && w[0].1 + 1 == w[1].1));
    assert_eq!(fractions[fractions.len() - 1], (1.0, run.statistics().steps));
}
