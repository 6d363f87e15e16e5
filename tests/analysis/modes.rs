//! Frequencies, multiplicities and shapes of small vibrations.

use affine_runtime::analysis::{AnalysisError, ModeClass, Modes, equilibrium};
use affine_runtime::model::Model;
use affine_runtime::nalgebra::Rotation3;
use affine_runtime::prelude::*;

use crate::models::Disc;

fn modes_near<const N: usize, M: Model<N>>(model: &M, guess: &M::Point<f64>) -> Modes<N> {
    equilibrium(model, guess).unwrap().modes(model).unwrap()
}

fn assert_modes<const N: usize>(modes: &Modes<N>, expected: &[(f64, ModeClass, usize)], zeros: usize) {
    assert_eq!(modes.modes.len(), expected.len(), "{modes}");
    for (mode, (frequency, class, multiplicity)) in modes.modes.iter().zip(expected) {
        assert!((mode.frequency() - frequency).abs() < 1e-12, "{modes}");
        assert!(mode.error < 1e-12);
        assert_eq!((mode.class, mode.multiplicity()), (*class, *multiplicity), "{modes}");
    }
    assert_eq!(modes.zeros, zeros, "{modes}");
}

/// `U = sum f(q_a) + sum_{a<b} g(q_a - q_b)` with `f''(0) = 4`, `g''(0) = 1`: `omega^2 = f''(0)` of breathing, and
/// `f''(0) + n g''(0)` of shear, all stretches being one; wherever the body is turned.
#[test]
fn a_body_with_a_potential_of_single_stretches_has_modes_where_they_coincide() {
    #[affine_model(dim = 3, kinetic(dalembert = 1), potential = cosh(2*q1) + cosh(2*q2) + cosh(2*q3) + pairs(cosh(d)))]
    struct Stretched;
    let turned = Rotation3::from_euler_angles(0.3, -0.7, 1.1).into_inner();
    for phi in [Matrix::<3>::identity() * 1.1, turned, turned * 0.9] {
        let guess = Stretched.at_velocity(phi, Matrix::<3>::zeros()).unwrap();
        let expected = [(2.0, ModeClass::Breathing, 1), (7.0_f64.sqrt(), ModeClass::Shear, 5)];
        assert_modes(&modes_near(&Stretched, &guess), &expected, 3);
    }
}

/// Isochoric: shear alone, of the multiplier's model too, and a centre of mass on a spring.
#[test]
fn constraints_leave_modes_out() {
    #[affine_model(
        dim = 3,
        constraint = isochoric,
        kinetic(dalembert = 1.2, space_translation = 2),
        potential = tr(G)/2 + x[1]^2 + x[2]^2 + x[3]^2
    )]
    struct Held;
    let guess = Held
        .at_velocity(
            Vector::<3>::new(0.1, 0.0, 0.2),
            Matrix::<3>::identity(),
            Vector::<3>::zeros(),
            Matrix::<3>::zeros(),
        )
        .unwrap();
    let modes = modes_near(&Held, &guess);
    // U = tr exp(2 e)/2: 2 tr e^2/2 of a symmetric e without trace, against T = 1.2 tr e'^2/2.
    let expected = [(1.0, ModeClass::Drift, 3), ((2.0_f64 / 1.2).sqrt(), ModeClass::Shear, 5)];
    assert_modes(&modes, &expected, 3);
}

/// Metrics change neither frequencies nor what they are called: lengths and angles are theirs.
#[test]
fn classes_are_those_of_the_metrics() {
    #[affine_model(dim = 3, kinetic(dalembert = 1), potential = neo_hookean(0.5) + 5*q^2)]
    struct Ball;
    #[affine_model(
        dim = 3,
        metrics(space = diag(4, 1, 1), body = diag(1, 1, 9)),
        kinetic(dalembert = 1),
        potential = neo_hookean(0.5) + 5*q^2
    )]
    struct Measured;
    let guess = Ball.at_velocity(Matrix::<3>::identity() * 1.1, Matrix::<3>::zeros()).unwrap();
    let plain = modes_near(&Ball, &guess);
    let expected: Vec<_> =
        plain.modes.iter().map(|mode| (mode.frequency(), mode.class, mode.multiplicity())).collect();
    assert!(
        matches!(expected.as_slice(), [(_, ModeClass::Shear, 5), (_, ModeClass::Breathing, 1)]),
        "{plain}"
    );
    // Orthonormal: diag(2, 1, 1) phi diag(1, 1, 1/3).
    let round = Matrix::<3>::from_diagonal(&Vector::<3>::new(0.5, 1.0, 3.0));
    let guess = Measured.at_velocity(round * 1.1, Matrix::<3>::zeros()).unwrap();
    assert_modes(&modes_near(&Measured, &guess), &expected, 3);
}

/// Friction and turning bodies have no such modes, and say so.
#[test]
fn what_moves_does_not_vibrate_about_rest() {
    #[affine_model(dim = 2, kinetic(dalembert = 1), potential = tr(G)/2 - ln(det), dissipation(body_inertia = 0.3))]
    struct Damped;
    let guess = Damped.at_velocity(Matrix::<2>::identity(), Matrix::<2>::zeros()).unwrap();
    let rest = equilibrium(&Damped, &guess).unwrap();
    assert_eq!(rest.modes(&Damped).unwrap_err(), AnalysisError::NoVibrations);
}

/// Frequencies are printed to all their digits, in any unit of time.
#[test]
fn frequencies_are_printed_in_any_units() {
    for stiffness in [1e-12, 1.0, 1e12] {
        let disc = Disc { i: 1.0, kappa: 4.0 * stiffness, c1: 0.3 * stiffness }.prepare().unwrap();
        let rest = disc.at_velocity(Matrix::<2>::identity(), Matrix::<2>::zeros()).unwrap();
        let modes = modes_near(&disc, &rest);
        let text = modes.to_string();
        let printed =
            text.lines().nth(1).and_then(|line| line.split_whitespace().next()?.parse::<f64>().ok());
        let off = printed.unwrap() / modes.modes[0].frequency() - 1.0;
        assert!(off.abs() < 1e-14, "{text}");
    }
}
