//! Series with gaps: in a potential `x^k`, from `x = 0`, `k - 1` of `k` coefficients vanish, the last two perhaps.

use affine_runtime::prelude::*;

/// Tolerances that the errors of all steps make up together.
const TOLERANCES: f64 = 30.0;
/// What is left at the smallest tolerances.
const ROUNDING: f64 = 1e-14;

/// The time after which a body of mass 1 in the potential `x^k` is at `x`, that of `x = 0` and the velocity `v` being 0:
/// `t = int_0^x du/sqrt(v^2 - 2 u^k)`, by the binomial series of the root, before the body turns.
fn time(x: f64, v: f64, k: i32) -> f64 {
    let part = 2.0 * x.powi(k) / (v * v);
    assert!((0.0..0.9).contains(&part), "the series converges: {part}");
    let (mut sum, mut binomial) = (0.0, 1.0);
    for n in 0..400 {
        let n = f64::from(n);
        sum += binomial / (f64::from(k) * n + 1.0);
        binomial *= part * (n + 0.5) / (n + 1.0);
    }
    sum * x / v
}

/// The times that a run of velocity `v` takes: before `2 x^k = 0.8 v^2`.
fn times(v: f64, k: i32) -> [f64; 3] {
    let furthest = (0.4 * v * v).powf(1.0 / f64::from(k));
    [0.3, 0.8, 1.0].map(|part| time(part * furthest, v, k))
}

fn is_where_it_is<const N: usize, M: Model<N>>(model: &M, start: M::Point<f64>, (v, k): (f64, i32)) {
    let run = |t: f64, tolerance: f64, method: Method| {
        Simulation::new(model, start).until(t).tolerance(tolerance).method(method).run()
    };
    let is_there = |t: f64, tolerance: f64, method: Method| {
        let run = run(t, tolerance, method).unwrap_or_else(|halt| panic!("{k} {v} {method:?}: {halt}"));
        let off = (time(run.end().1.x()[0], v, k) - t).abs() / t;
        let bound = TOLERANCES * tolerance + ROUNDING;
        assert!(off < bound, "x^{k} from {v} to {t}, {method:?} at {tolerance:e}: {off:e}");
        run.statistics().steps
    };
    for t in times(v, k) {
        for tolerance in [1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-13, 1e-14] {
            let steps = is_there(t, tolerance, Method::Taylor { order: None });
            assert!(steps < 40, "x^{k} from {v} to {t} at {tolerance:e}: {steps} steps");
            is_there(t, tolerance, Method::Automatic);
        }
        for order in [3, 4, 5, 6, 7, 8, 9, 12, 15, 16, 20, 24, 32] {
            is_there(t, 1e-8, Method::Taylor { order: Some(order) });
        }
    }
}

macro_rules! powers {
    ($($planar:ident $spatial:ident $moving:ident $k:literal;)*) => {
        $(
            #[affine_model(
                dim = 2,
                kinetic(dalembert = 1, space_translation = 1),
                potential = x[1]^$k,
                emit(taylor)
            )]
            struct $planar;

            #[affine_model(
                dim = 3,
                kinetic(dalembert = 1, space_translation = 1),
                potential = x[1]^$k,
                emit(taylor)
            )]
            struct $spatial;

            #[affine_model(
                dim = 2,
                kinetic(dalembert = 1, space_translation = 1),
                potential = x[1]^$k + (tr(G) - 2)^2,
                emit(taylor)
            )]
            struct $moving;
        )*

        #[test]
        fn powers_from_zero() {
            let (x, phi) = (Vector::<2>::zeros(), Matrix::<2>::identity());
            for v in [0.1, 0.3, 1.0] {
                let velocity = Vector::<2>::new(v, 0.0);
                $(
                    let start = $planar.at_velocity(x, phi, velocity, Matrix::zeros()).unwrap();
                    is_where_it_is(&$planar, start, (v, $k));
                )*
            }
        }

        #[test]
        fn powers_from_zero_in_space() {
            let (x, phi) = (Vector::<3>::zeros(), Matrix::<3>::identity());
            let velocity = Vector::<3>::new(0.5, 0.0, 0.0);
            $(
                let start = $spatial.at_velocity(x, phi, velocity, Matrix::zeros()).unwrap();
                is_where_it_is(&$spatial, start, (0.5, $k));
            )*
        }

        /// The placement vibrates, and its coefficients hide that those of the position vanish.
        #[test]
        fn powers_beside_a_vibration() {
            let (x, phi) = (Vector::<2>::zeros(), Matrix::<2>::new(1.1, 0.0, 0.1, 0.95));
            let velocity = Vector::<2>::new(0.5, 0.0);
            $(
                let start = $moving.at_velocity(x, phi, velocity, Matrix::zeros()).unwrap();
                is_where_it_is(&$moving, start, (0.5, $k));
            )*
        }

        /// Next to zero nothing vanishes, and the last two coefficients are small all the same.
        #[test]
        fn powers_from_next_to_zero() {
            for off in [1e-12, 1e-9, 1e-6, 1e-3] {
                $(
                    let (x, v) = (Vector::<2>::new(off, 0.0), Vector::<2>::new(0.5, 0.0));
                    let start = $planar.at_velocity(x, Matrix::identity(), v, Matrix::zeros()).unwrap();
                    let energy = $planar.hamiltonian(0.0, &start);
                    // In an odd power a body that has turned never stops.
                    let until = if $k % 2 == 0 { 20.0 } else { times(0.5, $k)[2] };
                    for tolerance in [1e-6, 1e-8, 1e-10, 1e-12, 1e-14] {
                        let method = Method::Taylor { order: None };
                        let run = Simulation::new(&$planar, start).until(until).tolerance(tolerance);
                        let run = run.method(method).run().unwrap();
                        let end = $planar.hamiltonian(until, run.end().1);
                        let error = (end - energy).abs() / energy;
                        let bound = TOLERANCES * tolerance * run.statistics().steps as f64;
                        assert!(error < bound + ROUNDING, "x^{} {off:e} {tolerance:e}: {error:e}", $k);
                    }
                )*
            }
        }

        #[test]
        fn at_rest_at_zero() {
            let (x, phi) = (Vector::<2>::zeros(), Matrix::<2>::identity());
            $(
                let start = $planar.at_velocity(x, phi, x, Matrix::zeros()).unwrap();
                let run = Simulation::new(&$planar, start).until(50.0).tolerance(1e-12).run().unwrap();
                assert_eq!((*run.end().1, run.statistics().steps), (start, 1));
            )*
        }
    };
}

powers! {
    Third ThirdInSpace ThirdMoving 3;
    Fourth FourthInSpace FourthMoving 4;
    Fifth FifthInSpace FifthMoving 5;
    Sixth SixthInSpace SixthMoving 6;
    Seventh SeventhInSpace SeventhMoving 7;
    Eighth EighthInSpace EighthMoving 8;
    Ninth NinthInSpace NinthMoving 9;
}

/// `x'' = -t^6`: a force that is not there yet, and a work whose series ends later than those of the motion.
#[test]
fn a_force_that_grows_with_time() {
    #[affine_model(
        dim = 2,
        kinetic(dalembert = 1, space_translation = 1),
        potential = t^6*x[1],
        emit(taylor)
    )]
    struct Late;

    let (x, v) = (Vector::<2>::zeros(), Vector::<2>::new(0.3, 0.0));
    let start = Late.at_velocity(x, Matrix::identity(), v, Matrix::zeros()).unwrap();
    for (tolerance, order) in [1e-4, 1e-6, 1e-8, 1e-12]
        .map(|tolerance| (tolerance, None))
        .into_iter()
        .chain([4, 5, 6, 7, 8, 9, 12, 15, 16, 20].map(|order| (1e-8, Some(order))))
    {
        let run = Simulation::new(&Late, start).until(4.0).tolerance(tolerance);
        let run = run.method(Method::Taylor { order }).run().unwrap();
        // x = v t - t^8/56.
        let exact = 0.3 * 4.0 - 4.0_f64.powi(8) / 56.0;
        let error = (run.end().1.x()[0] - exact).abs() / exact.abs();
        assert!(error < TOLERANCES * tolerance, "{tolerance:e} {order:?}: {error:e}");
        let balance = run.power_balance().unwrap();
        assert!(balance.relative() < TOLERANCES * tolerance, "{tolerance:e} {order:?}: {balance}");
    }
}

/// `s(t)` of `s'' = -u(t)/(2 s)` from `s = 1` at rest, by the classical Runge-Kutta method: what `T = tr(phi'^T phi')/2` and the
/// potential `u(t) q`, `q = ln(s)`, make of `phi = s 1` in the plane.
fn swelling(u: impl Fn(f64) -> f64, t_end: f64) -> f64 {
    let steps = 2000;
    let h = t_end / f64::from(steps);
    let rate = |t: f64, (s, v): (f64, f64)| (v, -u(t) / (2.0 * s));
    let moved = |(s, v): (f64, f64), (of_s, of_v): (f64, f64), h: f64| (s + h * of_s, v + h * of_v);
    let mut at = (1.0, 0.0);
    for step in 0..steps {
        let t = h * f64::from(step);
        let first = rate(t, at);
        let second = rate(t + h / 2.0, moved(at, first, h / 2.0));
        let third = rate(t + h / 2.0, moved(at, second, h / 2.0));
        let fourth = rate(t + h, moved(at, third, h));
        at = moved(moved(moved(moved(at, first, h / 6.0), second, h / 3.0), third, h / 3.0), fourth, h / 6.0);
    }
    at.0
}

/// The work of such a force begins with a higher power of `t` than a series of low order has.
#[test]
fn forces_that_begin_as_a_power_of_time() {
    macro_rules! at_rest {
        ($(($($potential:tt)*) $u:expr;)*) => { $( {
            #[affine_model(dim = 2, kinetic(dalembert = 1), potential = $($potential)*, emit(taylor))]
            struct Body;
            let start = Body.at_velocity(Matrix::identity(), Matrix::zeros()).unwrap();
            for (order, steps) in [(4, 20_000), (5, 2000), (6, 500), (7, 300), (8, 100), (12, 30), (30, 10)] {
                let method = Method::Taylor { order: Some(order) };
                let run = Simulation::new(&Body, start).until(0.5).tolerance(1e-12).method(method).run().unwrap();
                let off = run.end().1.phi() - Matrix::<2>::identity() * swelling($u, 0.5);
                assert!(off.norm() < TOLERANCES * 1e-12, "{} by order {order}: {off}", stringify!($($potential)*));
                assert!(run.statistics().steps < steps, "order {order}: {:?}", run.statistics());
            }
        } )* };
    }
    at_rest! {
        ((1 - cos(t))^2*q) |t: f64| (1.0 - t.cos()).powi(2);
        (sin(t)^3*q) |t: f64| t.sin().powi(3);
        (tan(t)^3*q) |t: f64| t.tan().powi(3);
    }
}
