//! Events that change the motion, and events in thousands: contact, corners, fast rotation.

use affine_runtime::prelude::*;
use affine_runtime::report::{Demand, Oracle, StabilityReport};
use affine_runtime::simulate::Reason;

use super::shared::scene;

/// Its centre falls on a parabola.
#[affine_model(dim = 2, kinetic(dalembert = 1, space_translation = 1), potential = 9.81*x[2])]
struct Ball;

/// Its centre follows a straight line.
#[affine_model(dim = 2, kinetic(dalembert = 1, space_translation = 1))]
struct Puck;

/// It turns with one frequency, or with two.
#[affine_model(dim = 2, kinetic(casimir2 = 0.2, body_inertia = 1), emit(splitting))]
struct Disc;

const GRAVITY: f64 = 9.81;
/// What times of contact are right to.
const TIME: f64 = 1e-6;

/// Of both of the bodies with a centre.
type Point = <Ball as Model<2>>::Point<f64>;

pub(super) fn cases(report: &mut StabilityReport) -> affine_runtime::Result<()> {
    report.heading("contact and fast rotation");
    for part in [0.0, 0.5] {
        let named =
            scene("falling ball", 2, format!("bounces with {part}"), "time of rest", Oracle::ClosedForm);
        report.case(named, Demand::Held(TIME), || comes_to_rest(part));
    }
    let named = scene("falling ball", 2, "bounces with 1".to_owned(), "centre", Oracle::ClosedForm);
    report.case(named, Demand::Held(TIME), bounces_on);
    let named =
        scene("falling ball", 2, "starts on the floor, downward".to_owned(), "centre", Oracle::ClosedForm);
    report.case(named, Demand::Held(TIME), leaves_the_floor);
    let named = scene("puck", 2, "two walls at once".to_owned(), "centre", Oracle::ClosedForm);
    report.case(named, Demand::Held(TIME), turns_in_a_corner);
    for (label, omega_hat, phi, count) in ROTATIONS {
        for method in [Method::Automatic, Method::RungeKutta8, Method::AdaptiveSplitting { order: None }] {
            let extreme = format!("{label}, {method:?}");
            let named = scene("body-metric", 2, extreme, "number of crossings", Oracle::ClosedForm);
            report.case(named, Demand::Held(0.0), || crossings(omega_hat, phi, count, method));
        }
    }
    Ok(())
}

/// Rows of `Omega_hat` and of `phi` at the start, and how often `phi_12` passes zero in ten units of time: `floor(10 w/pi)` where
/// the body turns rigidly, else as in 4e6 samples of the closed form.
const ROTATIONS: [(&str, [f64; 4], [f64; 4], usize); 3] = [
    ("w = 1e3", [0.0, 1e3, -1e3, 0.0], [1.0, 0.0, 0.0, 1.0], 3183),
    ("w = 50", [0.0, 50.0, -50.0, 0.0], [1.0, 0.0, 0.0, 1.0], 159),
    ("two frequencies", [100.0, 1e3, -800.0, -100.0], [1.1, 0.2, -0.1, 0.95], 2918),
];

fn placement() -> (Matrix<2>, Matrix<2>) {
    (Matrix::<2>::new(1.1, 0.2, -0.1, 0.95), Matrix::<2>::new(0.05, 0.02, -0.01, 0.04))
}

/// Centre and its velocity; both bodies have unit mass.
fn ball(x: [f64; 2], v: [f64; 2]) -> affine_runtime::Result<Point> {
    let (phi, phi_dot) = placement();
    Ball.at_velocity(Vector::<2>::from(x), phi, Vector::<2>::from(v), phi_dot)
}

/// A wall at `x[i] = 0`, from which the centre bounces with a part of its velocity.
fn wall(i: usize, part: f64) -> Event<'static, 2, Point> {
    Event::position(i, 0.0).falling().change(move |_, point: &Point| {
        let mut p = point.p();
        p[i - 1] *= -part;
        Ball.at_momentum(point.x(), *point.phi(), p, point.pi())
    })
}

/// From a height of 1: impacts accumulate at `t0 (1 + e)/(1 - e)`, with `t0 = sqrt(2/g)`.
fn comes_to_rest(part: f64) -> affine_runtime::Result<(f64, u64)> {
    let start = ball([0.0, 1.0], [0.5, 0.0])?;
    let halt = match Simulation::new(&Ball, start).until(3.0).event(wall(2, part)).run() {
        Ok(_) => return Ok((f64::INFINITY, 0)),
        Err(halt) => halt,
    };
    let rest = (2.0 / GRAVITY).sqrt() * (1.0 + part) / (1.0 - part);
    match halt.stop.reason {
        Reason::Accumulation { t, .. } => Ok(((t - rest).abs(), halt.trajectory.statistics().steps)),
        _ => Err(halt.into()),
    }
}

/// From a height of 1 with all of its velocity: impacts at `t0 (2 k + 1)`, three of them until 3.
fn bounces_on() -> affine_runtime::Result<(f64, u64)> {
    let run = Simulation::new(&Ball, ball([0.0, 1.0], [0.5, 0.0])?).until(3.0).event(wall(2, 1.0)).run()?;
    let fall = (2.0 / GRAVITY).sqrt();
    let since = 3.0 - 5.0 * fall;
    let exact = Vector::<2>::new(1.5, since * (GRAVITY * fall - 0.5 * GRAVITY * since));
    let error = if run.events().len() == 3 { (run.end().1.x() - exact).norm() } else { f64::INFINITY };
    Ok((error, run.statistics().steps))
}

/// An impact at the start turns the velocity around.
fn leaves_the_floor() -> affine_runtime::Result<(f64, u64)> {
    let run = Simulation::new(&Ball, ball([0.0, 0.0], [0.5, -1.0])?).until(0.1).event(wall(2, 1.0)).run()?;
    let exact = Vector::<2>::new(0.05, 0.1 - 0.5 * GRAVITY * 0.01);
    Ok(((run.end().1.x() - exact).norm(), run.statistics().steps))
}

/// Out of a corner a body comes back the way it went in.
fn turns_in_a_corner() -> affine_runtime::Result<(f64, u64)> {
    let (phi, phi_dot) = placement();
    let four = Vector::<2>::new(4.0, 4.0);
    let start = Puck.at_velocity(four, phi, Vector::<2>::new(-1.0, -1.0), phi_dot * 0.0)?;
    let run = Simulation::new(&Puck, start).until(8.0).event(wall(1, 1.0)).event(wall(2, 1.0)).run()?;
    Ok(((run.end().1.x() - four).norm(), run.statistics().steps))
}

fn crossings(
    omega_hat: [f64; 4],
    phi: [f64; 4],
    count: usize,
    method: Method,
) -> affine_runtime::Result<(f64, u64)> {
    let [omega_hat, phi] = [omega_hat, phi].map(|rows| Matrix::<2>::from_row_slice(&rows));
    let start = Disc.at_velocity(phi, phi * omega_hat)?;
    let zero = Event::new("zero", |_, point: &<Disc as Model<2>>::Point<f64>| point.phi()[(0, 1)]);
    let simulation = Simulation::new(&Disc, start).until(10.0).method(method).tolerance(1e-9);
    let run = simulation.output([10.0]).event(zero).run()?;
    Ok((run.events().len().abs_diff(count) as f64, run.statistics().steps))
}
