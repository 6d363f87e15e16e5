//! Balls that keep a part of their velocity, dropped in scenes that are drawn: when their bounces accumulate is known,
//! `t0 + (v + w)/g + 2 e w/(g (1 - e))` with `w^2 = v^2 + 2 g h` for a throw upward at velocity `v` from a height `h`.

use affine_runtime::prelude::*;
use affine_runtime::simulate::Reason;

use crate::models::{Ball, FALLING, GRAVITY, Point, Puck, ball, puck, thrown, wall};

/// What nothing is below, beside the rounding of heights.
const BELOW: f64 = 1e-9;
/// What times are right to, beside flights that are lost in the rounding of heights and of times.
const TIME: f64 = 1e-6;
const SCENES: u64 = 400;

/// Numbers from 0 to 1: the fractional parts of multiples of a root.
struct Drawn(u64);

impl Drawn {
    fn part(&mut self) -> f64 {
        self.0 += 1;
        (self.0 as f64 * 0.618_033_988_749_894_9 + (self.0 as f64 * 0.754_877_666_246_692_8).fract()).fract()
    }

    fn one<T: Copy>(&mut self, of: &[T]) -> T {
        of[(self.part() * of.len() as f64) as usize]
    }
}

/// A ball over a floor.
#[derive(Clone, Copy, Debug)]
struct Scene {
    floor: f64,
    height: f64,
    /// Upward, in the direction of the run.
    velocity: f64,
    across: f64,
    part: f64,
    t0: f64,
    /// Of time.
    sign: f64,
    tolerance: f64,
    method: Method,
}

impl Scene {
    fn drawn(k: u64) -> Self {
        let mut drawn = Drawn(k * 1009);
        let part = 0.9 * drawn.part();
        Self {
            floor: drawn.one(&[0.0, 0.1, 1.0, -0.5, 3.0, 100.0]),
            height: drawn.one(&[1.0, 0.3, 1e-3]),
            velocity: drawn.one(&[0.0, 0.0, 1e-9, 1e-3, 1.0, -1.0]),
            across: drawn.one(&[0.0, 0.0, 0.5, 1e-3]),
            part: drawn.one(&[part, part, part, part, 0.1, 0.0]),
            t0: drawn.one(&[0.0, 0.0, 10.0, 1e6]),
            sign: drawn.one(&[1.0, 1.0, -1.0]),
            tolerance: drawn.one(&[1e-4, 1e-7, 1e-10, 1e-13]),
            method: drawn.one(&FALLING),
        }
    }

    /// When its bounces accumulate.
    fn rest(&self) -> f64 {
        let impact = (self.velocity * self.velocity + 2.0 * GRAVITY * self.height).sqrt();
        let bounces = 2.0 * self.part * impact / (GRAVITY * (1.0 - self.part));
        self.t0 + self.sign * ((self.velocity + impact) / GRAVITY + bounces)
    }

    fn start(&self) -> Point {
        ball([0.0, self.floor + self.height], [self.across, self.sign * self.velocity])
    }

    fn run(&self) -> Simulation<'static, 2, Ball> {
        Simulation::new(&Ball, self.start())
            .from(self.t0)
            .until(self.rest() + 5.0 * self.sign)
            .tolerance(self.tolerance)
            .method(self.method)
            .event(wall(2, self.floor, self.part))
    }

    /// Its bounces accumulated when they should.
    fn accumulated(&self, reason: Reason) {
        let Reason::Accumulation { event: "x", t, .. } = reason else { panic!("{self:?}: {reason}") };
        // A flight as high as a rounding takes its root, and one as long as some roundings of time is not seen.
        let lost = 20.0 * (f64::EPSILON * self.floor.abs()).sqrt() + 1e3 * f64::EPSILON * self.t0.abs();
        assert!((t - self.rest()).abs() < TIME + lost, "{self:?}: {t} and {}", self.rest());
    }
}

#[test]
fn bounces_accumulate_when_they_should() {
    for scene in (0..SCENES).map(Scene::drawn) {
        let halt = scene.run().run().err().unwrap_or_else(|| panic!("{scene:?}: arrives"));
        scene.accumulated(halt.stop.reason);
        let low = scene.floor - BELOW - 8.0 * f64::EPSILON * scene.floor.abs();
        let events = halt.trajectory.events().iter().map(|event| (event.t, &event.point));
        for (t, point) in halt.trajectory.iter().chain(events).chain([halt.trajectory.end()]) {
            assert!(point.x()[1] >= low, "{scene:?}: {:e} below at {t}", scene.floor - point.x()[1]);
        }
    }
}

/// Thrown up from the floor so low that flights are some roundings of heights, or of times: bounces that are not told from a rest.
#[test]
fn lowest_flights_end_on_the_floor() {
    for (floor, t0, velocity) in [
        (1e6, 0.0, 1e-3),
        (1e6, 0.0, 3e-4),
        (100.0, 0.0, 1e-6),
        (0.0, 1e4, 1e-9),
        (0.0, 1e6, 1e-7),
        (-1e9, 1e6, 0.1),
    ] {
        for (part, sign) in [0.0, 0.01, 0.3, 0.7].into_iter().flat_map(|part| [(part, 1.0), (part, -1.0)]) {
            for method in FALLING {
                let scene = Scene {
                    floor,
                    height: 0.0,
                    velocity,
                    across: 0.0,
                    part,
                    t0,
                    sign,
                    tolerance: 1e-10,
                    method,
                };
                let halt = scene.run().run().err().unwrap_or_else(|| panic!("{scene:?}: arrives"));
                scene.accumulated(halt.stop.reason);
                let (_, end) = halt.trajectory.end();
                assert!(end.x()[1] >= floor - 1e-12 - 64.0 * f64::EPSILON * floor.abs(), "{scene:?}");
            }
        }
    }
}

#[test]
fn bodies_of_an_ensemble_come_to_rest() {
    for (floor, part) in
        [0.0, 0.1, 1.0, -0.5, 3.0, 100.0].into_iter().flat_map(|floor| [0.0, 0.1, 0.6].map(|e| (floor, e)))
    {
        let scene = |height: f64| Scene {
            floor,
            height,
            velocity: 0.0,
            across: 0.0,
            part,
            t0: 0.0,
            sign: 1.0,
            tolerance: 1e-10,
            method: Method::RungeKutta8,
        };
        let scenes = [1.0, 0.9, 0.8, 0.7, 0.6, 0.5, 0.4, 0.3, 0.2, 0.1, 1e-3].map(scene);
        let mut seen = 0;
        Ensemble::new(&Ball, scenes.map(|scene| scene.start()))
            .until(10.0)
            .events(|| vec![wall(2, floor, part)])
            .each(|body| {
                let scene = scenes[body.number as usize];
                scene.accumulated(body.end.err().unwrap_or_else(|| panic!("{scene:?}: arrives")).reason);
                seen += 1;
            })
            .unwrap();
        assert_eq!(seen, scenes.len());
    }
}

/// A floor that brakes the ball and lets it through, where heights and times have roundings that first steps may not leave.
#[test]
fn what_is_let_through_goes_on() {
    for (floor, t0) in [(1.0, 0.0), (100.0, 0.0), (1e6, 0.0), (0.0, 1e6), (1.0, 1e6)] {
        for (kept, method) in
            [1.0, 0.1, 1e-3].into_iter().flat_map(|kept| FALLING.map(|method| (kept, method)))
        {
            let label = format!("floor at {floor} from {t0}, {kept} of the velocity, {method:?}");
            let slowed =
                move |_: f64, point: &Point| thrown(point, [kept * point.p()[0], kept * point.p()[1]]);
            let start = ball([0.0, floor + 1.0], [0.0, 0.0]);
            let run = Simulation::new(&Ball, start)
                .from(t0)
                .until(t0 + 1.0)
                .method(method)
                .event(Event::position(2, floor).falling().change(slowed))
                .run()
                .unwrap_or_else(|halt| panic!("{label}: {halt}"));
            assert_eq!(run.events().len(), 1, "{label}");
            let fall = (2.0 / GRAVITY).sqrt();
            let (since, rate) = (1.0 - fall, GRAVITY * fall * kept);
            let depth = floor - run.end().1.x()[1];
            assert!((depth - since * (rate + 0.5 * GRAVITY * since)).abs() < 1e-5, "{label}: {depth}");
        }
    }
}

/// At rest on a floor without gravity, until another event throws it: up, and it goes; down, and it is on the floor again.
#[test]
fn what_rests_is_thrown_off_later() {
    for floor in [0.0, 0.1, 1.0, 100.0] {
        for method in [Method::ClosedForm, Method::RungeKutta8, Method::Gauss { stages: 2, step: 0.013 }] {
            for (rate, name) in [(0.5, "gate"), (-0.5, "floor")] {
                let label = format!("{floor} {rate} {method:?}");
                let kicked = move |_: f64, point: &Point| thrown(point, [point.p()[0], rate]);
                let run = Simulation::new(&Puck, puck([0.0, floor + 1.0], [1.0, -1.0]))
                    .method(method)
                    .until(5.0)
                    .event(wall(2, floor, 0.0).named("floor"))
                    .event(Event::position(1, 3.0).named("gate").change(kicked))
                    .run()
                    .unwrap_or_else(|halt| panic!("{label}: {halt}"));
                let names: Vec<&str> = run.events().iter().map(|event| event.name).collect();
                assert_eq!(
                    (names[..2].to_vec(), names.last()),
                    (vec!["floor", "gate"], Some(&name)),
                    "{label}"
                );
                let height = run.end().1.x()[1] - floor;
                let exact = if rate > 0.0 { 2.0 * rate } else { 0.0 };
                assert!((height - exact).abs() < 1e-9, "{label}: {height}");
            }
        }
    }
}
