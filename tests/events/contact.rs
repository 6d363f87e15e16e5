//! A ball that falls on a floor and keeps a part of its velocity, `x2 = 1 - g t^2/2` at first.

use core::ops::ControlFlow;

use affine_runtime::prelude::*;
use affine_runtime::simulate::{Halt, Progress, Reason};

use crate::models::{Ball, FALLING, GRAVITY, Point, ball, thrown, wall};

/// What nothing is below, and the times of contact are right to.
const BELOW: f64 = -1e-9;
const TIME: f64 = 1e-6;

type Run = Trajectory<2, Point>;

/// `sqrt(2 h/g)`, the time of the first impact.
fn fall() -> f64 {
    (2.0 / GRAVITY).sqrt()
}

/// The time of impact `k`, from 0: `t0 (1 + 2 (e + ... + e^k))`.
fn impact(part: f64, k: usize) -> f64 {
    fall() * (1.0 + 2.0 * (1..=k as i32).map(|power| part.powi(power)).sum::<f64>())
}

/// When they accumulate.
fn rest(part: f64) -> f64 {
    fall() * (1.0 + part) / (1.0 - part)
}

/// The height above a floor that was hit so many times.
fn height(part: f64, t: f64) -> f64 {
    if t <= fall() {
        return 1.0 - 0.5 * GRAVITY * t * t;
    }
    let last = (0..).take_while(|k| impact(part, *k) <= t).count() - 1;
    let (since, rate) = (t - impact(part, last), GRAVITY * fall() * part.powi(last as i32 + 1));
    since * (rate - 0.5 * GRAVITY * since)
}

fn dropped(part: f64, method: Method, tolerance: f64) -> Simulation<'static, 2, Ball> {
    let start = ball([0.0, 1.0], [0.5, 0.0]);
    Simulation::new(&Ball, start).method(method).tolerance(tolerance).event(wall(2, 0.0, part))
}

/// Every point that a run shows is above the floor, in its own direction of time.
fn above(run: &Run, label: &str) {
    let events = run.events().iter().map(|event| (event.t, &event.point));
    for (t, point) in run.iter().chain(events).chain([run.end()]) {
        assert!(point.x()[1] >= BELOW, "{label}: {} at {t}", point.x()[1]);
    }
}

fn accumulates(halt: &Halt<2, Point>, exact: f64, label: &str) {
    let Reason::Accumulation { event: "x", t, count } = halt.stop.reason else { panic!("{label}: {halt}") };
    assert!((t - exact).abs() < TIME && (halt.stop.t - exact).abs() < TIME, "{label}: {halt}");
    assert_eq!(count as usize, halt.trajectory.events().len(), "{label}: {halt}");
    let words = halt.to_string();
    assert!(
        words.contains("`x`") && words.contains(&format!("t = {t}")) && !words.contains("singular"),
        "{words}"
    );
}

#[test]
fn nothing_falls_through_the_floor() {
    for sign in [1.0, -1.0] {
        for (part, until) in
            [(0.0, 3.0), (1e-9, 3.0), (1e-3, 3.0), (0.01, 3.0), (0.1, 3.0), (0.5, 3.0), (0.9, 10.0)]
        {
            for method in FALLING {
                for tolerance in [1e-3, 1e-10] {
                    let label = format!("e = {part}, {method:?}, {tolerance:e}, {sign}");
                    let run = dropped(part, method, tolerance).until(sign * until).every(0.25).run();
                    let halt = run.err().unwrap_or_else(|| panic!("{label}: arrives"));
                    above(&halt.trajectory, &label);
                    accumulates(&halt, sign * rest(part), &label);
                    for (k, event) in halt.trajectory.events().iter().enumerate() {
                        assert!((event.t - sign * impact(part, k)).abs() < TIME, "{label}: {} {k}", event.t);
                    }
                    for (t, point) in halt.trajectory.iter() {
                        assert!((point.x()[1] - height(part, sign * t)).abs() < TIME, "{label}: x2({t})");
                        assert!((point.x()[0] - 0.5 * t).abs() < TIME, "{label}: x1({t})");
                    }
                }
            }
        }
    }
}

#[test]
fn an_elastic_ball_bounces_on() {
    for method in FALLING {
        let label = format!("{method:?}");
        let run = dropped(1.0, method, 1e-10)
            .until(3.0)
            .every(0.5)
            .run()
            .unwrap_or_else(|halt| panic!("{label}: {halt}"));
        let times: Vec<f64> = run.events().iter().map(|event| event.t).collect();
        assert_eq!(times.len(), 3, "{label}: {times:?}");
        times
            .iter()
            .enumerate()
            .for_each(|(k, t)| assert!((t - impact(1.0, k)).abs() < TIME, "{label}: {times:?}"));
        let (_, end) = run.end();
        assert!(
            (end.x()[1] - height(1.0, 3.0)).abs() < TIME && (end.p()[1] + 2.853_318_491_579_88).abs() < 1e-5
        );
        above(&run, &label);
    }
    // 200 bounces of a ball that loses little are not yet an accumulation.
    let run = dropped(0.999, Method::Automatic, 1e-9).until(150.0).run().unwrap();
    assert!(run.events().len() > 100 && run.end().1.x()[1] > BELOW);
}

/// Rounding of the height is then 1e-16 and 1e-10 of the fall.
#[test]
fn floors_far_from_the_origin() {
    for (floor, part) in
        [(1.0, 0.0), (1.0, 0.01), (1.0, 0.5), (-1e3, 0.0), (-1e3, 0.3), (1e6, 0.0), (1e6, 0.5)]
    {
        for method in
            [Method::RungeKutta8, Method::Taylor { order: None }, Method::Gauss { stages: 2, step: 0.01 }]
        {
            let label = format!("floor at {floor}, e = {part}, {method:?}");
            let start = ball([0.0, floor + 1.0], [0.5, 0.0]);
            let run =
                Simulation::new(&Ball, start).method(method).until(3.0).event(wall(2, floor, part)).run();
            let halt = run.err().unwrap_or_else(|| panic!("{label}: arrives"));
            let Reason::Accumulation { t, .. } = halt.stop.reason else { panic!("{label}: {halt}") };
            // The flights of a height that is lost in rounding take its root.
            let time = 20.0 * (f64::EPSILON * floor.abs()).sqrt() + TIME;
            assert!((t - rest(part)).abs() < time, "{label}: {t} and {}", rest(part));
            let lowest =
                halt.trajectory.points().iter().map(|p| p.x()[1] - floor).fold(f64::INFINITY, f64::min);
            assert!(lowest >= BELOW.min(-4.0 * f64::EPSILON * floor.abs()), "{label}: {lowest}");
        }
    }
}

/// A floor that lets the ball through, and brakes it: once, and on.
#[test]
fn a_change_that_lets_through_happens_once() {
    for kept in [1.0, 0.5, 1e-3] {
        for method in FALLING {
            let label = format!("{kept} of the velocity, {method:?}");
            let slowed =
                move |_: f64, point: &Point| thrown(point, [kept * point.p()[0], kept * point.p()[1]]);
            let surface = Event::position(2, 0.0).change(slowed);
            let start = ball([0.0, 1.0], [0.5, 0.0]);
            let run = Simulation::new(&Ball, start).method(method).until(1.0).event(surface).run();
            let run = run.unwrap_or_else(|halt| panic!("{label}: {halt}"));
            assert_eq!(run.events().len(), 1, "{label}");
            let (since, rate) = (1.0 - fall(), GRAVITY * fall() * kept);
            let exact = -since * (rate + 0.5 * GRAVITY * since);
            assert!((run.end().1.x()[1] - exact).abs() < 1e-5, "{label}: {} and {exact}", run.end().1.x()[1]);
        }
    }
}

/// A callback that ends a run when it is called for the third time.
fn third() -> impl FnMut(&Progress) -> ControlFlow<()> {
    let mut calls = 0;
    move |_| {
        calls += 1;
        if calls == 3 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

/// Interrupted after every third step or change.
#[test]
fn bounces_go_on_with_the_same_bits() {
    for method in FALLING {
        for part in [0.0, 0.5] {
            let whole = || dropped(part, method, 1e-9).until(3.0).every(0.21);
            let expected = whole().run().unwrap_err();
            let mut parts: Vec<Run> = Vec::new();
            let reason = loop {
                let next = match parts.last() {
                    None => whole(),
                    Some(last) => whole().resume(last.checkpoint().unwrap()),
                };
                let halt = next.progress(third()).run().unwrap_err();
                let reason = halt.stop.reason;
                parts.push(*halt.trajectory);
                if !matches!(reason, Reason::Interrupted(_)) {
                    break reason;
                }
            };
            assert!(parts.len() > 2 || part == 0.0, "{method:?}: {} parts", parts.len());
            assert_eq!(reason, expected.stop.reason, "{method:?}");
            let events: Vec<_> = parts.iter().flat_map(|run| run.events().to_vec()).collect();
            assert_eq!(events, expected.trajectory.events(), "{method:?}");
            let points: Vec<_> = parts.iter().flat_map(|run| run.points().to_vec()).collect();
            assert_eq!(points, expected.trajectory.points(), "{method:?}");
            assert_eq!(parts.last().unwrap().end(), expected.trajectory.end(), "{method:?}");
        }
    }
}
