//! Bodies that collapse where an output is due, and one that only seems to.

use affine_runtime::prelude::*;
use affine_runtime::simulate::Reason;

use crate::models::{FALLING, ball};

/// Its placement follows a straight line.
#[affine_model(dim = 2, kinetic(dalembert = 1))]
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

#[test]
fn a_point_that_is_an_output_and_an_end_is_recorded_once() {
    let start = ball([0.0, 3.0], [1.0, 0.0]);
    for method in FALLING {
        let at_half = Event::new("half", |t, _: &_| t - 0.5).stop();
        let run = Simulation::new(&crate::models::Ball, start).method(method).until(0.9).every(0.25);
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
