//! A potential that contains the time: a pulsating body whose motion is known, driven through coincident stretches.

use affine_integrators::runge_kutta::Step;
use affine_runtime::prelude::*;

use affine_tests::tolerances::{DRIVEN, ORDER};

/// `det phi^(1/2) = exp(q)` with `4 q'' = -q^3 - f(t)`: `q = sin(t)/2` for the force `f = 2 sin t - (sin t)^3/8`.
#[affine_model(
    dim = 2,
    kinetic(casimir2 = 1, casimir1_squared = 0.5),
    potential = (q1^4 + q2^4)/8 + (2*sin(t) - sin(t)^3/8)*q
)]
struct Pulsating;

/// Not where the force vanishes: a wrong origin of time shows.
const T0: f64 = 0.3;
const T_END: f64 = 6.5;

/// The point at time `t`.
fn exact(t: f64) -> <Pulsating as Model<2>>::Point<f64> {
    let phi = Matrix::<2>::identity() * (t.sin() / 2.0).exp();
    Pulsating.at_velocity(phi, phi * (t.cos() / 2.0)).unwrap()
}

fn distance(found: &impl Phase<2>, t: f64) -> f64 {
    (found.phi() - exact(t).phi()).norm() + (found.sigma().0.0 - exact(t).sigma().0.0).norm()
}

#[test]
fn energy_belongs_to_its_time_and_is_not_conserved() {
    assert!(!Pulsating::DESCRIPTION.conserved.contains(&affine_runtime::model::Conserved::Energy));
    for t in [0.0, T0, 2.0] {
        let (sine, q, q_dot) = (t.sin(), t.sin() / 2.0, t.cos() / 2.0);
        let expected = 2.0 * q_dot * q_dot + q.powi(4) / 4.0 + (2.0 * sine - sine.powi(3) / 8.0) * q;
        assert!((Pulsating.hamiltonian(t, &exact(t)) - expected).abs() <= DRIVEN);
    }
}

#[test]
fn the_solution_is_met() {
    let run = Simulation::new(&Pulsating, exact(T0))
        .from(T0)
        .until(T_END)
        .tolerance(1e-13)
        .every(0.7)
        .run()
        .unwrap();
    for (t, point) in run.iter() {
        assert!(distance(point, t) <= DRIVEN, "{t}: {:e}", distance(point, t));
    }
}

/// The slope of the error between two step sizes.
fn observed_order(error: impl Fn(usize) -> f64, few: usize) -> f64 {
    let (first, last) = (error(few), error(2 * few));
    assert!(last > 2e-14, "rounding hides the order: {last:e}");
    (first / last).log2()
}

#[test]
fn gauss_keeps_its_orders() {
    for (stages, few) in [(2, 40), (3, 20)] {
        let error = |steps: usize| {
            let method = Method::Gauss { stages, step: (T_END - T0) / steps as f64 };
            let run =
                Simulation::new(&Pulsating, exact(T0)).from(T0).until(T_END).method(method).run().unwrap();
            distance(run.end().1, T_END)
        };
        let order = observed_order(error, few);
        assert!((order - 2.0 * stages as f64).abs() <= ORDER, "{stages} stages: order {order}");
    }
}

#[test]
fn runge_kutta_keeps_its_order() {
    let error = |steps: usize| {
        let (start, constants) = Pulsating.reduce(T0, &exact(T0));
        let f = |t: f64, y: &_| Pulsating.reduced_equations(t, &constants, y);
        let time = |i: usize| T0 + (T_END - T0) * i as f64 / steps as f64;
        let mut step = Step::start(&f, T0, start);
        for i in 0..steps {
            step.begin_next();
            step.attempt(&f, time(i + 1));
            step.accept(&f);
        }
        distance(&Pulsating.expand(T_END, &constants, step.end()), T_END)
    };
    let order = observed_order(error, 10);
    assert!((order - 8.0).abs() <= 2.0 * ORDER, "order {order}");
}
