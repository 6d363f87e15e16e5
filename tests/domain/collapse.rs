//! One motion into `det phi = 0` has one reason, whatever the method and the tolerance, also where rounding hides the mass matrix of a
//! sum before.

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

/// A sum whose mass matrix is positive definite at every placement, and known to be.
#[affine_model(dim = 2, kinetic(body_inertia = 1, dalembert = 1), potential = -0.5*tr(G^-1))]
struct Sum;

/// The same with a field, so that runs look after the mass matrix.
#[affine_model(dim = 2, kinetic(body_inertia = k, dalembert = 1), potential = -0.5*k*tr(G^-1))]
struct Watched {
    k: f64,
}

/// In space.
#[affine_model(dim = 3, kinetic(body_inertia = k, dalembert = 1), potential = -0.5*k*tr(G^-1))]
struct Solid {
    k: f64,
}

const METHODS: [Method; 4] =
    [Method::Automatic, Method::RungeKutta8, Method::RungeKutta5, Method::Radau { stages: None }];

/// `phi = U diag(a_1 + c_1 t, ...) V` with rotations and `c_i = 1` or `-1` is a motion: `T + U = sum (1 + 1/a^2) a'^2/2 - 1/(2 a^2)` is
/// a sum over the axes, each term of which is 1/2.
fn turned<const N: usize>(diagonal: Vector<N>) -> Matrix<N> {
    let mut turn = [Matrix::<N>::identity(), Matrix::<N>::identity()];
    for (turn, angle) in turn.iter_mut().zip([0.7_f64, -1.1]) {
        for k in 1..N {
            let (mut plane, angle) = (Matrix::<N>::identity(), angle * k as f64);
            (plane[(0, 0)], plane[(k, k)]) = (angle.cos(), angle.cos());
            (plane[(0, k)], plane[(k, 0)]) = (-angle.sin(), angle.sin());
            *turn *= plane;
        }
    }
    turn[0] * Matrix::<N>::from_fn(|i, k| if i == k { diagonal[i] } else { 0.0 }) * turn[1]
}

fn ends_at<const N: usize, M: Model<N>>(
    name: &str,
    model: &M,
    methods: &[Method],
    at: impl Fn(Matrix<N>, Matrix<N>) -> affine_runtime::Result<M::Point<f64>>,
) {
    let (exact, mut diagonal, mut rates) =
        (1.1, Vector::<N>::from_element(0.9), Vector::<N>::from_element(1.0));
    (diagonal[0], rates[0]) = (exact, -1.0);
    for sign in [1.0, -1.0] {
        let start = at(turned(diagonal), turned(rates * sign)).unwrap();
        for (tolerance, method) in [1e-4, 1e-8, 1e-11].iter().flat_map(|t| methods.iter().map(|m| (*t, *m))) {
            let label = format!("{name} {sign} {method:?} at {tolerance:e}");
            let run = Simulation::new(model, start).until(20.0 * sign).tolerance(tolerance).method(method);
            let stop = run.run().unwrap_err().stop;
            let Reason::Placement { determinant, rate, t } = stop.reason else { panic!("{label}: {stop}") };
            assert!((t - exact * sign).abs() < 2e-6 + 10.0 * tolerance, "{label}: {t}");
            // The others have grown to 2 by then; the velocity has few digits left.
            let expected = -sign * 2.0_f64.powi(N as i32 - 1);
            assert!(rate.is_some_and(|rate| (rate / expected - 1.0).abs() < 0.5), "{label}: {stop}");
            assert!(determinant.abs() < 1e-5, "{label}: {determinant:e}");
            assert!(stop.steps <= 10_000, "{label}: {stop}");
        }
        let mut flow = Flow::new(model, (0.0, start)).unwrap();
        let stop = flow.advance_to(20.0 * sign).unwrap_err();
        assert!(matches!(stop.reason, Reason::Placement { .. }), "{name} {sign}: {stop}");
    }
}

#[test]
fn sums_collapse_as_others_do() {
    ends_at("sum", &Sum, &METHODS, |phi, rate| Sum.at_velocity(phi, rate));
    let watched = Watched { k: 1.0 }.prepare().unwrap();
    ends_at("watched", &watched, &METHODS, |phi, rate| watched.at_velocity(phi, rate));
    let solid = Solid { k: 1.0 }.prepare().unwrap();
    ends_at("solid", &solid, &METHODS[..3], |phi, rate| solid.at_velocity(phi, rate));
}

/// Its velocities grow on the way into the collapse, and with them what rounding of the mass matrix makes of them.
#[affine_model(
    dim = 2,
    kinetic(body_inertia = 1, space_tensor = [[1.5, 0.1, 0, 0], [0.1, 1, 0, 0], [0, 0, 1.2, 0], [0, 0, 0, 1.1]]),
    potential = -0.5*tr(G^-1)
)]
struct Whirling;

#[test]
fn steps_that_rounding_makes_short_end_before_a_collapse() {
    let (phi, rate) = (Matrix::<2>::new(1.1, 0.2, -0.1, 0.9), Matrix::<2>::new(-0.1, -0.3, 0.2, -0.2));
    let start = Whirling.at_velocity(phi, rate).unwrap();
    let run = |until: f64, tolerance: f64, method: Method| {
        Simulation::new(&Whirling, start).until(until).tolerance(tolerance).method(method).output([]).run()
    };
    let mut times = Vec::new();
    for (tolerance, method) in [1e-6, 1e-9, 1e-11].iter().flat_map(|t| METHODS.map(|m| (*t, m))) {
        let stop = run(20.0, tolerance, method).unwrap_err().stop;
        let Reason::Placement { t, .. } = stop.reason else { panic!("{method:?} at {tolerance:e}: {stop}") };
        assert!(stop.steps <= 8192, "{method:?} at {tolerance:e}: {stop}");
        times.push(t);
    }
    let [least, most] = [f64::min, f64::max].map(|choice| times.iter().copied().reduce(choice).unwrap());
    assert!(most - least < 2e-6, "{times:?}");

    // To an end that they lead to, the same steps go on past where they are looked at.
    let run = run(1.703_148_3, 1e-11, Method::RungeKutta8).unwrap();
    assert!(run.statistics().steps > 4096 && run.end().0 > least, "{:?} {least}", run.statistics());
}

/// A body that is nearly flat once in a while and bounces back goes on.
#[test]
fn a_flat_body_that_bounces_goes_on() {
    /// `U = -1/(2 a^2) + e/(2 a^4)` of each stretch.
    #[affine_model(
        dim = 2,
        kinetic(body_inertia = k, dalembert = 1),
        potential = -0.5*k*tr(G^-1) + 0.5*e*(tr(G^-1)^2 - 2/I2) + 0.5*tr(G)
    )]
    struct Bouncing {
        k: f64,
        e: f64,
    }
    let model = Bouncing { k: 1.0, e: 1e-8 }.prepare().unwrap();
    let start =
        model.at_velocity(turned(Vector::<2>::new(1.1, 0.9)), turned(Vector::<2>::new(-1.0, 0.3))).unwrap();
    let mut flattest = f64::INFINITY;
    let run = Simulation::new(&model, start)
        .until(10.0)
        .tolerance(1e-10)
        .observe(|_, point| {
            let q = point.phi().log_stretches();
            flattest = flattest.min((q[0] - q[1]).abs().exp().recip());
            core::ops::ControlFlow::Continue(())
        })
        .run()
        .unwrap();
    assert!(flattest < 1.5e-4, "{flattest:e}");
    assert!(run.statistics().steps > 1024, "{:?}", run.statistics());
}

/// A free conformal body in the plane shrinks to a point, where its determinant has a zero without a change of sign. Taylor steps
/// are in the space around the group, and say so.
#[test]
fn a_conformal_body_shrinks_to_a_point() {
    #[affine_model(
        dim = 2,
        constraint = conformal,
        kinetic(dalembert = 1),
        dissipation(dalembert = r),
        emit(taylor)
    )]
    struct Shrinking {
        r: f64,
    }
    let (phi, taylor) = (Matrix::<2>::identity(), Method::Taylor { order: None });
    for r in [0.0, 0.5] {
        let model = Shrinking { r }.prepare().unwrap();
        let start = model.at_velocity(phi, -phi).unwrap();
        // `a' = -exp(-r t)`
        let exact = if r == 0.0 { 1.0 } else { -(1.0 - r).ln() / r };
        for tolerance in [1e-6, 1e-10, 1e-13] {
            let run =
                |t_end: f64| Simulation::new(&model, start).until(t_end).tolerance(tolerance).method(taylor);
            let halt = run(10.0).run().unwrap_err();
            let Reason::Placement { t, .. } = halt.stop.reason else { panic!("{halt}") };
            assert!((t - exact).abs() < 100.0 * tolerance.max(1e-8), "{tolerance:e}: {halt}");
            let why = run(0.5).run().unwrap().why().to_string();
            assert!(why.contains("phi leaves it by the error"), "{why}");
        }
    }
}
