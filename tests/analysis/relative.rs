//! Equilibria and relative equilibria that are known, and that they stay so.

use affine_runtime::analysis::{AnalysisError, Condition, Generator, equilibrium, relative_equilibrium};
use affine_runtime::prelude::*;

use crate::models::{Disc, Geodesic, Missile, Soft, turning, unrest};

#[test]
fn a_soft_body_rests_undeformed() {
    let guess = Matrix::<3>::new(1.2, 0.1, 0.0, 0.05, 0.9, -0.1, 0.0, 0.1, 1.1);
    let guess = Soft.at_velocity(guess, Matrix::<3>::identity() * 0.1).unwrap();
    let rest = equilibrium(&Soft, &guess).unwrap();
    let green = rest.point.green().0.0;
    assert!((green - Matrix::<3>::identity()).norm() < 1e-13, "{green}");
    assert!(rest.point.pi().0.0.norm() < 1e-13);
    assert!(rest.steps < 15, "{}", rest.steps);
}

/// Rows "rotating disc": the momentum of a disc at stretch `a`, `omega^2 = kappa (1 - a^-4)/(8 I)`.
#[test]
fn a_disc_turns_with_its_momentum() {
    let rows = [
        (1.0, 4.0, 0.3, 1.1, 0.39811213535568674, 0.963431367560762),
        (2.0, 5.0, 0.4, 1.05, 0.23538367961168608, 1.0380420270875357),
    ];
    for (i, kappa, c1, a, omega, spin) in rows {
        let disc = Disc { i, kappa, c1 }.prepare().unwrap();
        let guess = disc.at_velocity(Matrix::<2>::identity() * 1.02, turning(0.8 * omega)).unwrap();
        let turn = [Generator::rotation(1, 2)];
        let found = relative_equilibrium(&disc, &guess, &turn, &[Condition::MomentumMap(0, spin)]).unwrap();
        assert!((found.velocities[0] - omega).abs() < 1e-13, "{found:?}");
        let stretch = found.point.phi()[(0, 0)].hypot(found.point.phi()[(1, 0)]);
        assert!((stretch - a).abs() < 1e-13, "{stretch}");
        let again = relative_equilibrium(&disc, &guess, &turn, &[Condition::Velocity(0, omega)]).unwrap();
        assert!((again.point.spin().0.0[(0, 1)] - spin).abs() < 1e-12);
        assert!(unrest(&disc, &found, 50.0) < 1e-9);
    }
}

/// Row "planar Riemann": turned in space and in the body at once.
#[test]
fn an_ellipse_turns_in_space_and_in_the_body() {
    let disc = Disc { i: 1.0, kappa: 4.0, c1: 0.3 }.prepare().unwrap();
    let (left, right) = (0.6184533328393914, -0.18488413065083675);
    let phi = Matrix::<2>::new(1.55, 0.0, 0.0, 0.95);
    let guess = disc.at_velocity(phi, turning(left) * phi + phi * turning(right)).unwrap();
    let generators = [Generator::rotation(1, 2), Generator::vorticity(1, 2)];
    let conditions = [Condition::Velocity(0, left), Condition::Velocity(1, right)];
    let found = relative_equilibrium(&disc, &guess, &generators, &conditions).unwrap();
    let stretches = [found.point.phi().column(0).norm(), found.point.phi().column(1).norm()];
    assert!((stretches[0] - 1.6).abs() < 1e-12 && (stretches[1] - 0.9).abs() < 1e-12, "{stretches:?}");
    assert!(unrest(&disc, &found, 50.0) < 1e-9);
}

/// Row "steady flight": compressed along the flight.
#[test]
fn a_missile_flies_straight() {
    let guess = Missile.at_velocity(
        Vector::<3>::zeros(),
        Matrix::<3>::identity(),
        Vector::<3>::new(0.4, 0.0, 0.0),
        Matrix::<3>::zeros(),
    );
    let drift = [Generator::translation(1)];
    let found =
        relative_equilibrium(&Missile, &guess.unwrap(), &drift, &[Condition::MomentumMap(0, 0.5)]).unwrap();
    assert!((found.velocities[0] - 0.4156091706895312).abs() < 1e-13);
    let phi = found.point.phi();
    assert!((phi.column(0).norm() - 0.9117117644184825).abs() < 1e-13, "{phi}");
}

/// Geodesics `phi exp(F t)` of an anisotropic inertia: `F` diagonal is one, and a generator of no symmetry is refused.
#[test]
fn an_anisotropic_geodesic_needs_a_symmetry() {
    let phi = Matrix::<3>::new(1.1, 0.2, -0.1, 0.05, 0.9, 0.15, -0.2, 0.1, 1.05);
    let body = Matrix::<3>::from_diagonal(&Vector::<3>::new(0.3, -0.1, 0.2));
    let guess = Geodesic.at_velocity(phi, phi * body).unwrap();
    // The same motion from the left.
    let space = phi * body * phi.try_inverse().unwrap();
    let generator = Generator { space, ..Generator::zero() };
    let found =
        relative_equilibrium(&Geodesic, &guess, &[generator], &[Condition::Velocity(0, 1.0)]).unwrap();
    assert!(found.residual < 1e-13 && found.steps < 4, "{found:?}");
    assert!((found.point.phi() - phi).norm() < 1e-12);
    assert!(unrest(&Geodesic, &found, 4.0) < 1e-10);
    let refused = relative_equilibrium(&Geodesic, &guess, &[Generator { body, ..Generator::zero() }], &[]);
    assert!(matches!(refused, Err(AnalysisError::NotASymmetry { .. })), "{refused:?}");
}

#[test]
fn failures_say_what_is_wrong() {
    #[affine_model(dim = 2, kinetic(dalembert = 1), potential = tr(G)*cos(t))]
    struct Driven;
    let guess = Driven.at_velocity(Matrix::<2>::identity(), Matrix::<2>::zeros()).unwrap();
    assert_eq!(equilibrium(&Driven, &guess).unwrap_err(), AnalysisError::DependsOnTime);
    // Straight lines do not rest.
    #[affine_model(dim = 2, kinetic(dalembert = 1), potential = phi[1,1])]
    struct Falling;
    let guess = Falling.at_velocity(Matrix::<2>::identity(), Matrix::<2>::zeros()).unwrap();
    let error = equilibrium(&Falling, &guess).unwrap_err();
    assert!(matches!(error, AnalysisError::NoConvergence { .. }), "{error}");
}
