//! Verdicts, signatures and spectra that are known.

use affine_runtime::analysis::{
    AnalysisError, Condition, Doubt, Generator, StabilityVerdict, equilibrium, relative_equilibrium,
};
use affine_runtime::prelude::*;

use crate::models::{Disc, turning};

/// Between its bifurcation and its dynamical instability (a = 1.33 and 1.66) a disc is stable, but not in the frame that
/// turns with it: with isotropy the signature depends on the choice of `zeta`.
#[test]
fn isotropy_lets_zeta_be_chosen() {
    let disc = Disc { i: 1.0, kappa: 4.0, c1: 0.3 }.prepare().unwrap();
    let phi = Matrix::<2>::identity() * 1.5;
    let omega = (4.0 * (1.0 - 1.5_f64.powi(-4)) / 8.0).sqrt();
    let guess = disc.at_velocity(phi, turning(omega) * phi).unwrap();
    let turn = [Generator::rotation(1, 2)];
    let found = relative_equilibrium(&disc, &guess, &turn, &[Condition::Velocity(0, omega)]).unwrap();
    let stability = found.stability(&disc).unwrap();
    assert_eq!(stability.verdict, StabilityVerdict::Stable);
    assert!(stability.zeta.body.norm() > 0.1 * omega, "{:?}", stability.zeta);
    assert_eq!(stability.signature.map(|(_, negative, _)| negative), Some(0));
    let negative = stability.stiffnesses.iter().filter(|stiffness| **stiffness < 0.0).count();
    assert_eq!(negative, 2, "{:?}", stability.stiffnesses);
}

/// A pendulum that hangs is stable, one that stands is not, one with friction comes to rest.
#[test]
fn friction_decides_by_eigenvalues() {
    #[affine_model(dim = 2, constraint = rigid, kinetic(dalembert = 1), potential = phi[1,1], dissipation(body_inertia = 0.3))]
    struct Pendulum;
    for (sign, expected) in [(-1.0, true), (1.0, false)] {
        let guess = Pendulum.at_velocity(Matrix::<2>::identity() * sign, Matrix::<2>::zeros()).unwrap();
        let stability = equilibrium(&Pendulum, &guess).unwrap().stability(&Pendulum).unwrap();
        assert_eq!(stability.signature, None);
        match stability.verdict {
            StabilityVerdict::Stable => assert!(expected),
            StabilityVerdict::Unstable { .. } => assert!(!expected),
            other => panic!("{other:?}"),
        }
    }
}

/// A body that nothing holds back is neutral in its shape: a mode of no frequency that is no symmetry's.
#[test]
fn zero_modes_are_not_called_stable() {
    #[affine_model(dim = 2, kinetic(dalembert = 1), potential = (phi[1,1] - 1)^4 + phi[1,2]^2 + phi[2,1]^2 + (phi[2,2] - 1)^2)]
    struct Flat;
    let guess = Flat.at_velocity(Matrix::<2>::identity(), Matrix::<2>::zeros()).unwrap();
    let rest = equilibrium(&Flat, &guess).unwrap();
    assert_eq!(rest.stability(&Flat).unwrap().verdict, StabilityVerdict::Undecided(Doubt::ZeroMode));
    assert_eq!(rest.isolated().unwrap_err(), AnalysisError::Degenerate { kernel: 1, expected: 0 });
}
