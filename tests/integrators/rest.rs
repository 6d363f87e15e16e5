//! Starts from rest, where nothing has a rate of its own.

use affine_runtime::prelude::*;
use affine_runtime::simulate::Ensemble;

/// A body with weight.
#[affine_model(
    dim = 3,
    kinetic(dalembert = 1, space_translation = 2),
    potential = 0.3*(tr(G) - 3)^2 + q^2 + g*x[3],
    emit(nystrom, lanes)
)]
struct Falling {
    g: f64,
}

#[affine_model(
    dim = 3,
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1),
    potential = hyperbolic_dilatation(10) + neo_hookean(0.5),
    emit(taylor, lanes)
)]
struct Vibrating;

fn strained() -> Matrix<3> {
    Matrix::<3>::new(1.1, 0.2, 0.0, -0.1, 0.95, 0.1, 0.05, 0.0, 1.02)
}

/// The placement with the velocity `v` of one of its entries, and of the centre of mass.
fn dropped(model: &PreparedFalling, phi: Matrix<3>, v: f64) -> <PreparedFalling as Model<3>>::Point<f64> {
    let mut phi_dot = Matrix::<3>::zeros();
    phi_dot[(0, 1)] = v;
    model.at_velocity(Vector::<3>::new(0.0, 0.0, 10.0), phi, Vector::<3>::new(v, 0.0, 0.0), phi_dot).unwrap()
}

const METHODS: [Method; 4] =
    [Method::RungeKutta8, Method::RungeKutta5, Method::RungeKuttaNystrom12, Method::RungeKuttaNystrom8];

/// With a force and without one, strained and not: at most what the same body costs that hardly moves.
#[test]
fn a_start_from_rest_costs_no_more_than_a_slow_one() {
    for g in [9.81, 0.0] {
        let model = Falling { g }.prepare().unwrap();
        for phi in [Matrix::<3>::identity(), strained()] {
            for t_end in [1e-6, 1e-3, 1.0] {
                for method in METHODS {
                    for tolerance in [1e-3, 1e-6, 1e-10] {
                        let cost = |v: f64| {
                            let run = Simulation::new(&model, dropped(&model, phi, v)).until(t_end);
                            run.tolerance(tolerance).method(method).run().unwrap().statistics()
                        };
                        let (rest, slow) = (cost(0.0), cost(1e-3));
                        assert!(
                            rest.evaluations <= slow.evaluations && rest.steps <= slow.steps,
                            "g = {g}, to {t_end:e}, {method:?}, {tolerance:e}: {rest:?} for {slow:?}"
                        );
                    }
                }
            }
        }
    }
}

#[test]
fn a_frame_from_rest_is_one_step() {
    let model = Falling { g: 9.81 }.prepare().unwrap();
    let start = dropped(&model, Matrix::<3>::identity(), 0.0);
    let run = Simulation::new(&model, start).until(1e-6).tolerance(1e-3).method(Method::RungeKutta8);
    let cost = run.run().unwrap().statistics();
    assert_eq!((cost.steps, cost.rejected), (1, 0));
    // Twelve of momenta, two of the start, twelve of the step.
    assert_eq!(cost.evaluations, 26);
}

/// Long first steps err no more than their tolerance allows.
#[test]
fn long_first_steps_are_held_to_the_tolerance() {
    let model = Falling { g: 9.81 }.prepare().unwrap();
    let start = dropped(&model, strained(), 0.0);
    let end = |method: Method, tolerance: f64| {
        let run = Simulation::new(&model, start).until(3.0).tolerance(tolerance).method(method);
        let run = run.output([]).run().unwrap();
        let point = run.end().1;
        (*point.phi(), point.x())
    };
    let (phi, x) = end(Method::RungeKutta8, 1e-15);
    for method in METHODS {
        for tolerance in [1e-2, 1e-4, 1e-6, 1e-8, 1e-10] {
            let (found, centre) = end(method, tolerance);
            let error = (found - phi).norm() / phi.norm() + (centre - x).norm() / (x.norm() + phi.norm());
            assert!(error < 20.0 * tolerance, "{method:?} at {tolerance:e}: {error:e}");
        }
    }
}

/// Lane by lane the same bits, with bodies at rest beside others.
#[test]
fn in_lanes_as_alone() {
    let bodies: Vec<_> = (0..13)
        .map(|k| {
            let phi_dot = Matrix::<3>::identity() * if k % 3 == 0 { 0.0 } else { 0.1 * f64::from(k) };
            let phi = if k % 2 == 0 { strained() } else { Matrix::<3>::identity() };
            Vibrating.at_velocity(phi, phi_dot).unwrap()
        })
        .collect();
    for tolerance in [1e-3, 1e-7, 1e-11] {
        let ends = Ensemble::new(&Vibrating, bodies.iter().copied()).until(2.0).tolerance(tolerance).run();
        for (start, end) in bodies.iter().zip(ends.unwrap()) {
            let run = Simulation::new(&Vibrating, *start).until(2.0).tolerance(tolerance);
            let alone = run.method(Method::RungeKutta8).output([]).run().unwrap();
            assert_eq!(end.unwrap(), *alone.end().1, "{tolerance:e}");
        }
    }
}
