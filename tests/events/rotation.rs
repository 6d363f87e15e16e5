//! Fast rotation: every crossing of a level is found. Their numbers are those of 4e5 samples of
//! `phi0 exp(t X) exp(t W)`, where all of them are simple.

use core::ops::ControlFlow;

use affine_runtime::prelude::*;
use affine_runtime::simulate::Reason;

use crate::models::{Disc, Puck};

type Point = <Disc as Model<2>>::Point<f64>;

struct Case {
    phi: [f64; 4],
    omega_hat: [f64; 4],
    falling: usize,
    rising: usize,
    first: f64,
    last: f64,
    /// A step that resolves the motion.
    step: f64,
}

const CASES: [Case; 3] = [
    Case {
        phi: [1.0, 0.0, 0.0, 1.0],
        omega_hat: [0.0, 1e3, -1e3, 0.0],
        falling: 398,
        rising: 397,
        first: 0.003_141_592_653_589_793,
        last: 2.497_566_159_603_886,
        step: 2.5e-4,
    },
    Case {
        phi: [1.0, 0.0, 0.0, 1.0],
        omega_hat: [0.0, 50.0, -50.0, 0.0],
        falling: 20,
        rising: 19,
        first: 0.062_831_853_071_795_86,
        last: 2.450_442_269_800_039_4,
        step: 5e-3,
    },
    Case {
        phi: [1.1, 0.2, -0.1, 0.95],
        omega_hat: [100.0, 1e3, -800.0, -100.0],
        falling: 365,
        rising: 364,
        first: 0.002_987_098_794_971_961_6,
        last: 2.497_324_977_688_794_2,
        step: 2.5e-4,
    },
];

const SPAN: f64 = 2.5;
/// Times are right to some hundred of it.
const TOLERANCE: f64 = 1e-9;

fn start(case: &Case) -> Point {
    let [phi, omega_hat] = [case.phi, case.omega_hat].map(|rows| Matrix::<2>::from_row_slice(&rows));
    Disc.at_velocity(phi, phi * omega_hat).unwrap()
}

fn zero() -> Event<'static, 2, Point> {
    Event::new("zero", |_, point: &Point| point.phi()[(0, 1)])
}

fn counts(run: &Trajectory<2, Point>) -> (usize, usize) {
    let rising = run.events().iter().filter(|event| event.rising).count();
    (run.events().len() - rising, rising)
}

/// Methods that are exact but for rounding, and those of a tolerance or a step, with what their times are right to.
fn methods(case: &Case) -> Vec<(Method, f64)> {
    let step = case.step;
    vec![
        // The closed form.
        (Method::Automatic, 1e-11),
        (Method::RungeKutta8, 1e-6),
        (Method::RungeKutta5, 1e-6),
        (Method::Taylor { order: None }, 1e-6),
        // Steps of several turns.
        (Method::Taylor { order: Some(32) }, 1e-6),
        (Method::Gauss { stages: 3, step }, 1e-6),
        (Method::Splitting { order: 4, step }, 1e-6),
        // The pieces commute: steps of thousands of turns.
        (Method::AdaptiveSplitting { order: None }, 1e-6),
        (Method::Splitting { order: 2, step: 0.5 }, 1e-6),
    ]
}

#[test]
fn every_crossing_is_found() {
    for case in &CASES {
        for (method, right) in methods(case) {
            let label = format!("{:?} {method:?}", case.omega_hat);
            let simulation =
                Simulation::new(&Disc, start(case)).until(SPAN).method(method).tolerance(TOLERANCE);
            let run = simulation.output([SPAN]).event(zero()).run().unwrap();
            assert_eq!(counts(&run), (case.falling, case.rising), "{label}");
            let times: Vec<f64> = run.events().iter().map(|event| event.t).collect();
            assert!(times.windows(2).all(|pair| pair[0] < pair[1]), "{label}");
            assert!((times[0] - case.first).abs() < right, "{label}: {}", times[0]);
            assert!(
                (times[times.len() - 1] - case.last).abs() < right,
                "{label}: {}",
                times[times.len() - 1]
            );
        }
    }
}

/// Backward from the end the same crossings in the opposite order, whatever the outputs.
#[test]
fn every_crossing_is_found_backward() {
    for case in &CASES {
        let there = Simulation::new(&Disc, start(case)).until(SPAN).event(zero()).run().unwrap();
        for method in [Method::ClosedForm, Method::RungeKutta8, Method::AdaptiveSplitting { order: None }] {
            let label = format!("{:?} {method:?}", case.omega_hat);
            let back = Simulation::new(&Disc, *there.end().1).from(SPAN).until(1e-4).method(method);
            let back = back.event(zero()).run().unwrap();
            assert_eq!(back.events().len(), there.events().len(), "{label}");
            for (back, there) in back.events().iter().rev().zip(there.events()) {
                assert!(
                    (back.t - there.t).abs() < 1e-6 && back.rising != there.rising,
                    "{label}: {}",
                    back.t
                );
            }
        }
    }
}

/// A pair of levels that are crossed one shortly after the other, between the same two samples.
#[test]
fn crossings_close_together_come_in_their_order() {
    let case = &CASES[1];
    let level = |name, value: f64| Event::new(name, move |_, point: &Point| point.phi()[(0, 1)] - value);
    for (from, until) in [(0.0, SPAN), (SPAN, 0.0)] {
        for method in [Method::ClosedForm, Method::RungeKutta8, Method::AdaptiveSplitting { order: None }] {
            let run = Simulation::new(&Disc, start(case)).from(from).until(until).method(method);
            let run = run.event(level("high", 1e-3)).event(level("low", -1e-3)).run().unwrap();
            assert!(run.events().len() > 75, "{method:?}: {}", run.events().len());
            let sign = (until - from).signum();
            assert!(run.events().windows(2).all(|pair| sign * (pair[1].t - pair[0].t) > 0.0), "{method:?}");
            for event in run.events() {
                let pair = run.events().iter().filter(|other| (other.t - event.t).abs() < 1e-3);
                let names: Vec<&str> = pair.map(|event| event.name).collect();
                let expected = if event.rising { ["low", "high"] } else { ["high", "low"] };
                assert!(names == expected || names.len() == 1, "{method:?}: {names:?} at {}", event.t);
            }
        }
    }
}

/// Of straight lines samples are taken from where the placement is small: with `s = 1e6 t`, `phi = [1 - s, 1; -1, 1 - s/2]`.
#[test]
fn a_straight_line_past_the_origin() {
    let (zero, phi) = (Vector::<2>::zeros(), Matrix::<2>::new(1.0, 1.0, -1.0, 1.0));
    let start = Puck.at_velocity(zero, phi, zero, Matrix::<2>::new(-1e6, 0.0, 0.0, -0.5e6)).unwrap();
    let event = Event::largest_stretch(1.3);
    let run = Simulation::new(&Puck, start).until(10.0).output([10.0]).event(event).run().unwrap();
    // det(phi^T phi - 1.69) is negative where one stretch alone is larger than 1.3, and positive from 0.9 to 1.05, where none is.
    let determinant = |s: f64| {
        let (a, b) = (1.0 - s, 1.0 - 0.5 * s);
        (a * a - 0.69) * (b * b - 0.69) - 0.25 * s * s
    };
    let root = |mut outside: f64| {
        let mut inside = 1.0;
        for _ in 0..60 {
            let middle = 0.5 * (outside + inside);
            *(if determinant(middle) < 0.0 { &mut outside } else { &mut inside }) = middle;
        }
        inside
    };
    let times: Vec<f64> = run.events().iter().map(|event| event.t).collect();
    assert_eq!(times.len(), 2, "{times:?}");
    for (t, exact) in times.iter().zip([root(0.2), root(2.0)]) {
        assert!((t - 1e-6 * exact).abs() < 1e-20, "{t} and {exact}");
    }
}

/// A run of ages, of which nothing is kept but what happens: it tells how far it has come, and can be ended and gone on with.
#[test]
fn long_runs_are_interrupted_and_gone_on_with() {
    let never = || Event::new("never", |_, point: &Point| point.phi().norm() - 100.0);
    let ages = || Simulation::new(&Disc, start(&CASES[0])).until(1e10).output([1e10]).event(never());
    let mut calls = 0;
    let halt = ages()
        .progress(|progress| {
            calls += 1;
            assert!(progress.fraction() < 1.0);
            if calls == 1000 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        })
        .run()
        .unwrap_err();
    assert!(matches!(halt.stop.reason, Reason::Interrupted(_)), "{halt}");
    let reached = core::cell::Cell::new(0.0);
    let next = ages().resume(halt.trajectory.checkpoint().unwrap()).progress(|progress| {
        reached.set(progress.t);
        ControlFlow::Break(())
    });
    assert!(matches!(next.run().unwrap_err().stop.reason, Reason::Interrupted(_)));
    assert!(reached.get() > 0.1 && reached.get() < 10.0, "{}", reached.get());
}

#[test]
fn interrupted_samples_give_the_same_bits() {
    let case = &CASES[2];
    for outputs in [vec![1.0], vec![0.3, 0.7, 1.0]] {
        let whole = || Simulation::new(&Disc, start(case)).until(1.0).output(outputs.clone()).event(zero());
        let expected = whole().run().unwrap();
        let mut events = Vec::new();
        let mut checkpoint = None;
        let mut parts = 0;
        loop {
            let next = checkpoint.as_ref().map_or_else(whole, |checkpoint| whole().resume(checkpoint));
            let mut calls = 0;
            let run = next.progress(move |_| {
                calls += 1;
                if calls == 7 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            });
            parts += 1;
            match run.run() {
                Ok(run) => {
                    events.extend(run.events().to_vec());
                    break;
                }
                Err(halt) => {
                    events.extend(halt.trajectory.events().to_vec());
                    checkpoint = halt.trajectory.checkpoint().cloned();
                }
            }
        }
        assert!(parts > 20, "{parts}");
        assert_eq!(events, expected.events());
    }
}

/// A single step of hundreds of turns tells how far it has come, and is ended and gone on with within.
#[test]
fn long_steps_are_interrupted_and_gone_on_with() {
    let case = &CASES[0];
    let method = Method::AdaptiveSplitting { order: None };
    let whole = || Simulation::new(&Disc, start(case)).until(3.0).output([3.0]).method(method).event(zero());
    let expected = whole().run().unwrap();
    assert!(expected.statistics().steps < 5, "{}", expected.statistics().steps);
    assert_eq!(expected.events().len(), 954);
    let mut calls = 0;
    let halt = whole()
        .progress(|progress| {
            calls += 1;
            if calls == 5 {
                assert!(progress.fraction() < 1.0)
            }
            if calls == 5 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        })
        .run()
        .unwrap_err();
    let first = halt.trajectory;
    let rest = whole().resume(first.checkpoint().unwrap()).run().unwrap();
    assert!(first.events().len() > 100 && rest.events().len() > 100, "{}", first.events().len());
    let events: Vec<_> = first.events().iter().chain(rest.events()).copied().collect();
    assert_eq!(events, expected.events());
    assert_eq!(rest.end(), expected.end());
}

/// A closed form that follows upon steps is no more exact than they: the run is one by steps.
#[test]
fn a_closed_form_after_steps() {
    #[affine_model(dim = 2, kinetic(casimir2 = 0.2, body_inertia = 1, body_translation = 1))]
    struct Missile;
    type Flying = <Missile as Model<2>>::Point<f64>;
    let rest = |point: &Flying| {
        Missile.at_momentum(point.x(), *point.phi(), Vector::<2>::zeros(), point.sigma_hat())
    };
    let (x, spin) = (Vector::<2>::new(0.5, 0.2), Matrix::<2>::new(0.1, 0.3, -0.2, 0.1));
    let moving = Missile.at_momentum(x, Matrix::identity(), x, Comoving(spin)).unwrap();
    let run = |start: Flying| {
        let caught = Event::new("caught", |t, _: &Flying| t - 1.0).change(move |_, point| rest(point));
        Simulation::new(&Missile, start).until(2.0).event(caught).run().unwrap()
    };
    let both = run(moving);
    assert!(both.statistics().steps > 0 && both.computation().method == Method::RungeKutta8);
    assert!(!both.why().to_string().contains("no steps"), "{}", both.why());
    assert_eq!(run(rest(&moving).unwrap()).computation().method, Method::ClosedForm);

    // A vorticity that an event takes away has been there.
    type Turning = <Disc as Model<2>>::Point<f64>;
    let straight = |point: &Turning| {
        let spin = point.sigma_hat().0.0;
        Disc.at_momentum(*point.phi(), Comoving(spin + spin.transpose()))
    };
    let turning = Disc.at_momentum(Matrix::identity(), Comoving(spin)).unwrap();
    let said = |start: Turning| {
        let caught = Event::new("caught", |t, _: &Turning| t - 1.0).change(move |_, point| straight(point));
        Simulation::new(&Disc, start).until(2.0).event(caught).run().unwrap().why().to_string()
    };
    let skew = "left out of this run: the skew factor";
    assert!(!said(turning).contains(skew) && said(straight(&turning).unwrap()).contains(skew));
}
