//! One energy under `det phi = 1`, stated as masses and as a tensor: a multiplier keeps the one motion on the group, the
//! other is derived on its algebra. It is the same motion.

use affine_oracle::Constraint;
use affine_runtime::model::Conserved;
use affine_runtime::prelude::*;

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
            let spin = |list: &[Conserved]| list.contains(&Conserved::Spin);
            assert_eq!(spin(Masses::DESCRIPTION.conserved), spin(Tensor::DESCRIPTION.conserved));
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
}
