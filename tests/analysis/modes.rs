//! Frequencies, multiplicities and shapes of small vibrations.

use affine_runtime::analysis::{AnalysisError, ModeClass, Modes, equilibrium};
use affine_runtime::model::Model;
use affine_runtime::prelude::*;

use crate::models::Missile;

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

/// Row "modes", L: shear `sqrt(4 c1/(I + A))` five times, breathing `sqrt(kappa/(n (I + A + n B)))`; a missile drifts as well.
#[test]
fn an_isotropic_body_shears_and_breathes() {
    let rest = Missile
        .at_velocity(
            Vector::<3>::zeros(),
            Matrix::<3>::identity() * 1.1,
            Vector::<3>::zeros(),
            Matrix::<3>::zeros(),
        )
        .unwrap();
    let expected = [(1.2909944487358056, ModeClass::Shear, 5), (1.4907119849998598, ModeClass::Breathing, 1)];
    assert_modes(&modes_near(&Missile, &rest), &expected, 3 + 3);
}

/// Row "modes", dalembert J: pairs and a diagonal problem.
#[test]
fn an_anisotropic_body_has_pairs() {
    #[affine_model(dim = 3, kinetic(dalembert = diag(1, 1.5, 2)), potential = hyperbolic_dilatation(10) + neo_hookean(0.5))]
    struct Anisotropic;
    let guess = Anisotropic.at_velocity(Matrix::<3>::identity() * 1.05, Matrix::<3>::zeros()).unwrap();
    let expected = [
        (1.040789638419645, ModeClass::Diagonal, 1),
        (1.0801234497346434, ModeClass::Pair(2, 3), 1),
        (1.224744871391589, ModeClass::Pair(1, 3), 1),
        (1.236173534172591, ModeClass::Diagonal, 1),
        (1.2909944487358056, ModeClass::Pair(1, 2), 1),
        (1.6385750572573253, ModeClass::Diagonal, 1),
    ];
    assert_modes(&modes_near(&Anisotropic, &guess), &expected, 3);
}

/// Row "equilibrium and modes": pulled along an axis.
#[test]
fn a_pulled_body_has_waves_about_its_axis() {
    #[affine_model(
        dim = 3,
        kinetic(dalembert = 1),
        potential = hyperbolic_dilatation(10) + neo_hookean(0.5) - 0.15*(phi[3,1]^2 + phi[3,2]^2 + phi[3,3]^2)
    )]
    struct Pulled;
    let start = Matrix::<3>::from_diagonal(&Vector::<3>::new(1.0, 1.0, 1.1));
    let guess = Pulled.at_velocity(start, Matrix::<3>::zeros()).unwrap();
    let rest = equilibrium(&Pulled, &guess).unwrap();
    let phi = rest.point.phi();
    assert!((phi[(0, 0)] - 0.9768308375720396).abs() < 1e-13, "{phi}");
    assert!((phi[(2, 2)] - 1.190361255305948).abs() < 1e-13, "{phi}");
    let expected = [
        (1.0909302459314318, ModeClass::Axial(0), 1),
        (1.2398305478263727, ModeClass::Axial(1), 2),
        (1.355426053801328, ModeClass::Axial(2), 2),
        (1.798884294605638, ModeClass::Axial(0), 1),
    ];
    let modes = rest.modes(&Pulled).unwrap();
    let tilts = modes.zeros;
    assert_modes(&modes, &expected, tilts);
    let path = std::env::temp_dir().join(format!("modes{}.svg", std::process::id()));
    modes.save_svg(&path).unwrap();
    let picture = std::fs::read_to_string(&path).unwrap();
    std::fs::remove_file(&path).unwrap();
    assert!(picture.starts_with("<svg") && picture.contains("Axial(2)"));
}

/// Row "hanging body, modes": `sqrt(u/I_k)`, under a constraint.
#[test]
fn a_hanging_body_swings() {
    #[affine_model(dim = 3, constraint = rigid, kinetic(dalembert = diag(1, 1.5, 2)), potential = 0.7*phi[3,3])]
    struct Hanging;
    let down = Matrix::<3>::from_diagonal(&Vector::<3>::new(1.0, -1.0, -1.0));
    let guess = Hanging.at_velocity(down, Matrix::<3>::zeros()).unwrap();
    let modes = modes_near(&Hanging, &guess);
    let found: Vec<f64> = modes.modes.iter().map(|mode| mode.frequency()).collect();
    assert!(
        (found[0] - 0.4472135954999579).abs() < 1e-14 && (found[1] - 0.48304589153964795).abs() < 1e-14,
        "{modes}"
    );
    assert_eq!(modes.zeros, 1);
    // Upright, the same modes grow.
    let upright = Hanging.at_velocity(Matrix::<3>::identity(), Matrix::<3>::zeros()).unwrap();
    let modes = modes_near(&Hanging, &upright);
    assert!(modes.modes.iter().all(|mode| mode.squared < 0.0), "{modes}");
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

/// Friction and turning bodies have no such modes, and say so.
#[test]
fn what_moves_does_not_vibrate_about_rest() {
    #[affine_model(dim = 2, kinetic(dalembert = 1), potential = tr(G)/2 - ln(det), dissipation(body_inertia = 0.3))]
    struct Damped;
    let guess = Damped.at_velocity(Matrix::<2>::identity(), Matrix::<2>::zeros()).unwrap();
    let rest = equilibrium(&Damped, &guess).unwrap();
    assert_eq!(rest.modes(&Damped).unwrap_err(), AnalysisError::NoVibrations);
}
