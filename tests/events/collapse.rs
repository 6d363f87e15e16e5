//! Bodies that collapse where an output is due, and one that only seems to.

use affine_runtime::prelude::*;
use affine_runtime::simulate::{Reason, Stop};

use crate::models::{Ball, FALLING, GRAVITY, Point, ball};

/// Its placement follows a straight line.
#[affine_model(dim = 2, kinetic(dalembert = 1), emit(lanes))]
struct Free;

/// Its shear grows without bound; `det phi` oscillates.
#[affine_model(dim = 2, kinetic(casimir2 = 0.2, body_inertia = 1), potential = hyperbolic_dilatation(10), emit(splitting))]
struct Sheared;

/// The same in closed form, with a constant `det phi`.
#[affine_model(dim = 2, kinetic(casimir2 = 0.2, body_inertia = 1))]
struct Unloaded;

/// `det phi = 1 - t`: whatever is asked for on the way, a run that stops there ends there.
#[test]
fn outputs_do_not_decide_whether_a_collapse_stops_a_run() {
    let start = Free.at_velocity(Matrix::<2>::identity(), Matrix::<2>::new(-1.0, 0.0, 0.0, 0.0)).unwrap();
    let asked = || Simulation::new(&Free, start).event(Event::determinant(0.0).stop());
    let runs = [
        asked().until(7.0),
        asked().until(5.0),
        asked().until(10.0),
        asked().until(1.0),
        asked().until(3.0).every(0.25),
        asked().until(3.0).every(1.0),
        asked().until(3.0).every(0.3),
        asked().until(3.0).output([1.0]),
    ];
    for run in runs {
        let text = format!("{run:?}");
        let run = run.run().unwrap_or_else(|halt| panic!("{text}: {halt}"));
        assert_eq!(run.stopped_by(), Some("det phi"), "{text}");
        assert!((run.end().0 - 1.0).abs() < 1e-12, "{text}: {}", run.end().0);
        assert!(run.times().windows(2).all(|pair| pair[0] < pair[1]), "{text}: {:?}", run.times());
    }
}

/// `phi = 1 + t V`, and `det phi` by hand: what is told is the rate at the last good point, and nothing positive of a body that has
/// turned back since.
#[test]
fn a_straight_line_tells_of_the_last_good_point() {
    let told = |stop: Stop| match stop.reason {
        Reason::Placement { determinant, rate: Some(rate), t } => (determinant, rate, t),
        _ => panic!("{stop}"),
    };
    // diag(1 - a t, 1 - b t), with the zeros of both or one of them before 3.
    for (a, b) in [(1.0, 1.0), (1.0, 0.5), (1.0, 0.0)] {
        let start = Free.at_velocity(Matrix::<2>::identity(), Matrix::<2>::new(-a, 0.0, 0.0, -b)).unwrap();
        let rate_at = |t: f64| -a * (1.0 - b * t) - b * (1.0 - a * t);
        let check = |(determinant, rate, t): (f64, f64, f64), good: f64, what: &str| {
            assert!((t - 1.0).abs() < 1e-12 && determinant <= 0.0, "{a} {b} {what}: {determinant} {t}");
            assert!((rate - rate_at(good)).abs() < 1e-12, "{a} {b} {what}: {rate} {}", rate_at(good));
        };
        for every in [0.01, 0.3, 3.0] {
            let halt = Simulation::new(&Free, start).until(3.0).every(every).run().unwrap_err();
            check(told(halt.stop), halt.stop.t, "run");
        }
        let mut flow = Flow::new(&Free, (0.0, start)).unwrap();
        flow.advance_to(0.25).unwrap();
        check(told(flow.advance_to(3.0).unwrap_err()), 0.25, "flow");
        let ends = Ensemble::new(&Free, [start]).until(3.0).run().unwrap();
        check(told(*ends[0].as_ref().unwrap_err()), 0.0, "ensemble");
    }
}

/// What an event should have changed a healthy body to is none: that is said, with the name of the event.
#[test]
fn what_an_event_changes_to_is_no_collapse() {
    let start = ball([0.0, 1.0], [0.0, 0.0]);
    type Changed = fn(&Point) -> affine_runtime::Result<Point>;
    let mirror: Changed = |p| Ball.at_momentum(p.x(), Matrix::<2>::new(1.0, 0.0, 0.0, -1.0), p.p(), p.pi());
    let lost: Changed = |p| Ball.at_momentum(p.x() * f64::NAN, *p.phi(), p.p(), p.pi());
    let flat: Changed = |p| Ok(p.with_entries(&mut || 0.0));
    let unplaced: Changed = |p| Ok(p.with_entries(&mut || f64::INFINITY));
    for changed in [mirror, lost, flat, unplaced] {
        for method in FALLING {
            let floor = Event::position(2, 0.0).change(move |_, p: &Point| changed(p)).named("floor");
            let run = Simulation::new(&Ball, start).method(method).until(10.0).event(floor);
            let halt = run.run().unwrap_err();
            assert_eq!(halt.stop.reason, Reason::Change { event: "floor" }, "{method:?}");
            assert!(halt.to_string().contains("`floor`"), "{halt}");
            let met = halt.trajectory.events();
            assert!(met.len() == 1 && (met[0].t - (2.0 / GRAVITY).sqrt()).abs() < 1e-9, "{method:?}");
            assert!(halt.trajectory.end().1.phi().determinant() > 0.0, "{method:?}");
        }
    }
}

#[test]
fn a_point_that_is_an_output_and_an_end_is_recorded_once() {
    let start = ball([0.0, 3.0], [1.0, 0.0]);
    for method in FALLING {
        let at_half = Event::new("half", |t, _: &_| t - 0.5).stop();
        let run = Simulation::new(&Ball, start).method(method).until(0.9).every(0.25);
        let run = run.event(at_half).run().unwrap();
        assert_eq!(run.times(), [0.0, 0.25, 0.5], "{method:?}");
    }
}

/// The largest stretch is some 1e8 in the end, and the smallest its inverse, about: the products of which `det phi` is the
/// difference are larger by the number of digits that doubles have.
#[test]
fn what_rounding_makes_of_the_determinant_is_no_collapse() {
    let phi = Matrix::<2>::new(1.2, 0.3, -0.2, 0.9);
    let phi_dot = Matrix::<2>::new(0.1, 0.3, 0.4, -0.2);
    let sheared = Sheared.at_velocity(phi, phi_dot).unwrap();
    let unloaded = Unloaded.at_velocity(phi, phi_dot).unwrap();
    for method in [Method::Automatic, Method::Splitting { order: 4, step: 0.02 }] {
        let halt = Simulation::new(&Sheared, sheared).method(method).until(60.0).run().unwrap_err();
        let Reason::Distortion { t, .. } = halt.stop.reason else { panic!("{method:?}: {halt}") };
        assert!((35.0..60.0).contains(&t), "{t}");
        assert!(halt.to_string().contains("has not collapsed"), "{halt}");
    }
    let halt = Simulation::new(&Unloaded, unloaded).until(80.0).output([]).run().unwrap_err();
    assert!(matches!(halt.stop.reason, Reason::Distortion { .. }), "{halt}");
    let mut flow = Flow::new(&Unloaded, (0.0, unloaded)).unwrap();
    assert!(matches!(flow.advance_to(80.0).unwrap_err().reason, Reason::Distortion { .. }));

    // It oscillates between 0.853 and 1.172.
    let levels = [Event::determinant(0.7), Event::determinant(1.5)];
    let [low, high] = levels;
    let run = Simulation::new(&Sheared, sheared).until(50.0).event(low).event(high).run().unwrap_err();
    assert!(matches!(run.stop.reason, Reason::Distortion { .. }), "{run}");
    assert_eq!(run.trajectory.events(), []);

    let run = Simulation::new(&Sheared, sheared).until(30.0).run().unwrap();
    assert!(run.why().to_string().contains("stretched far: det phi is"), "{}", run.why());
    let run = Simulation::new(&Sheared, sheared).until(1.0).run().unwrap();
    assert!(!run.why().to_string().contains("stretched far"));
}
