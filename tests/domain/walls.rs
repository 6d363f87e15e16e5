//! Short contacts between long flights: what a body has of its momentum afterwards.

use affine_runtime::force::{Force, Motion, Translation};
use affine_runtime::prelude::*;
use affine_runtime::scalar::Scalar;

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

/// A spring below `x_2 = 0`, which does not pull.
#[derive(Clone, Copy)]
struct Ground {
    k: f64,
}

impl Force<2> for Ground {
    type Form = Translation;

    fn force<T: Scalar>(&self, motion: &Motion<2, T>) -> Vector<2, T> {
        let depth = (-motion.x[1]).max(T::zero());
        Vector::<2, T>::new(T::zero(), T::constant(self.k, 0.0) * depth)
    }
}

/// A height that falls from 1 with unit weight, and what the ground makes of it: parabolas and parts of `-1/k + A cos(w s + a)`.
fn bouncing(k: f64, t: f64) -> f64 {
    let (fall, speed, w) = (2.0_f64.sqrt(), 2.0_f64.sqrt(), k.sqrt());
    let contact = (core::f64::consts::TAU - 2.0 * (speed * w).atan()) / w;
    let since = t.rem_euclid(2.0 * fall + contact);
    let (down, up) = (since - fall, since - fall - contact);
    if down < 0.0 {
        1.0 - since * since / 2.0
    } else if up < 0.0 {
        ((w * down).cos() - 1.0) / k - speed / w * (w * down).sin()
    } else {
        speed * up - up * up / 2.0
    }
}

/// Contacts of a body that bounces begin anywhere within a step, behind its last kick too.
#[test]
fn contacts_begin_within_steps() {
    #[affine_model(
        dim = 2,
        kinetic(dalembert = 1, space_translation = 1),
        potential = orthogonality(1) + x[2],
        forces = custom(ground, translation, position),
        emit(splitting)
    )]
    struct Ball {
        ground: Ground,
    }
    for k in [1e2, 1e4, 1e6] {
        let ball = Ball { ground: Ground { k } }.prepare().unwrap();
        let (phi, phi_dot) = (Matrix::<2>::new(1.1, 0.1, 0.0, 0.95), Matrix::<2>::new(0.1, -0.3, 0.4, 0.0));
        let start = ball.at_velocity(Vector::<2>::new(0.0, 1.0), phi, Vector::zeros(), phi_dot).unwrap();
        let halves = [4, 6, 8].map(|order| Method::AdaptiveSplitting { order: Some(order) });
        for method in [Method::RungeKutta8].into_iter().chain(halves) {
            for tolerance in [1e-4, 1e-6, 1e-8, 1e-10, 1e-12] {
                let run = Simulation::new(&ball, start).until(7.0).tolerance(tolerance).method(method);
                let error = (run.output([]).run().unwrap().end().1.x()[1] - bouncing(k, 7.0)).abs();
                assert!(error < 1e3 * tolerance, "k = {k:e}, {method:?} at {tolerance:e}: {error:e}");
            }
        }
    }
}
