//! What stops a run, and what is left then.

use core::ops::ControlFlow;

use affine_runtime::__private::point;
use affine_runtime::frames::{Matrix, TwoPoint};
use affine_runtime::simulate::{Callback, Event, Method, Reason, Setting, Stop};
use affine_runtime::state::{Phase, Pinned};
use affine_runtime::{Error, Simulation};

use crate::models::drunk_missile::{self, DrunkMissile};
use crate::models::planar::{self, Disc, Planar};

type Free<'a> = Simulation<'a, 2, Planar>;

fn free(rate: f64) -> Free<'static> {
    Simulation::new(&Planar::FREE, planar::start(rate)).until(2.0)
}

#[test]
fn settings_that_make_no_sense() {
    type Change = fn(Free<'static>) -> Free<'static>;
    let cases: [(Change, Setting); 12] = [
        (|s| s.tolerance(0.0), Setting::Tolerance { given: 0.0 }),
        (|s| s.tolerance(-1e-6), Setting::Tolerance { given: -1e-6 }),
        (|s| s.tolerance(9e-16), Setting::Tolerance { given: 9e-16 }),
        (|s| s.tolerance(1.0), Setting::Tolerance { given: 1.0 }),
        (|s| s.tolerance(f64::INFINITY), Setting::Tolerance { given: f64::INFINITY }),
        (|s| s.until(f64::INFINITY), Setting::Time { name: "the time of the end", given: f64::INFINITY }),
        (
            |s| s.from(f64::NEG_INFINITY),
            Setting::Time { name: "the time of the start", given: f64::NEG_INFINITY },
        ),
        (|s| s.max_steps(0), Setting::NoSteps),
        (|s| s.every(0.0), Setting::OutputSpacing { dt: 0.0, t0: 0.0, t_end: 2.0 }),
        (|s| s.output([1.0, 3.0]), Setting::OutputOutside { index: 1, t: 3.0, t0: 0.0, t_end: 2.0 }),
        (|s| s.output([1.0, 0.5]), Setting::OutputOrder { index: 1, t: 0.5, before: 1.0 }),
        (|s| s.from(2.5).output([1.0]), Setting::OutputOutside { index: 0, t: 1.0, t0: 2.5, t_end: 2.0 }),
    ];
    for (change, setting) in cases {
        let halt = change(free(0.5)).run().unwrap_err();
        assert_eq!(halt.stop.reason, Reason::Setting(setting));
        assert!(halt.trajectory.is_empty());
        assert_eq!(halt.to_string(), setting.to_string());
    }
    let halt = Simulation::new(&Planar::FREE, planar::start(0.5)).run().unwrap_err();
    assert_eq!(halt.stop.reason, Reason::Setting(Setting::NoEnd));
    for nan in [free(0.5).tolerance(f64::NAN), free(0.5).until(f64::NAN), free(0.5).output([f64::NAN])] {
        assert!(matches!(
            nan.run().unwrap_err().stop.reason,
            Reason::Setting(Setting::Tolerance { given } | Setting::Time { given, .. }) if given.is_nan()
        ));
    }
    assert!(free(0.5).tolerance(1e-15).run().is_ok(), "the finest tolerance");
}

#[test]
fn closed_form_where_there_is_none() {
    let halt = Simulation::new(&Planar::SPRING, planar::start(0.5))
        .until(1.0)
        .method(Method::ClosedForm)
        .run()
        .unwrap_err();
    assert_eq!(halt.stop.reason, Reason::Setting(Setting::NoClosedForm { model: "Planar" }));
    assert!(halt.to_string().contains("Method::Automatic"));
}

#[test]
fn collapse_keeps_what_came_before() {
    // phi11 = 1 - t, phi12 = 0.2, phi21 = 0.1 t, phi22 = 1.5 - 0.2 t: 1.5 - 1.72 t + 0.2 t^2 = 0.
    let exact = (1.72 - (1.72_f64 * 1.72 - 4.0 * 0.2 * 1.5).sqrt()) / 0.4;
    for method in [Method::ClosedForm, Method::RungeKutta8] {
        let halt = free(-1.0).every(0.25).method(method).run().unwrap_err();
        let Reason::Placement { determinant, t, .. } = halt.stop.reason else { panic!("{halt}") };
        assert!(determinant < 0.0 && (t - exact).abs() < 1e-6, "{halt}");
        assert_eq!(halt.trajectory.times(), [0.0, 0.25, 0.5, 0.75]);
        assert_eq!((halt.stop.t, halt.trajectory.end().0), (0.75, 0.75), "the last good point");
        assert!(halt.trajectory.points().iter().all(|p| p.phi().determinant() > 0.0));
        assert!(halt.to_string().contains("det phi = -"), "{halt}");
    }
}

#[test]
fn collapse_between_outputs_is_seen_at_the_steps() {
    // det phi = (cos t - sin t)(1.5 cos t - 0.2 sin t) + ..., negative from about 0.8 to 1.4 and positive at 2.
    let start = planar::start(-1.0);
    let simulation = || Simulation::new(&Planar::SPRING, start).tolerance(1e-12);
    let halt = simulation().until(2.0).output([2.0]).run().unwrap_err();
    let Reason::Placement { determinant, t, .. } = halt.stop.reason else { panic!("{halt}") };
    assert!(determinant < 0.0 && (0.75..1.5).contains(&t), "{halt}");
    assert!(halt.trajectory.is_empty() && halt.stop.t > 0.0 && halt.stop.t < t);
    assert!(halt.trajectory.end().1.phi().determinant() > 0.0);
}

/// A spring that turns the body without deforming it, `phi = [cos t, -sin t; sin t, cos t]`.
fn turning() -> Disc {
    point(Matrix::<2>::identity(), TwoPoint(Matrix::<2>::new(0.0, 1.0, -1.0, 0.0)), Pinned)
}

/// Steps without output are looked at all the same, whatever the momentum is.
#[test]
fn collapse_at_a_step_without_output() {
    // det phi = (cos t - sin t)(1.5 cos t - 0.2 sin t) + ..., negative from 0.79 to 1.48 and from 3.9 to 4.6.
    let run = |until: f64, every: bool| {
        let simulation =
            Simulation::new(&Planar::OTHERWISE, planar::start(-1.0)).until(until).tolerance(1e-12);
        if every { simulation.run() } else { simulation.output([until]).run() }
    };
    let (seen, unseen) = (run(2.0, true).unwrap_err(), run(2.0, false).unwrap_err());
    let Reason::Placement { determinant, t, .. } = unseen.stop.reason else { panic!("{unseen}") };
    assert!(determinant < 0.0 && (0.7..1.0).contains(&t), "{unseen}");
    assert_eq!(unseen.stop, seen.stop, "as with an output at every step");
    assert!(unseen.trajectory.is_empty() && unseen.trajectory.end() == seen.trajectory.end());
    assert!(unseen.trajectory.end().1.phi().determinant() > 0.0);
    // The end of the run itself.
    let last = run(1.0, false).unwrap_err();
    assert!(matches!(last.stop.reason, Reason::Placement { t: at, .. } if (at - t).abs() < 1e-9), "{last}");
}

/// Backward in time too the end is the last good step, an output or not.
#[test]
fn the_end_of_a_halted_run_is_its_last_step() {
    for sign in [1.0, -1.0] {
        let start = planar::start(-sign);
        let simulation = || Simulation::new(&Planar::OTHERWISE, start).until(2.0 * sign).tolerance(1e-12);
        let every = simulation().run().unwrap_err();
        for output in [vec![], vec![0.3 * sign]] {
            let halt = simulation().output(output.clone()).run().unwrap_err();
            assert_eq!(halt.trajectory.times(), output);
            assert_eq!(halt.trajectory.end(), every.trajectory.end());
            assert_eq!(halt.stop, every.stop);
        }
        let last = every.trajectory.times().last().copied();
        assert_eq!((last, every.stop.t.signum()), (Some(every.stop.t), sign));
    }
}

/// What happens in a step after the orientation is lost does not.
#[test]
fn nothing_happens_after_a_collapse() {
    let exact = {
        // The exact motion is phi(0) cos t + phi_dot(0) sin t.
        let determinant = |t: f64| {
            let (c, s) = (t.cos(), t.sin());
            (c - s) * (1.5 * c - 0.2 * s) - 0.2 * c * 0.1 * s
        };
        let (mut good, mut bad) = (0.5, 1.0);
        while bad - good > 1e-15 {
            let middle = 0.5 * (good + bad);
            *(if determinant(middle) > 0.0 { &mut good } else { &mut bad }) = middle;
        }
        bad
    };
    let at = |name, t0: f64| Event::new(name, move |t, _: &Disc| t - t0);
    let steps = [(Method::Gauss { stages: 6, step: 1.0 }, 1e-9), (Method::RungeKutta8, 1e-2)];
    for (method, right) in steps {
        let halt = Simulation::new(&Planar::SPRING, planar::start(-1.0))
            .until(4.0)
            .tolerance(1e-3)
            .method(method)
            .event(at("before", exact - 0.03))
            .event(at("after", exact + 0.03))
            .run()
            .unwrap_err();
        let Reason::Placement { t, .. } = halt.stop.reason else { panic!("{method:?}: {halt}") };
        assert!((t - exact).abs() < right, "{method:?}: {t} and {exact}");
        let names: Vec<&str> = halt.trajectory.events().iter().map(|event| event.name).collect();
        assert_eq!(names, ["before"], "{method:?}");
    }
}

/// A mass matrix that changes its signature ends the run with the step, and one that degenerates where no step leads on.
#[test]
fn degenerate_mass_matrices() {
    let model = Planar { is_weighed: true, ..Planar::SPRING };
    let quarter = core::f64::consts::FRAC_PI_2;
    for method in [Method::RungeKutta8, Method::Gauss { stages: 3, step: 0.1 }] {
        let halt =
            Simulation::new(&model, turning()).until(4.0).tolerance(1e-10).method(method).run().unwrap_err();
        let Reason::Degenerate { weakest, t } = halt.stop.reason else { panic!("{method:?}: {halt}") };
        assert!(halt.stop.t < quarter && t > quarter && t - halt.stop.t < 1.0, "{method:?}: {halt}");
        assert!((weakest - t.cos().abs()).abs() < 1e-6, "{method:?}: {weakest} at {t}");
        let whole = Simulation::new(&Planar::SPRING, turning()).until(4.0).tolerance(1e-10).method(method);
        assert_eq!(whole.run().unwrap().end().0, 4.0);
    }
    // phi22 = 1 - (1 - d) t is d where the force is infinite.
    let singular = Planar::<true> { spring: 0.0, singular_at: Some(1.0), is_weighed: true };
    for (pivot, is_named) in [(1e-6, true), (1e-3, false)] {
        let momentum = TwoPoint(Matrix::<2>::new(0.0, 0.0, 0.0, pivot - 1.0));
        let start = point(Matrix::<2>::identity(), momentum, Pinned);
        let halt = Simulation::new(&singular, start).until(2.0).run().unwrap_err();
        match halt.stop.reason {
            Reason::Degenerate { weakest, t } => {
                assert!(is_named && (weakest - pivot).abs() < 1e-9 && (t - 1.0).abs() < 1e-9, "{halt}");
            }
            reason => assert!(!is_named && matches!(reason, Reason::StepUnderflow { .. }), "{halt}"),
        }
    }
}

#[test]
fn singular_force_stops_with_the_step() {
    // Pi_11 = 1/(1 - t) - 1 + Pi_11(0): no step passes t = 1.
    let model = Planar::<true> { spring: 0.0, singular_at: Some(1.0), is_weighed: false };
    let halt = Simulation::new(&model, planar::start(0.5)).until(2.0).tolerance(1e-10).run().unwrap_err();
    assert_eq!(halt.stop.reason, Reason::StepUnderflow { tolerance: 1e-10 });
    let (t, end) = halt.trajectory.end();
    assert!(t < 1.0 && 1.0 - t < 1e-10, "{t}");
    assert_eq!(halt.stop.t, t);
    assert_eq!(halt.stop.steps, halt.trajectory.statistics().steps);
    assert_eq!(halt.trajectory.len() as u64, halt.stop.steps + 1);
    assert!(end.is_finite());
    // What was computed before is right: at the last output before t = 0.9.
    let (t, point) = halt.trajectory.iter().rev().find(|(t, _)| *t < 0.9).unwrap();
    let exact = 0.5 + 1.0 / (1.0 - t) - 1.0;
    assert!((point.pi().0.0[(0, 0)] / exact - 1.0).abs() < 1e-8);
}

#[test]
fn starts_that_are_no_phase_points() {
    let start = |phi: Matrix<2>| -> Disc { point(phi, TwoPoint(Matrix::<2>::zeros()), Pinned) };
    let reason = |phi| {
        let model = Planar::SPRING;
        let halt = Simulation::new(&model, start(phi)).from(1.0).until(2.0).run().unwrap_err();
        assert!(halt.trajectory.is_empty());
        assert_eq!(halt.stop.steps, 0);
        halt.stop.reason
    };
    assert_eq!(reason(Matrix::<2>::new(f64::NAN, 0.0, 0.0, 1.0)), Reason::NotFinite);
    assert_eq!(
        reason(Matrix::<2>::new(-1.0, 0.0, 0.0, 1.0)),
        Reason::Placement { determinant: -1.0, rate: None, t: 1.0 }
    );
    assert_eq!(
        reason(Matrix::<2>::new(1.0, 2.0, 2.0, 4.0)),
        Reason::Placement { determinant: 0.0, rate: None, t: 1.0 }
    );
    // A determinant far below the square of the norm, and positive.
    let thin = start(Matrix::<2>::new(1.0, 0.0, 0.0, 1e-14));
    assert!(Simulation::new(&Planar::SPRING, thin).until(1e-9).run().is_ok());
}

#[test]
fn overflow_is_not_finite() {
    // The force at the start is infinite.
    let model = Planar::<true> { spring: 0.0, singular_at: Some(0.0), is_weighed: false };
    let halt = Simulation::new(&model, planar::start(0.5)).until(1.0).run().unwrap_err();
    assert_eq!(halt.stop.reason, Reason::NotFinite);
    assert_eq!(halt.trajectory.times(), [0.0], "the start is good");
}

/// Doubles near 1e17 are 16 apart: that is said, not that the model is to blame.
#[test]
fn times_that_are_far_apart() {
    for method in [Method::RungeKutta8, Method::RungeKutta5, Method::Radau { stages: None }] {
        for from in [1e17, -1e17, 1e20] {
            let run = Simulation::new(&Planar::SPRING, planar::start(0.5))
                .from(from)
                .until(from + 1e3 * from.abs() * 2e-16);
            let halt = run.method(method).run().unwrap_err();
            assert!(matches!(halt.stop.reason, Reason::StepUnderflow { .. }), "{method:?} {from:e}: {halt}");
            assert!(halt.to_string().contains("further apart than steps"), "{halt}");
        }
    }
}

#[test]
fn step_limit_keeps_the_trajectory() {
    let halt = Simulation::new(&DrunkMissile, drunk_missile::start())
        .until(10.0)
        .tolerance(1e-12)
        .max_steps(7)
        .run()
        .unwrap_err();
    assert_eq!(halt.stop.reason, Reason::StepLimit { limit: 7 });
    assert_eq!((halt.stop.steps, halt.trajectory.len()), (7, 8));
    let whole = Simulation::new(&DrunkMissile, drunk_missile::start()).until(10.0).tolerance(1e-12).run();
    let whole = whole.unwrap();
    assert_eq!(halt.trajectory.points(), &whole.points()[..8], "the same steps");
    let sparse = Simulation::new(&DrunkMissile, drunk_missile::start()).until(10.0).output([10.0]);
    let sparse = sparse.tolerance(1e-12).max_steps(7).run().unwrap_err();
    assert!(sparse.trajectory.is_empty());
    assert_eq!(sparse.trajectory.end(), (whole.times()[7], &whole.points()[7]), "the last good point");
    assert_eq!(sparse.stop.t, whole.times()[7]);
    assert!(halt.to_string().contains("max_steps"), "{halt}");
}

#[test]
fn callbacks_break() {
    let halt = free(0.5)
        .every(0.25)
        .observe(|t, _| if t < 1.0 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) })
        .run()
        .unwrap_err();
    assert_eq!(halt.stop, Stop { reason: Reason::Interrupted(Callback::Observer), t: 1.0, steps: 0 });
    assert_eq!(halt.trajectory.times(), [0.0, 0.25, 0.5, 0.75, 1.0], "the output it broke on is kept");
    let halt = free(0.5)
        .method(Method::RungeKutta8)
        .progress(|p| if p.steps < 2 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) })
        .run()
        .unwrap_err();
    assert_eq!((halt.stop.reason, halt.stop.steps), (Reason::Interrupted(Callback::Progress), 2));
    assert_eq!(halt.trajectory.len(), 3);
}

#[test]
fn question_mark_gives_the_crates_error() {
    fn main() -> affine_runtime::Result<()> {
        let run = Simulation::new(&DrunkMissile, drunk_missile::start()).until(10.0).max_steps(3).run()?;
        panic!("three steps reached {}", run.end().0)
    }
    let Err(Error::Stopped(stop)) = main() else { panic!("another error") };
    assert_eq!((stop.reason, stop.steps), (Reason::StepLimit { limit: 3 }, 3));
    assert!(main().unwrap_err().to_string().starts_with("stopped at t = "));
    fn boxed() -> Result<(), Box<dyn std::error::Error>> {
        Simulation::new(&DrunkMissile, drunk_missile::start()).until(10.0).max_steps(3).run()?;
        Ok(())
    }
    assert_eq!(boxed().unwrap_err().to_string(), main().unwrap_err().to_string());
}

/// What `main() -> Result` prints of a run of ten thousand outputs is one sentence, and the trajectory beside it a line or two.
#[test]
fn what_is_printed_of_a_failure_is_read() {
    let outputs = (0..10_000).map(|k| f64::from(k) * 1e-4);
    let collapsing = Simulation::new(&Planar::FREE, planar::start(-2.0)).until(1.0).output(outputs);
    let halt = collapsing.run().unwrap_err();
    assert!(halt.trajectory.times().len() > 4000, "{}", halt.trajectory.times().len());
    assert!(halt.to_string().starts_with("stopped at t = "), "{halt}");
    let shown = [format!("{halt:?}"), format!("{:?}", halt.stop), format!("{:?}", halt.stop.reason)];
    let read = [halt.to_string(), halt.stop.to_string(), halt.stop.reason.to_string()];
    assert_eq!(shown, read);
    assert!(read.iter().all(|text| text.len() < 500), "{read:?}");
    let trajectory = format!("{:?}", halt.trajectory);
    assert!(trajectory.len() < 2000, "{} letters", trajectory.len());
    let error = affine_runtime::Error::from(halt);
    assert_eq!(format!("{error:?}"), error.to_string());
}
