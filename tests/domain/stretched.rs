//! Bodies that are stretched without bound in a finite time: no collapse, and no mass matrix that degenerates.

use affine_runtime::prelude::*;
use affine_runtime::simulate::Reason;

/// Torn apart along one axis, with a part of the mass matrix that falls as the body grows.
#[affine_model(
    dim = 3,
    kinetic(casimir2 = c, dalembert = diag(5/6, 4/6, 0.65)),
    potential = -0.23*tr((G - 1)^2),
    dissipation(dalembert = diag(1.51, 1.12, 1.34), body_inertia = diag(1.41, 0.65, 1.04))
)]
struct Torn {
    c: f64,
}

/// The same in the plane and beside a positive part.
#[affine_model(
    dim = 2,
    kinetic(dalembert = diag(1, 0.7), casimir2 = 0.1),
    potential = -0.5*tr((G - 1)^2),
    dissipation(dalembert = diag(1.5, 1.1), body_inertia = 1)
)]
struct Planar;

/// Torn apart at a constant volume.
#[affine_model(dim = 3, constraint = isochoric, hamiltonian(casimir2 = 1.26, spin_squared = 0.86), potential = -1.05*tr(G))]
struct Thread;

/// The run ends typed after few steps, by a body that is stretched far and has not collapsed.
fn is_torn<const N: usize, M: Model<N>>(name: &str, model: &M, start: M::Point<f64>, stretched: f64) {
    for tolerance in [1e-6, 4.22e-7, 7.5e-8, 1e-9, 7.5e-11, 1e-11] {
        for method in [Method::RungeKutta8, Method::RungeKutta5] {
            let label = format!("{name} {method:?} at {tolerance:e}");
            let run =
                Simulation::new(model, start).until(20.0).tolerance(tolerance).method(method).output([]);
            let halt = run.run().unwrap_err();
            let (stop, end) = (halt.stop, halt.trajectory.end().1);
            let typed = matches!(stop.reason, Reason::Distortion { .. } | Reason::StepUnderflow { .. });
            assert!(typed, "{label}: {stop}");
            let q = end.phi().log_stretches();
            let [least, most] = [f64::min, f64::max].map(|choice| q.into_iter().reduce(choice).unwrap());
            assert!((most - least).exp() > stretched, "{label}: {q:?}");
            assert!(stop.steps <= 8192, "{label}: {stop}");
        }
    }
}

#[test]
fn a_body_that_is_torn_apart_has_not_collapsed() {
    let torn = Torn { c: -0.05 }.prepare().unwrap();
    let phi = Matrix::<3>::new(0.75, -0.23, -0.43, 0.21, 0.99, 0.05, 0.14, -0.1, 1.47);
    let rate = Matrix::<3>::new(0.05, 0.85, -0.8, 0.2, 0.51, 0.13, 0.58, -1.14, 1.63);
    is_torn("torn", &torn, torn.at_velocity(phi, rate).unwrap(), 1e5);
    let (phi, rate) = (Matrix::<2>::new(1.4, 0.2, -0.1, 0.9), Matrix::<2>::new(0.3, -0.3, 0.2, 0.2));
    let start = Planar.at_velocity(phi, rate).unwrap();
    is_torn("planar", &Planar, start, 1e5);
}

#[test]
fn a_thread_that_becomes_ever_thinner_ends() {
    let phi = Matrix::<3>::new(1.2, 0.2, 0.1, -0.2, 0.95, 0.3, 0.1, 0.2, 0.9);
    let phi = phi / phi.determinant().cbrt();
    let rate = phi * Matrix::<3>::new(0.1, -0.3, 0.3, 0.4, -0.2, -0.2, 0.1, -0.1, 0.1);
    let start = Thread.at_velocity(phi, rate).unwrap();
    is_torn("thread", &Thread, start, 1e4);
    let mut flow = Flow::by(Method::RungeKutta8, &Thread, (0.0, start)).unwrap();
    let stop = flow.advance_to(2.0).unwrap_err();
    assert!(matches!(stop.reason, Reason::Distortion { .. }) && stop.steps <= 8192, "{stop}");
}

/// Times near the end do not tell how a body grows, and rounding does not tell whether `det phi` falls: that is no collapse.
#[test]
fn a_body_that_grows_beyond_what_times_tell_has_not_collapsed() {
    #[affine_model(dim = 2, kinetic(dalembert = diag(1, 0.7), casimir2 = 0.1), potential = -0.5*tr((G - 1)^2))]
    struct Growing;
    let mut state = 1_u64;
    let mut uniform = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    };
    for number in 0..150 {
        let phi = Matrix::<2>::identity() * 1.3 + Matrix::<2>::from_fn(|_, _| 0.4 * uniform());
        let rate = Matrix::<2>::from_fn(|_, _| 2.0 * uniform());
        let start = Growing.at_velocity(phi, rate).unwrap();
        let run = Simulation::new(&Growing, start).until(20.0).tolerance(1e-10).output([]);
        let halt = run.method(Method::RungeKutta8).run().unwrap_err();
        let grown = halt.trajectory.end().1.phi().norm();
        assert!(matches!(halt.stop.reason, Reason::StepUnderflow { .. }) && grown > 1e6, "{number}: {halt}");
    }
}
