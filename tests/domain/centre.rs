//! Central potentials at the centre, where `norm(x)` has no slope.

use affine_runtime::prelude::*;
use affine_runtime::simulate::Reason;

/// `x(1)` of `x'' = -slope(x)` from `x = 0` with the velocity 0.3, by the classical Runge-Kutta method. The slope is smooth as far
/// as the motion goes.
fn reference(slope: impl Fn(f64) -> f64) -> f64 {
    let (steps, h) = (2000, 1.0 / 2000.0);
    let rate = |(x, v): (f64, f64)| (v, -slope(x));
    let moved = |(x, v): (f64, f64), (of_x, of_v): (f64, f64), h: f64| (x + h * of_x, v + h * of_v);
    let mut at = (0.0, 0.3);
    for _ in 0..steps {
        let first = rate(at);
        let second = rate(moved(at, first, h / 2.0));
        let third = rate(moved(at, second, h / 2.0));
        let fourth = rate(moved(at, third, h));
        at = moved(moved(moved(moved(at, first, h / 6.0), second, h / 3.0), third, h / 3.0), fourth, h / 6.0);
    }
    at.0
}

/// By series too, where they are emitted: with tolerances below 1e-11 the automatic choice takes them, unless there are none.
macro_rules! from_the_centre {
    ($methods:expr; $(($($potential:tt)*) $slope:expr;)*) => { $( {
        #[affine_model(
            dim = 2,
            kinetic(dalembert = 1, space_translation = 1),
            potential = $($potential)*,
            emit(splitting, tangent, taylor)
        )]
        struct Body;
        let (zero, v) = (Vector::<2>::zeros(), Vector::<2>::new(0.18, 0.24));
        let start = Body.at_velocity(zero, Matrix::<2>::identity(), v, Matrix::<2>::zeros()).unwrap();
        for (method, bound) in [
            (Method::Automatic, 1e-10),
            (Method::RungeKutta8, 1e-10),
            (Method::Gauss { stages: 3, step: 0.01 }, 1e-10),
            (Method::Splitting { order: 4, step: 0.001 }, 1e-9),
        ]
        .into_iter()
        .chain($methods)
        {
            let run = Simulation::new(&Body, start).until(1.0).tolerance(1e-12).method(method).run();
            let x = run.unwrap().end().1.x();
            let expected = Vector::<2>::new(0.6, 0.8) * reference($slope);
            assert!((x - expected).norm() < bound, "{method:?} {}: {x} {expected}", stringify!($($potential)*));
        }
    } )* };
}

#[test]
fn whole_powers_have_their_slope() {
    from_the_centre! {
        None;
        (norm(x)^3) |r: f64| 3.0 * r * r.abs();
        (norm(x)^3 + norm(x)^2/2) |r: f64| 3.0 * r * r.abs() + r;
        (norm(x)^4 - norm(x)^5/5) |r: f64| 4.0 * r.powi(3) - r.powi(3) * r.abs();
    }
}

/// As the pages say to write them. The terms of such a root grow by `1e15` from order to order.
#[test]
fn smooth_functions_by_roots_that_do_not_vanish() {
    from_the_centre! {
        [4, 8, 12, 16, 20, 24, 32].map(|order| (Method::Taylor { order: Some(order) }, 1e-10));
        (1 - cos(sqrt(norm(x)^2 + 1e-30))) f64::sin;
        (cosh(sqrt(norm(x)^2 + 1e-30))) f64::sinh;
        (sqrt(norm(x)^2 + 1e-30)*tanh(sqrt(norm(x)^2 + 1e-30))) |r: f64| r.tanh() + r / r.cosh().powi(2);
        (sqrt(1 + norm(x)^2)) |r: f64| r / r.hypot(1.0);
    }
}

/// On the way through the centre, or next to it, a series of `norm(x) = x` goes on as `x < 0`, and none of its coefficients tells.
#[test]
fn series_do_not_go_on_beyond_the_centre() {
    #[affine_model(
        dim = 2,
        kinetic(dalembert = 1, space_translation = 1),
        potential = norm(x)^3,
        emit(taylor)
    )]
    struct Body;
    // The velocity along the axis at a place, by the energy `v^2/2 + |x|^3`.
    for off in [0.0, 1e-12, 1e-9] {
        let (x, v) = (Vector::<2>::new(0.5, off), Vector::<2>::new(-1.0, 0.0));
        let start = Body.at_velocity(x, Matrix::<2>::identity(), v, Matrix::<2>::zeros()).unwrap();
        let speed = |x: f64| -(2.0 * (0.5 + 0.125 - x.abs().powi(3))).sqrt();
        for (tolerance, bound) in [(1e-11, 1e-9), (1e-12, 1e-10), (1e-14, 1e-11)] {
            let run = Simulation::new(&Body, start).until(1.0).tolerance(tolerance).run().unwrap();
            let (_, end) = run.end();
            let (at, velocity) = (end.x()[0], Body.velocity(end).x_dot[0]);
            assert!(at < -0.5, "through the centre: {at}");
            assert!((velocity - speed(at)).abs() < bound, "{off:e} {tolerance:e}: {velocity} at {at}");
        }
    }
}

#[test]
fn other_functions_end_there() {
    #[affine_model(dim = 2, kinetic(dalembert = 1, space_translation = 1), potential = cosh(norm(x)))]
    struct Body;
    let (zero, v) = (Vector::<2>::zeros(), Vector::<2>::new(0.18, 0.24));
    let start = Body.at_velocity(zero, Matrix::<2>::identity(), v, Matrix::<2>::zeros()).unwrap();
    let halt = Simulation::new(&Body, start).until(1.0).run().unwrap_err();
    assert_eq!((halt.stop.reason, halt.stop.t), (Reason::NotFinite, 0.0));
    assert!(halt.to_string().contains("`norm(x)` at x = 0"), "{halt}");
}
