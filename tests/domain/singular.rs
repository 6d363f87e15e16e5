//! Motions into the singularities of their potentials.

use affine_runtime::model::Bound;
use affine_runtime::prelude::*;
use affine_runtime::simulate::{Reason, Stop};

const TOLERANCES: [f64; 5] = [1e-2, 1e-3, 1e-6, 1e-10, 1e-13];

/// The part of the potential, its argument, the value and the time.
fn left(stop: &Stop) -> (&'static str, &'static str, f64, f64) {
    match stop.reason {
        Reason::Domain { guard, value, t } => (guard.part, guard.argument, value, t),
        _ => panic!("{stop}"),
    }
}

#[affine_model(
    dim = 2,
    kinetic(casimir2 = 0.2, body_inertia = 1),
    potential = 0.1*ln(q) + q^2,
    emit(taylor, splitting)
)]
struct Logarithm;

/// The dilatation moves by itself: `n (I + A) q'' = -dU/dq`, and reaches `q = 0` after the time of a quadrature over its energy.
#[affine_model(
    dim = 3,
    kinetic(casimir2 = 0.2, body_inertia = 1),
    potential = 0.1*ln(q) + 0.1*(tr(G)*exp(-2*q) - n) + q^2,
    emit(taylor, lanes)
)]
struct Shearing;

#[test]
fn starts_outside() {
    for method in [
        Method::Automatic,
        Method::RungeKutta8,
        Method::RungeKutta5,
        Method::Taylor { order: None },
        Method::Gauss { stages: 2, step: 0.01 },
        Method::Splitting { order: 4, step: 0.01 },
    ] {
        let start = Logarithm.at_velocity(Matrix::<2>::identity() * 0.9, Matrix::<2>::zeros()).unwrap();
        let halt = Simulation::new(&Logarithm, start).until(1.0).method(method).run().unwrap_err();
        let (part, argument, value, t) = left(&halt.stop);
        assert_eq!((part, argument, t), ("ln(q)", "q", 0.0), "{method:?}");
        assert!((value - 0.9_f64.ln()).abs() < 1e-15);
        assert!(halt.to_string().contains("`ln(q)`") && halt.trajectory.is_empty(), "{halt}");
    }
}

/// `t` at which `m q''/2 + 0.1 ln q + q^2 = E` comes from `q0` to 0 with the rate `-v`: in `s = sqrt(q)`, where the integrand is
/// smooth but for its logarithm, by the midpoint rule.
fn time_to_zero(m: f64, q0: f64, v: f64) -> f64 {
    let u = |q: f64| 0.1 * q.ln() + q * q;
    let energy = 0.5 * m * v * v + u(q0);
    let parts = 2_000_000;
    let h = q0.sqrt() / f64::from(parts);
    let rate = |q: f64| (2.0 * (energy - u(q)) / m).sqrt();
    (0..parts).map(|k| (f64::from(k) + 0.5) * h).map(|s| 2.0 * s / rate(s * s) * h).sum()
}

#[test]
fn a_logarithm_on_the_way() {
    let (scale, speed) = (1.3, 1.0);
    let start =
        Shearing.at_velocity(Matrix::<3>::identity() * scale, Matrix::<3>::identity() * -speed).unwrap();
    let expected = time_to_zero(3.0 * 1.2, scale.ln(), speed / scale);
    for tolerance in TOLERANCES {
        let halt = Simulation::new(&Shearing, start).until(1.0).tolerance(tolerance).run().unwrap_err();
        let (part, argument, value, t) = left(&halt.stop);
        assert_eq!((part, argument), ("ln(q)", "q"), "{halt}");
        // A start at half of the tolerance's digits: the rate grows as the logarithm's root alone.
        let error = (t - expected).abs();
        assert!(error < 20.0 * tolerance + 1e-9, "{tolerance:e}: {t} {expected}");
        assert!(value < 1e-6 && halt.trajectory.energies().iter().all(|energy| energy.is_finite()));
    }
    let ends = Ensemble::new(&Shearing, vec![start; 3]).until(1.0).tolerance(1e-6).run().unwrap();
    let alone = Simulation::new(&Shearing, start).until(1.0).tolerance(1e-6).output([]);
    let alone = alone.method(Method::RungeKutta8).run().unwrap_err().stop;
    assert!(ends.iter().all(|end| end.as_ref().is_err_and(|stop| *stop == alone)), "{ends:?}");
}

/// `x'' = -1/x^2` from rest at 1: the centre is reached after `pi/sqrt 8`, and later by less with a push.
#[test]
fn a_pole_head_on() {
    #[affine_model(dim = 2, kinetic(dalembert = 1, space_translation = 1), potential = -1/x[1])]
    struct Falling;
    let at = |speed: f64| {
        let (x, v) = (Vector::<2>::new(1.0, 0.0), Vector::<2>::new(-speed, 0.0));
        Falling.at_velocity(x, Matrix::<2>::identity(), v, Matrix::<2>::zeros()).unwrap()
    };
    let exact = core::f64::consts::PI / 8.0_f64.sqrt();
    for tolerance in TOLERANCES {
        let run = |start| Simulation::new(&Falling, start).until(2.0).tolerance(tolerance).run().unwrap_err();
        let (part, argument, value, t) = left(&run(at(0.0)).stop);
        assert_eq!((part, argument), ("-1/x[1]", "x[1]"));
        assert!(
            value.abs() < 0.1 && (t - exact).abs() < 0.2 * tolerance.powf(0.5) + 1e-6,
            "{tolerance:e}: {value:e} {t}"
        );
        let (.., sooner) = left(&run(at(0.5)).stop);
        assert!(sooner < t, "{sooner} {t}");
    }
}

/// A wall that a step jumps over, at 1 from the start and with the speed 1.
#[test]
fn a_wall_that_is_thinner_than_a_step() {
    #[affine_model(dim = 2, kinetic(casimir2 = 0.2, body_inertia = 1), potential = a/q^2)]
    struct Wall {
        a: f64,
    }
    for (a, tolerance) in [(1e-8, 1e-3), (1e-12, 1e-6), (1e-16, 1e-3)] {
        let model = Wall { a }.prepare().unwrap();
        let phi = Matrix::<2>::identity() * 1.0_f64.exp();
        let start = model.at_velocity(phi, -phi).unwrap();
        let halt = Simulation::new(&model, start).until(2.0).tolerance(tolerance).run().unwrap_err();
        let (part, argument, value, t) = left(&halt.stop);
        assert_eq!((part, argument), ("a/q^2", "q"));
        assert!(value <= 0.0 && (t - 1.0).abs() < 1e-3, "{value:e} {t}");
    }
    // A wall that steps see is one.
    let model = Wall { a: 0.1 }.prepare().unwrap();
    let phi = Matrix::<2>::identity() * 1.0_f64.exp();
    let start = model.at_velocity(phi, -phi).unwrap();
    for tolerance in TOLERANCES {
        let run = Simulation::new(&model, start).until(3.0).tolerance(tolerance).run().unwrap();
        let q = run.end().1.mean_log_stretch();
        assert!(q > 1.0 && run.conservation().worst() < 10.0 * tolerance, "{tolerance:e}: {q}");
    }
}

/// Backward in time too, with what happens before the end.
#[test]
fn events_before_the_end_happen() {
    let start = Logarithm.at_velocity(Matrix::<2>::identity() * 1.3, Matrix::<2>::identity()).unwrap();
    let half = Event::new("half", |_, point: &<Logarithm as Model<2>>::Point<f64>| {
        point.mean_log_stretch() - 0.5 * 1.3_f64.ln()
    });
    let halt = Simulation::new(&Logarithm, start).until(-2.0).event(half).tolerance(1e-6).run().unwrap_err();
    let (_, _, _, t) = left(&halt.stop);
    assert_eq!(halt.trajectory.events().len(), 1);
    let met = halt.trajectory.events()[0].t;
    assert!(t < met && met < 0.0, "{t} {met}");
    let guard = match halt.stop.reason {
        Reason::Domain { guard, .. } => guard,
        other => panic!("{other}"),
    };
    assert_eq!(guard.bound, Bound::Positive);
}
