//! Several events at one time, of which the first changes the point.

use affine_runtime::prelude::*;
use affine_runtime::simulate::Reason;

use crate::models::{Ball, FALLING, GRAVITY, Point, Puck, ball, puck, thrown, wall};

const METHODS: [Method; 5] = [
    Method::ClosedForm,
    Method::RungeKutta8,
    Method::RungeKutta5,
    Method::Taylor { order: None },
    Method::Gauss { stages: 2, step: 0.013 },
];

fn near(point: &Point, x: [f64; 2], v: [f64; 2], label: &str) {
    let off = (point.x() - Vector::<2>::from(x)).norm() + (point.p() - Vector::<2>::from(v)).norm();
    assert!(off < 1e-9, "{label}: {:?} {:?}", point.x(), point.p());
}

/// Walls at x1 = 0 and x2 = 0 that are met at the same time, in either order of their statements.
#[test]
fn both_walls_of_a_corner() {
    for sign in [1.0, -1.0] {
        for method in METHODS {
            for order in [[1, 2], [2, 1]] {
                for (x, v, part, t, end) in [
                    ([4.0, 4.0], [-1.0, -1.0], 1.0, 8.0, [4.0, 4.0]),
                    ([4.0, 4.0], [-1.0, -1.0], 0.5, 8.0, [2.0, 2.0]),
                    ([3.0, 6.0], [-1.0, -2.0], 1.0, 5.0, [2.0, 4.0]),
                    // Times that are no doubles.
                    ([0.7, 0.7], [-0.3, -0.3], 1.0, 4.0, [0.5, 0.5]),
                    ([0.1, 0.3], [-0.7, -2.1], 1.0, 1.0, [0.6, 1.8]),
                ] {
                    let label = format!("{x:?} {v:?} e = {part}, {method:?}, {order:?}, {sign}");
                    let run = Simulation::new(&Puck, puck(x, v.map(|v| sign * v)))
                        .method(method)
                        .until(sign * t)
                        .event(wall(order[0], 0.0, part))
                        .event(wall(order[1], 0.0, part))
                        .run()
                        .unwrap_or_else(|halt| panic!("{label}: {halt}"));
                    assert_eq!(run.events().len(), 2, "{label}");
                    let back = v.map(|v| -sign * part * v);
                    near(run.end().1, end, back, &label);
                }
            }
        }
    }
}

/// The first change of a time decides whether the others happen.
#[test]
fn the_others_are_looked_at_again() {
    for method in METHODS {
        let label = format!("{method:?}");
        let start = puck([4.0, 4.0], [-1.0, -1.0]);
        let simulation = || Simulation::new(&Puck, start).method(method).until(8.0);
        // All of the velocity is reversed: the second wall is not met any more.
        let back = |_: f64, point: &Point| thrown(point, [-point.p()[0], -point.p()[1]]);
        let first = Event::position(1, 0.0).named("first").change(back);
        let run = simulation().event(first).event(wall(2, 0.0, 1.0)).run().unwrap();
        assert_eq!(run.events().len(), 1, "{label}");
        near(run.end().1, [4.0, 4.0], [1.0, 1.0], &label);
        // What is only recorded still happens where the way leads on through it, at the changed point.
        let level = || Event::position(2, 0.0).named("level");
        let run = simulation().event(wall(1, 0.0, 1.0)).event(level()).run().unwrap();
        let found: Vec<_> = run.events().iter().map(|event| (event.name, event.point.p()[0])).collect();
        assert_eq!(found, [("x", -1.0), ("level", 1.0)], "{label}");
        assert!(run.events().iter().all(|event| (event.t - 4.0).abs() < 1e-9 && !event.rising), "{label}");
        // Stated first, it happens first, and only once.
        let run = simulation().event(level()).event(wall(1, 0.0, 1.0)).run().unwrap();
        let found: Vec<_> = run.events().iter().map(|event| (event.name, event.point.p()[0])).collect();
        assert_eq!(found, [("level", -1.0), ("x", -1.0)], "{label}");
        // A stop at the changed point.
        let run = simulation().event(wall(1, 0.0, 1.0)).event(level().stop()).run().unwrap();
        assert_eq!((run.stopped_by(), run.events().len()), (Some("level"), 2), "{label}");
        near(run.end().1, [0.0, 0.0], [1.0, -1.0], &label);
    }
}

/// A floor on which the ball comes to rest, and a wall that it meets at the same time: the wall is met before the run ends.
#[test]
fn rest_on_a_floor_at_a_wall() {
    let fall = (2.0 / GRAVITY).sqrt();
    let mut met = 0;
    for method in FALLING {
        for order in [[1, 2], [2, 1]] {
            let part = |i| if i == 1 { 1.0 } else { 0.0 };
            let halt = Simulation::new(&Ball, ball([fall, 1.0], [-1.0, 0.0]))
                .method(method)
                .until(3.0)
                .event(wall(order[0], 0.0, part(order[0])).named("first"))
                .event(wall(order[1], 0.0, part(order[1])).named("second"))
                .run()
                .unwrap_err();
            let Reason::Accumulation { event, t, .. } = halt.stop.reason else {
                panic!("{method:?}: {halt}")
            };
            assert!((t - fall).abs() < 1e-9, "{method:?} {order:?}: {halt}");
            assert_eq!(event, if order[0] == 2 { "first" } else { "second" }, "{method:?} {order:?}: {halt}");
            let (_, end) = halt.trajectory.end();
            // By rounding the wall may be just ahead.
            let is_met = (end.p() - Vector::<2>::new(1.0, 0.0)).norm() < 1e-9;
            assert!(is_met || end.x()[0] > 0.0, "{method:?} {order:?}: {:?} {:?}", end.x(), end.p());
            met += usize::from(is_met);
        }
    }
    assert!(met > 5, "{met}");
}

/// Two walls that pass the body to and fro without end at one time.
#[test]
fn changes_of_each_other_at_one_time() {
    let put = |x: [f64; 2], v: [f64; 2]| {
        move |_: f64, point: &Point| {
            Puck.at_momentum(Vector::<2>::from(x), *point.phi(), Vector::<2>::from(v), point.pi())
        }
    };
    let run = Simulation::new(&Puck, puck([1.0, 5.0], [-1.0, 0.0]))
        .until(3.0)
        .event(Event::position(1, 0.0).named("one").falling().change(put([5.0, 0.0], [0.0, -1.0])))
        .event(Event::position(2, 0.0).named("other").falling().change(put([0.0, 5.0], [-1.0, 0.0])))
        .run();
    let halt = run.unwrap_err();
    let Reason::Accumulation { event: "one" | "other", t, count } = halt.stop.reason else {
        panic!("{halt}")
    };
    assert!((t - 1.0).abs() < 1e-12 && (50..200).contains(&count), "{halt}");
}

/// In the corner of two walls and a floor, under gravity.
#[test]
fn a_ball_in_a_box() {
    for method in
        [Method::RungeKutta8, Method::Taylor { order: None }, Method::Gauss { stages: 2, step: 0.01 }]
    {
        // Down to the floor and over to the wall in the same time.
        let fall = (2.0 / GRAVITY).sqrt();
        let start = ball([fall, 1.0], [-1.0, 0.0]);
        let run = Simulation::new(&Ball, start)
            .method(method)
            .until(2.0 * fall)
            .event(wall(1, 0.0, 1.0).named("wall"))
            .event(wall(2, 0.0, 1.0).named("floor"))
            .run()
            .unwrap();
        assert_eq!(run.events().len(), 2, "{method:?}");
        let (x, v) = (run.end().1.x(), run.end().1.p());
        assert!((x - Vector::<2>::new(fall, 1.0)).norm() < 1e-9, "{method:?}: {x:?}");
        assert!((v - Vector::<2>::new(1.0, 0.0)).norm() < 1e-8, "{method:?}: {v:?}");
    }
}

/// Between four walls the way is that of a straight line folded into the box; every third one goes into the corners.
#[test]
fn a_puck_in_a_box() {
    let sides = [1.3, 0.9];
    let fold = |x: f64, side: f64| {
        let x = x.rem_euclid(2.0 * side);
        if x > side { 2.0 * side - x } else { x }
    };
    let upper = |i: usize| {
        let bounced = move |_: f64, point: &Point| {
            let mut v = [point.p()[0], point.p()[1]];
            v[i - 1] = -v[i - 1];
            thrown(point, v)
        };
        Event::position(i, sides[i - 1]).rising().change(bounced)
    };
    for (parts, velocity) in [
        ([0.25, 0.25], [-0.37, -0.37]),
        ([0.31, 0.77], [0.21, -0.45]),
        ([0.9, 0.05], [-0.11, 0.49]),
        ([0.75, 0.25], [0.41, -0.41]),
    ] {
        for method in METHODS {
            let label = format!("{parts:?} {velocity:?} {method:?}");
            let [x, v] = [parts, velocity].map(|part| [part[0] * sides[0], part[1] * sides[1]]);
            let until = 60.0;
            let run = Simulation::new(&Puck, puck(x, v))
                .method(method)
                .until(until)
                .output([until])
                .event(wall(1, 0.0, 1.0))
                .event(wall(2, 0.0, 1.0))
                .event(upper(1))
                .event(upper(2))
                .run()
                .unwrap_or_else(|halt| panic!("{label}: {halt}"));
            let exact = [0, 1].map(|i| fold(x[i] + until * v[i], sides[i]));
            let off = (run.end().1.x() - Vector::<2>::from(exact)).norm();
            assert!(off < 1e-10 && run.events().len() > 30, "{label}: {off:e} after {}", run.events().len());
        }
    }
}
