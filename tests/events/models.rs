//! Bodies whose centres and placements move as closed forms say.

use affine_runtime::prelude::*;

/// Its placement is a product of two exponentials.
#[affine_model(dim = 2, kinetic(casimir2 = 0.2, body_inertia = 1), emit(taylor, splitting))]
pub(crate) struct Disc;

/// Its centre falls on a parabola, and its placement follows a straight line.
#[affine_model(
    dim = 2,
    kinetic(dalembert = 1, space_translation = 1),
    potential = 9.81*x[2],
    emit(nystrom, splitting, taylor, lanes),
)]
pub(crate) struct Ball;

/// Its centre follows a straight line.
#[affine_model(dim = 2, kinetic(dalembert = 1, space_translation = 1), emit(taylor))]
pub(crate) struct Puck;

pub(crate) const GRAVITY: f64 = 9.81;

/// Of both of the bodies with a centre.
pub(crate) type Point = <Ball as Model<2>>::Point<f64>;

/// All that integrate [`Ball`].
pub(crate) const FALLING: [Method; 11] = [
    Method::Automatic,
    Method::RungeKutta8,
    Method::RungeKutta5,
    Method::Taylor { order: None },
    Method::RungeKuttaNystrom12,
    Method::RungeKuttaNystrom8,
    Method::Gauss { stages: 2, step: 0.01 },
    Method::Splitting { order: 2, step: 0.01 },
    Method::Splitting { order: 4, step: 0.02 },
    Method::AdaptiveSplitting { order: None },
    Method::Radau { stages: None },
];

fn placement() -> (Matrix<2>, Matrix<2>) {
    (Matrix::<2>::new(1.1, 0.2, -0.1, 0.95), Matrix::<2>::new(0.05, 0.02, -0.01, 0.04))
}

pub(crate) fn ball(x: [f64; 2], v: [f64; 2]) -> Point {
    let (phi, phi_dot) = placement();
    Ball.at_velocity(Vector::<2>::from(x), phi, Vector::<2>::from(v), phi_dot).unwrap()
}

pub(crate) fn puck(x: [f64; 2], v: [f64; 2]) -> Point {
    let (phi, phi_dot) = placement();
    Puck.at_velocity(Vector::<2>::from(x), phi, Vector::<2>::from(v), phi_dot).unwrap()
}

/// The same point with another velocity of the centre; both bodies have unit mass.
pub(crate) fn thrown(point: &Point, v: [f64; 2]) -> affine_runtime::Result<Point> {
    Ball.at_momentum(point.x(), *point.phi(), Vector::<2>::from(v), point.pi())
}

/// A wall at `x[i] = value`, from which the centre bounces with a part of its velocity.
pub(crate) fn wall(i: usize, value: f64, part: f64) -> Event<'static, 2, Point> {
    let bounced = move |_: f64, point: &Point| {
        let mut v = [point.p()[0], point.p()[1]];
        v[i - 1] *= -part;
        thrown(point, v)
    };
    Event::position(i, value).falling().change(bounced)
}
