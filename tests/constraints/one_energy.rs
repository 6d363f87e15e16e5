//! One energy under `det phi = 1`, stated as masses and as a tensor, is one motion, with friction and forces; RATTLE takes the
//! masses without the constraint and finds its multiplier, and follows the same motion.

use affine_oracle::Constraint;
use affine_runtime::force::{Force, Motion};
use affine_runtime::frames::Space as OnSpace;
use affine_runtime::prelude::*;
use affine_runtime::scalar::Scalar;
use affine_runtime::simulate::Method;

use affine_tests::group::starts;
use affine_tests::tolerances::TWO_METHODS;

const T_END: f64 = 2.0;

/// Placement, velocity and energy at the end of a motion that starts with a velocity.
macro_rules! followed {
    ($model:ident, $phi:expr, $phi_dot:expr) => {{
        let start = $model.at_velocity($phi, $phi_dot).unwrap();
        let run = Simulation::new(&$model, start).until(T_END).tolerance(1e-13).run().unwrap();
        let (t, end) = run.end();
        (*end.phi(), $model.velocity(end).phi_dot, $model.hamiltonian(t, end))
    }};
}

macro_rules! one_energy {
    ($($name:ident: $n:literal ($($masses:tt)+) ($($tensor:tt)+) [$($potential:tt)*];)+) => { $(
        #[test]
        fn $name() {
            #[affine_model(dim = $n, constraint = isochoric, kinetic(dalembert = $($masses)+) $($potential)*)]
            struct Masses;
            #[affine_model(dim = $n, constraint = isochoric, kinetic(flat_tensor = $($tensor)+) $($potential)*)]
            struct Tensor;
            for start in starts::<$n>(Constraint::Isochoric) {
                // The spin of a start is traceless, as the velocities of the group are.
                let phi_dot = start.phi * start.spin;
                let one = followed!(Masses, start.phi, phi_dot);
                let other = followed!(Tensor, start.phi, phi_dot);
                let apart = |one: Matrix<$n>, other: Matrix<$n>| (one - other).norm() / one.norm();
                assert!(apart(one.0, start.phi) > 0.1, "the body stands still");
                assert!(apart(one.0, other.0) <= TWO_METHODS, "phi: {:e}", apart(one.0, other.0));
                assert!(apart(one.1, other.1) <= TWO_METHODS, "phi_dot: {:e}", apart(one.1, other.1));
                assert!((one.2 - other.2).abs() <= TWO_METHODS * one.2.abs(), "H: {:e} {:e}", one.2, other.2);
            }
            assert_eq!(Masses::DESCRIPTION.conserved, Tensor::DESCRIPTION.conserved);
            assert_eq!(Masses::DESCRIPTION.full_operations, Tensor::DESCRIPTION.full_operations);
        }
    )+ };
}

one_energy! {
    free_in_the_plane: 2 (diag(1, 1.5)) ([[1, 0, 0, 0], [0, 1.5, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1.5]]) [];
    elastic_in_the_plane: 2 (1.5) ([[1.5, 0, 0, 0], [0, 1.5, 0, 0], [0, 0, 1.5, 0], [0, 0, 0, 1.5]])
        [, potential = tr(G*G)/4];
    anisotropic_in_space: 3 (diag(1, 1.5, 2)) ([
        [1, 0, 0, 0, 0, 0, 0, 0, 0],
        [0, 1.5, 0, 0, 0, 0, 0, 0, 0],
        [0, 0, 2, 0, 0, 0, 0, 0, 0],
        [0, 0, 0, 1, 0, 0, 0, 0, 0],
        [0, 0, 0, 0, 1.5, 0, 0, 0, 0],
        [0, 0, 0, 0, 0, 2, 0, 0, 0],
        [0, 0, 0, 0, 0, 0, 1, 0, 0],
        [0, 0, 0, 0, 0, 0, 0, 1.5, 0],
        [0, 0, 0, 0, 0, 0, 0, 0, 2],
    ]) [, potential = tr(G)/2 + G[1,2]^2];
    damped_in_the_plane: 2 (1.5) ([[1.5, 0, 0, 0], [0, 1.5, 0, 0], [0, 0, 1.5, 0], [0, 0, 0, 1.5]])
        [, potential = tr(G)/2 + G[1,2]^2, dissipation(dalembert = 0.5, casimir2 = 0.1, body_inertia = 0.2)];
    driven_in_the_plane: 2 (1.5) ([[1.5, 0, 0, 0], [0, 1.5, 0, 0], [0, 0, 1.5, 0], [0, 0, 0, 1.5]])
        [, potential = tr(G)*(2 + cos(t))];
}

/// A force on a body at a place, that turns with the time.
#[derive(Clone, Copy)]
struct Pull;

impl Force<2> for Pull {
    type Form = OnSpace;
    fn force<T: Scalar>(&self, motion: &Motion<2, T>) -> Matrix<2, T> {
        motion.phi * motion.phi.transpose() * motion.t.cos()
    }
}

#[affine_model(
    dim = 2,
    constraint = isochoric,
    kinetic(dalembert = diag(1, 1.5), space_translation = 2),
    potential = tr(G)/2 + norm(x)^2/2 + x[1]*phi[1,2],
    forces = custom(pull, spatial, position)
)]
struct Pulled {
    pull: Pull,
}

/// RATTLE under a force that depends on the placement alone, with a centre of mass that the body pulls: the motion on the group.
#[test]
fn by_its_multiplier() {
    let model = Pulled { pull: Pull };
    for start in starts::<2>(Constraint::Isochoric) {
        let phi_dot = start.phi * start.spin;
        let point = model.at_velocity(start.x, start.phi, start.p, phi_dot).unwrap();
        let run = |method: Method| {
            Simulation::new(&model, point).until(T_END).tolerance(1e-13).method(method).run().unwrap()
        };
        let (by_rattle, exact) = (run(Method::Rattle { order: 8, step: 0.01 }), run(Method::RungeKutta8));
        let [(_, found), (_, expected)] = [by_rattle.end(), exact.end()];
        let close = |what: &str, difference: f64, size: f64| {
            assert!(difference <= TWO_METHODS * size, "{what}: {difference:e} of {size:e}");
        };
        close("phi", (found.phi() - expected.phi()).norm(), expected.phi().norm());
        let spins = [found, expected].map(|point| point.sigma_hat().0.0);
        close("Sigma_hat", (spins[0] - spins[1]).norm(), spins[1].norm());
        close("x", (found.x() - expected.x()).norm(), 1.0 + expected.x().norm());
        close("p", (found.p() - expected.p()).norm(), 1.0 + expected.p().norm());
        works(&by_rattle);
    }
}

/// The work of what gives energy closes the balance, and nothing is said to be lost.
fn works<const N: usize, P: Phase<N>>(run: &Trajectory<N, P>) {
    let balance = run.power_balance().unwrap();
    assert!(balance.relative() <= TWO_METHODS && balance.work.abs() > 1e-3 * balance.scale, "{balance}");
    assert_eq!(run.computation().energy_defect, 0.0, "{}", run.why());
    assert!(!run.why().to_string().contains("energy is off"), "{}", run.why());
}

/// RATTLE under a potential that contains the time, with a centre of mass that the drive moves, and without one.
#[test]
fn by_its_multiplier_under_a_drive() {
    #[affine_model(
        dim = 3,
        constraint = isochoric,
        kinetic(dalembert = diag(1, 1.5, 2), space_translation = 1),
        potential = tr(G) + sin(t)*x[1],
    )]
    struct Pushed;
    #[affine_model(dim = 2, constraint = isochoric, kinetic(dalembert = 1), potential = tr(G)*cos(t))]
    struct Driven;
    for method in [Method::Rattle { order: 8, step: 0.02 }, Method::Rattle { order: 4, step: 0.002 }] {
        for start in starts::<3>(Constraint::Isochoric) {
            let at = Pushed.at_velocity(start.x, start.phi, start.p, start.phi * start.spin * 0.2).unwrap();
            works(&Simulation::new(&Pushed, at).from(0.5).until(1.5).method(method).run().unwrap());
        }
        for start in starts::<2>(Constraint::Isochoric) {
            let at = Driven.at_velocity(start.phi, start.phi * start.spin).unwrap();
            works(&Simulation::new(&Driven, at).from(0.5).until(1.5).method(method).run().unwrap());
        }
    }
}
