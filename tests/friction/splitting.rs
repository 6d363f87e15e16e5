//! Friction as a piece of a splitting: orders above 2 go back in time on their way, where it gives back what it has taken.

use affine_runtime::model::Owned;
use affine_runtime::prelude::*;
use affine_runtime::simulate::{Reason, Stop};

#[affine_model(
    dim = 2,
    kinetic(casimir2 = 0.2, body_inertia = 1),
    potential = tr(G) - 2*q,
    dissipation(body_inertia = r),
    emit(splitting, lanes)
)]
#[derive(Clone)]
struct Comoving2 {
    r: f64,
}

#[affine_model(
    dim = 3,
    kinetic(dalembert = 1, space_translation = 1),
    potential = tr(G)/2 + hyperbolic_dilatation(3) + x[1]*phi[1,2] + norm(x)^2,
    dissipation(body_inertia = r),
    emit(splitting)
)]
struct Masses {
    r: f64,
}

#[affine_model(
    dim = 3,
    kinetic(body_inertia = 1.5, casimir2 = 0.3),
    potential = neo_hookean(2) + hyperbolic_dilatation(5),
    dissipation(space_inertia = r, casimir1_squared = r/9),
    emit(splitting)
)]
struct Spatial {
    r: f64,
}

#[affine_model(
    dim = 2,
    kinetic(dalembert = 1, space_translation = 1),
    potential = 5*(tr(G) - 2)^2 + 10*norm(x)^2,
    dissipation(dalembert = r, space_translation = r),
    emit(splitting)
)]
struct Stiff {
    r: f64,
}

/// It shrinks, and friction grows with that.
#[affine_model(
    dim = 2,
    kinetic(dalembert = 1),
    potential = 50*tr(G)/2,
    dissipation(body_inertia = r),
    emit(splitting)
)]
struct Pulled {
    r: f64,
}

fn phi() -> Matrix<3> {
    Matrix::<3>::new(1.1, 0.2, -0.1, 0.05, 0.9, 0.15, -0.2, 0.1, 1.05)
}

fn rate() -> Matrix<3> {
    Matrix::<3>::new(0.1, 0.4, -0.3, -0.2, -0.15, 0.25, 0.35, -0.1, 0.05)
}

fn flat_phi() -> Matrix<2> {
    Matrix::<2>::new(1.1, 0.2, -0.15, 0.9)
}

fn flat_rate() -> Matrix<2> {
    Matrix::<2>::new(0.1, 0.4, -0.3, -0.2)
}

const METHOD: fn(usize, f64) -> Method = |order, step| Method::Splitting { order, step };

/// The placement at `t = 2` by each of some orders against Radau's, over that by order 2.
fn errors<const N: usize, M: Model<N>>(model: &M, start: M::Point<f64>, orders: &[usize], step: f64) {
    let end = |method: Method| {
        let run = Simulation::new(model, start).until(2.0).method(method).tolerance(1e-11).run();
        *run.unwrap_or_else(|halt| panic!("{method:?}: {halt}")).end().1.phi()
    };
    let exact = end(Method::Radau { stages: None });
    let second = (end(METHOD(2, step)) - exact).norm();
    assert!(second < 0.2, "order 2 by {step}: {second:e}");
    for order in orders {
        let error = (end(METHOD(*order, step)) - exact).norm();
        assert!(error < second, "order {order} by {step}: {error:e}, order 2 {second:e}");
    }
}

/// Runs by some orders stop at the start, for the friction, and order 2 goes on.
fn are_refused<const N: usize, M: Model<N>>(
    model: &M,
    start: M::Point<f64>,
    orders: &[(usize, f64)],
    step: f64,
) {
    for (order, most) in orders {
        let run = Simulation::new(model, start).until(2.0).method(METHOD(*order, step)).run();
        let halt = run.err().unwrap_or_else(|| panic!("order {order} by {step}"));
        let Reason::Friction { order: told, rate, longest } = halt.stop.reason else { panic!("{halt}") };
        assert!(
            told == *order && halt.stop.t == 0.0 && (longest * rate / most - 1.0).abs() < 1e-15,
            "{halt}"
        );
        assert!(halt.to_string().contains("order 2") && halt.stop.steps == 0, "{halt}");
        // As long as is said, less what friction grows by on the way.
        let steps = Simulation::new(model, start).until(3.0 * longest).method(METHOD(*order, 0.9 * longest));
        assert!(steps.run().is_ok(), "order {order}");
    }
    errors(model, start, &[], step);
}

/// Velocities die out `times` times within a step, about.
fn bodies(step: f64, times: f64, orders: &[usize], refused: &[(usize, f64)]) {
    let comoving = Comoving2 { r: 0.8 * times / step }.prepare().unwrap();
    let start = comoving.at_velocity(flat_phi(), flat_rate()).unwrap();
    errors(&comoving, start, orders, step);
    are_refused(&comoving, start, refused, step);
    let masses = Masses { r: 0.5 * times / step }.prepare().unwrap();
    let start = masses
        .at_velocity(Vector::<3>::new(0.1, 0.2, 0.3), phi(), Vector::<3>::new(0.3, -0.2, 0.1), rate())
        .unwrap();
    errors(&masses, start, orders, step);
    are_refused(&masses, start, refused, step);
    let spatial = Spatial { r: 0.5 * times / step }.prepare().unwrap();
    let start = spatial.at_velocity(phi(), rate()).unwrap();
    errors(&spatial, start, orders, step);
    are_refused(&spatial, start, refused, step);
    let stiff = Stiff { r: times / step }.prepare().unwrap();
    let (x, v) = (Vector::<2>::new(0.1, 0.2), Vector::<2>::new(0.3, -0.2));
    let start = stiff.at_velocity(x, flat_phi(), v, flat_rate()).unwrap();
    errors(&stiff, start, orders, step);
    are_refused(&stiff, start, refused, step);
}

/// Up to the limits orders above 2 err less than order 2.
#[test]
fn orders_above_2_follow_friction_up_to_a_limit() {
    for step in [0.02, 0.1] {
        bodies(step, 0.3, &[4, 6, 8], &[]);
        bodies(step, 5.0, &[4, 6, 8], &[]);
        bodies(step, 8.0, &[4, 6], &[]);
    }
}

#[test]
fn orders_above_2_are_refused_where_friction_is_strong() {
    for times in [30.0, 300.0] {
        bodies(0.02, times, &[], &[(4, 10.0), (6, 10.0), (8, 6.0)]);
    }
}

#[test]
fn friction_that_grows_ends_orders_above_2() {
    let model = Pulled { r: 450.0 }.prepare().unwrap();
    let start = model.at_velocity(Matrix::<2>::identity(), Matrix::<2>::zeros()).unwrap();
    let to = |t_end: f64, order: usize| {
        Simulation::new(&model, start).until(t_end).method(METHOD(order, 0.02)).run()
    };
    assert!(to(0.2, 4).is_ok());
    assert!(to(2.0, 2).is_ok());
    let stops = |stop: &Stop, what: &str| {
        let Reason::Friction { order, rate, .. } = stop.reason else { panic!("{what}: {stop}") };
        assert!(order == 4 && rate * 0.02 > 10.0 && (0.2..2.0).contains(&stop.t), "{what}: {stop}");
    };
    let halt = to(2.0, 4).unwrap_err();
    stops(&halt.stop, "run");
    assert!(halt.stop.t > 0.2 && halt.trajectory.end().0 == halt.stop.t, "{halt}");
    let mut flow = Flow::by(METHOD(4, 0.02), &model, (0.0, start)).unwrap();
    stops(&flow.advance_to(2.0).unwrap_err(), "flow");
}

#[test]
fn bodies_in_lanes_are_looked_at_where_they_begin() {
    let body = |r: f64| {
        let model = Comoving2 { r }.prepare().unwrap();
        let start = model.at_velocity(flat_phi(), flat_rate()).unwrap();
        (Owned(model), start)
    };
    let mut flows = Flows::by_splitting((4, 0.02), 0.0, [body(1.0), body(1e4), body(2.0)]).unwrap();
    let (number, stop) = match flows.advance_to(1.0) {
        Err(_) => flows.stopped().next().map(|(number, stop)| (number, *stop)).unwrap(),
        Ok(()) => panic!("friction is followed"),
    };
    assert!(number == 1 && matches!(stop.reason, Reason::Friction { order: 4, .. }), "{stop}");
    assert_eq!(flows.stopped().count(), 1);
}

/// Velocities die out at the rate `r`; what is found of it is known to four percent. A step of the length that is said to be allowed
/// is allowed, however that was rounded.
#[test]
fn what_is_said_of_a_rate_is_known() {
    #[affine_model(
        dim = 2,
        kinetic(dalembert = 1),
        potential = orthogonality(1),
        dissipation(dalembert = r),
        emit(splitting)
    )]
    struct Plain {
        r: f64,
    }
    for (r, said) in [
        (100.0, "a rate of about 1.0e2:"),
        (146.0, "1.5e2"),
        (1e6, "a rate of about 1.0e6:"),
        (3.3e4, "3.3e4"),
    ] {
        let model = Plain { r }.prepare().unwrap();
        let start = model.at_velocity(flat_phi(), flat_rate()).unwrap();
        let run = |step: f64| Simulation::new(&model, start).until(step).method(METHOD(4, step)).run();
        let halt = run(20.0 / r).unwrap_err().to_string();
        assert!(halt.contains(said), "{halt}");
        let allowed = halt.split("at most ").nth(1).and_then(|rest| rest.split(',').next()).unwrap();
        assert!(run(allowed.parse().unwrap()).is_ok(), "{halt}");
    }
}
