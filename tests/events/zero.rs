//! Functions that are zero where a run starts, or where a change puts the point.

use affine_runtime::prelude::*;
use affine_runtime::simulate::Reason;

use crate::models::{Ball, FALLING, GRAVITY, Point, Puck, ball, puck, thrown, wall};

/// At velocity -1 under gravity: an impact at once, the next one after `2/g`.
#[test]
fn a_ball_on_the_floor_that_moves_down() {
    for sign in [1.0, -1.0] {
        for method in FALLING {
            let label = format!("{method:?}, {sign}");
            let start = ball([0.0, 0.0], [0.5, -sign]);
            let simulation = || Simulation::new(&Ball, start).method(method).until(sign * 0.3);
            let run = simulation().output([0.1 * sign]).event(wall(2, 0.0, 1.0)).run().unwrap();
            let times: Vec<f64> = run.events().iter().map(|event| sign * event.t).collect();
            assert_eq!((times.len(), times[0]), (2, 0.0), "{label}: {times:?}");
            assert!((times[1] - 2.0 / GRAVITY).abs() < 1e-9, "{label}: {times:?}");
            assert!((run.points()[0].x()[1] - 0.050_95).abs() < 1e-9, "{label}");
            // In the other direction it is no event, and in either direction nothing is known of before.
            let floor = || Event::position(2, 0.0);
            assert_eq!(simulation().event(floor().rising()).run().unwrap().events().len(), 0, "{label}");
            assert_eq!(simulation().event(floor()).run().unwrap().events().len(), 0, "{label}");
            let stopped = simulation().event(floor().falling().stop()).run().unwrap();
            assert_eq!((stopped.stopped_by(), stopped.end().0), (Some("x"), 0.0), "{label}");
            // It is not met again.
            let checkpoint = stopped.checkpoint().unwrap();
            let rest = simulation().event(floor().falling().stop()).resume(checkpoint).run().unwrap();
            assert_eq!(
                (rest.stopped_by(), rest.end().0, rest.events().len()),
                (None, sign * 0.3, 0),
                "{label}"
            );
        }
    }
}

/// Thrown up from the floor, however low, it comes down on it.
#[test]
fn a_ball_on_the_floor_that_moves_up() {
    for method in FALLING {
        for rate in [1e-9, 1e-6, 1e-3, 1.0] {
            let start = ball([0.0, 0.0], [0.5, rate]);
            let floor = Event::position(2, 0.0).falling().stop();
            let run = Simulation::new(&Ball, start).method(method).until(3.0).event(floor).run().unwrap();
            let exact = 2.0 * rate / GRAVITY;
            assert!((run.end().0 - exact).abs() < 1e-6 * exact, "{method:?} {rate}: {}", run.end().0);
        }
    }
}

/// At rest on the floor the ball would go through it: that is an impact, which leaves it at rest.
#[test]
fn a_ball_at_rest_on_the_floor() {
    for method in FALLING {
        let start = ball([0.0, 0.0], [0.5, 0.0]);
        let simulation = || Simulation::new(&Ball, start).method(method).until(1.0);
        let halt = simulation().event(wall(2, 0.0, 0.5)).run().unwrap_err();
        assert_eq!(halt.stop.reason, Reason::Accumulation { event: "x", t: 0.0, count: 1 }, "{method:?}");
        let stopped = simulation().event(Event::position(2, 0.0).falling().stop()).run().unwrap();
        assert_eq!(stopped.end().0, 0.0, "{method:?}");
    }
    // Without gravity it stays, and nothing happens.
    let halted = Simulation::new(&Puck, puck([1.0, 0.0], [0.5, 0.0])).until(1.0).event(wall(2, 0.0, 0.5));
    assert_eq!(halted.run().unwrap().events().len(), 0);
}

/// At x1 = 1 the ball is put on the floor: from there it goes where its velocity says.
#[test]
fn a_change_to_zero_exactly() {
    for (rate, impacts) in [(-1.0, 1), (0.25, 0), (1.0, 0)] {
        for method in [Method::Automatic, Method::RungeKutta8, Method::Gauss { stages: 2, step: 0.01 }] {
            let put = move |_: f64, point: &Point| {
                let (x, v) = (point.x(), Vector::<2>::new(point.p()[0], rate));
                Puck.at_momentum(Vector::<2>::new(x[0], 0.0), *point.phi(), v, point.pi())
            };
            let run = Simulation::new(&Puck, puck([0.0, 5.0], [1.0, 0.1]))
                .method(method)
                .until(2.0)
                .event(Event::position(1, 1.0).named("gate").change(put))
                .event(wall(2, 0.0, 1.0).named("floor"))
                .run()
                .unwrap();
            let names: Vec<&str> = run.events().iter().map(|event| event.name).collect();
            assert_eq!(names.len(), 1 + impacts, "{rate} {method:?}: {names:?}");
            let height = run.end().1.x()[1];
            assert!((height - rate.abs()).abs() < 1e-9, "{rate} {method:?}: {height}");
        }
    }
}

/// The event's own change puts the ball on the floor exactly, and reverses a part of its velocity.
#[test]
fn a_change_that_corrects_the_contact() {
    for part in [0.5, 0.0] {
        for method in FALLING {
            let corrected = move |_: f64, point: &Point| {
                let point = thrown(point, [point.p()[0], -part * point.p()[1]])?;
                Ball.at_momentum(Vector::<2>::new(point.x()[0], 0.0), *point.phi(), point.p(), point.pi())
            };
            let floor = Event::position(2, 0.0).falling().change(corrected);
            let start = ball([0.0, 1.0], [0.5, 0.0]);
            let halt =
                Simulation::new(&Ball, start).method(method).until(3.0).event(floor).run().unwrap_err();
            let exact = (2.0 / GRAVITY).sqrt() * (1.0 + part) / (1.0 - part);
            let Reason::Accumulation { t, .. } = halt.stop.reason else {
                panic!("{method:?} {part}: {halt}")
            };
            assert!((t - exact).abs() < 1e-6, "{method:?} {part}: {t}");
            assert!(halt.trajectory.points().iter().all(|point| point.x()[1] > -1e-9), "{method:?} {part}");
        }
    }
}

/// A ball thrown up from the floor that is back on it at a time at which samples are taken, in numbers that are exact.
#[test]
fn a_flight_that_ends_at_a_sample() {
    let clock = |_: f64, point: &Point| {
        let t = point.x()[0];
        t * (1.0 - t)
    };
    for until in [1.0, 2.0, 4.0, 8.0] {
        for method in [Method::ClosedForm, Method::RungeKutta8, Method::Gauss { stages: 2, step: 0.25 }] {
            let event = Event::new("floor", clock).falling();
            let run =
                Simulation::new(&Puck, puck([0.0, 1.0], [1.0, 0.0])).method(method).until(until).event(event);
            let times: Vec<f64> = run.run().unwrap().events().iter().map(|event| event.t).collect();
            assert!(times.len() == 1 && (times[0] - 1.0).abs() < 1e-12, "{method:?} {until}: {times:?}");
        }
    }
}
