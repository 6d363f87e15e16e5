//! Short contacts between long flights: what a body has of its momentum afterwards.

use affine_runtime::prelude::*;

/// A wall at `x_1 = 0`, steeper the larger `k` is.
#[affine_model(
    dim = 2,
    kinetic(dalembert = 1, space_translation = 1),
    potential = orthogonality(1) + exp(-k*x[1]),
    emit(taylor, nystrom)
)]
struct Wall {
    k: f64,
}

/// The same for a stretch of the body.
#[affine_model(dim = 2, kinetic(dalembert = 1), potential = exp(-k*phi[1,1]), emit(taylor))]
struct Stop {
    k: f64,
}

/// Tolerances by which a momentum may be off; 80 were seen, and 710 of a body a hundred times its size away from the origin, whose
/// place is not known better.
const BOUND: f64 = 200.0;

const METHODS: [Method; 5] = [
    Method::RungeKutta8,
    Method::RungeKutta5,
    Method::RungeKuttaNystrom12,
    Method::Taylor { order: None },
    Method::Radau { stages: None },
];

/// A body that comes at speed 1 leaves at speed 1, within what steps by their error leave of a tolerance. Energies alone say
/// so, whatever the wall.
#[test]
fn a_bounce_turns_the_momentum_round() {
    for k in [1e2, 1e4, 1e6, 1e8] {
        let wall = Wall { k }.prepare().unwrap();
        for (along, size) in [(0.0, 1.0), (100.0, 5.0)] {
            let x = Vector::<2>::new(0.5, along);
            let (phi, still) = (Matrix::identity(), Matrix::zeros());
            let start = wall.at_velocity(x, phi, Vector::<2>::new(-1.0, 0.0), still).unwrap();
            for method in METHODS {
                for tolerance in [1e-6, 1e-8, 1e-10, 1e-12] {
                    let run = Simulation::new(&wall, start).until(1.2).tolerance(tolerance).method(method);
                    let error = (run.run().unwrap().end().1.p()[0] - 1.0).abs();
                    let label = format!("k = {k:e}, x_2 = {along}, {method:?} at {tolerance:e}");
                    assert!(error < BOUND * size * tolerance.max(1e-12), "{label}: {error:e}");
                }
            }
        }
    }
}
#[test]
fn a_stretch_that_is_stopped_turns_round() {
    for k in [1e2, 1e4, 1e6, 1e8] {
        let stop = Stop { k }.prepare().unwrap();
        let rate = Matrix::<2>::new(-1.0, 0.0, 0.0, 0.0);
        let start = stop.at_velocity(Matrix::identity(), rate).unwrap();
        for method in [Method::RungeKutta8, Method::RungeKutta5, Method::Taylor { order: None }] {
            for tolerance in [1e-6, 1e-8, 1e-10, 1e-12] {
                let run = Simulation::new(&stop, start).until(2.0).tolerance(tolerance).method(method);
                let error = (run.run().unwrap().end().1.pi().0.0[(0, 0)] - 1.0).abs();
                let label = format!("k = {k:e}, {method:?} at {tolerance:e}");
                assert!(error < BOUND * tolerance.max(1e-12), "{label}: {error:e}");
            }
        }
    }
}

/// A body at rest on which a force sets in late and smoothly, `f = (1 + tanh(20 (t - t_1)))/2`, whose integral the momentum is.
#[test]
fn a_body_at_rest_takes_up_a_force() {
    #[affine_model(
        dim = 2,
        kinetic(dalembert = 1, space_translation = 1),
        potential = orthogonality(1) - (1 + tanh(20*(t - t_1)))/2*x[1]
    )]
    struct Pushed {
        t_1: f64,
    }
    for t_1 in [1.0, 1.5, 2.0] {
        let pushed = Pushed { t_1 }.prepare().unwrap();
        let (zero, phi, still) = (Vector::zeros(), Matrix::identity(), Matrix::zeros());
        let start = pushed.at_velocity(zero, phi, zero, still).unwrap();
        let integral = |t: f64| 0.5 * (t + (20.0 * (t - t_1)).cosh().ln() / 20.0);
        let exact = integral(4.0) - integral(0.0);
        for method in [Method::RungeKutta8, Method::RungeKutta5, Method::Radau { stages: None }] {
            for tolerance in [1e-4, 1e-6, 1e-8, 1e-10, 1e-12] {
                let run = Simulation::new(&pushed, start).until(4.0).tolerance(tolerance).method(method);
                let error = (run.run().unwrap().end().1.p()[0] - exact).abs();
                assert!(
                    error < 100.0 * tolerance.max(1e-13),
                    "{t_1}, {method:?} at {tolerance:e}: {error:e}"
                );
            }
        }
    }
}
