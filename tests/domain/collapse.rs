//! One motion into `det phi = 0` has one reason, whatever the method and the tolerance.

use affine_runtime::prelude::*;
use affine_runtime::simulate::{Reason, Stop};

#[affine_model(
    dim = 3,
    kinetic(flat_tensor = [
        [2.53, 0.09, -0.11, -0.01, 0.1, -0.05, 0.14, 0.06, -0.06],
        [0.09, 2.23, 0.13, 0.1, 0.09, 0.13, 0.06, -0.08, 0.05],
        [-0.11, 0.13, 2.27, -0.07, -0.04, -0.03, -0.14, 0.02, -0.03],
        [-0.01, 0.1, -0.07, 1.69, -0.06, -0.04, 0.09, 0.12, 0.07],
        [0.1, 0.09, -0.04, -0.06, 2.94, 0.14, 0.1, 0.11, 0.13],
        [-0.05, 0.13, -0.03, -0.04, 0.14, 2.84, -0.04, 0.15, 0],
        [0.14, 0.06, -0.14, 0.09, 0.1, -0.04, 2.25, 0.03, 0.03],
        [0.06, -0.08, 0.02, 0.12, 0.11, 0.15, 0.03, 2.24, -0.15],
        [-0.06, 0.05, -0.03, 0.07, 0.13, 0, 0.03, -0.15, 2.35]
    ]),
    potential = 0.29*tanh(q)^2,
    emit(taylor)
)]
struct Body;

/// The body, and how long it runs.
fn simulation() -> Simulation<'static, 3, Body> {
    let phi = Matrix::<3>::new(1.13, 0.04, -0.11, -0.08, 1.22, -0.13, -0.02, -0.24, 0.84);
    let phi_dot = Matrix::<3>::new(0.41, 0.11, -0.43, 0.31, -0.33, -0.53, 0.33, -0.56, 0.49);
    Simulation::new(&Body, Body.at_velocity(phi, phi_dot).unwrap()).until(2.0)
}

/// Where `det phi` vanishes, from states well before: Newton's method on the determinant of the dense output.
fn exact() -> f64 {
    let before = 1.8;
    let run = simulation().until(before).tolerance(1e-14).run().unwrap();
    let (phi, phi_dot) = (run.end().1.phi(), Body.velocity(run.end().1).phi_dot);
    // The force is small beside the inertia there, and the way short: a parabola by the acceleration.
    let later = simulation().until(before + 1e-3).tolerance(1e-14).run().unwrap();
    let acceleration = (Body.velocity(later.end().1).phi_dot - phi_dot) * 1e3;
    let at = |s: f64| phi + phi_dot * s + acceleration * (0.5 * s * s);
    let (mut good, mut bad) = (0.0, 0.2);
    for _ in 0..60 {
        let middle = 0.5 * (good + bad);
        *(if at(middle).determinant() > 0.0 { &mut good } else { &mut bad }) = middle;
    }
    before + good
}

#[test]
fn one_reason() {
    let exact = exact();
    let mut stops: Vec<(String, Stop, f64)> = Vec::new();
    for tolerance in [1e-3, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14] {
        let methods =
            [Method::Automatic, Method::RungeKutta8, Method::RungeKutta5, Method::Taylor { order: None }];
        for method in methods {
            let halt = simulation().tolerance(tolerance).method(method).run().unwrap_err();
            stops.push((format!("{method:?} at {tolerance:e}"), halt.stop, 2e-3));
        }
    }
    for (stages, step) in [(2, 0.01), (3, 0.003), (6, 0.05)] {
        let halt = simulation().method(Method::Gauss { stages, step }).run().unwrap_err();
        // An equal step that fails tells where it began.
        stops.push((format!("Gauss {stages} by {step}"), halt.stop, 2e-3 + step));
    }
    for (label, stop, near) in stops {
        let Reason::Placement { determinant, rate, t } = stop.reason else { panic!("{label}: {stop}") };
        assert!((t - exact).abs() < near, "{label}: {t} {exact}");
        let rate = rate.unwrap_or(f64::NAN);
        assert!(rate < -0.1 && rate > -100.0, "{label}: {rate}");
        assert!(determinant.abs() < 2.0 * near * rate.abs(), "{label}: {determinant:e} {rate}");
    }
}

/// `det phi = (1 - t)^2` is zero once, and positive before and after: what is said of it is true of it.
#[test]
fn a_determinant_that_touches_zero() {
    #[affine_model(dim = 2, kinetic(dalembert = 1))]
    struct Free;
    let start = Free.at_velocity(Matrix::<2>::identity(), -Matrix::<2>::identity()).unwrap();
    for (method, words) in
        [(Method::Automatic, "det phi = 0 at t = 1"), (Method::RungeKutta8, "and may vanish next to it")]
    {
        let halt = Simulation::new(&Free, start).until(10.0).method(method).run().unwrap_err();
        let Reason::Placement { determinant, t, .. } = halt.stop.reason else { panic!("{halt}") };
        let said = halt.to_string();
        assert!((0.0..1e-30).contains(&determinant) && (t - 1.0).abs() < 1e-14, "{said}");
        assert!(said.contains(words) && !said.contains("not positive from"), "{method:?}: {said}");
    }
}
