//! Verdicts, signatures and spectra that are known.

use affine_runtime::analysis::{
    Condition, Doubt, Generator, Stability, StabilityVerdict, equilibrium, relative_equilibrium,
};
use affine_runtime::prelude::*;

use affine_runtime::model::Model;

use crate::models::{Disc, Flat, FreeTop, Missile, Round, Soft, Top, Vibrating, turning, unrest};

/// Positive frequencies, from the least.
fn frequencies<const N: usize>(stability: &Stability<N>) -> Vec<f64> {
    let positive = stability.eigenvalues.iter().filter(|one| one.value.im > one.error);
    positive.map(|one| one.value.im).collect()
}

fn assert_near(found: &[f64], expected: &[f64], tolerance: f64) {
    assert_eq!(found.len(), expected.len(), "{found:?}");
    for (found, expected) in found.iter().zip(expected) {
        assert!((found - expected).abs() <= tolerance, "{found} and not {expected}");
    }
}

/// Values come with their negatives and conjugates, to rounding.
fn assert_paired<const N: usize>(stability: &Stability<N>) {
    for one in &stability.eigenvalues {
        for other in [-one.value, one.value.conj()] {
            let nearest = stability.eigenvalues.iter().map(|there| (there.value - other).norm());
            assert!(nearest.fold(f64::INFINITY, f64::min) <= 2.0 * one.error, "{:?}", stability.eigenvalues);
        }
    }
}

/// Rows "rotating disc": the bar mode decides, and which `zeta` shows it.
#[test]
fn a_disc_is_stable_until_its_bar_mode_grows() {
    for (c1, a, omega, expected) in
        [(0.3, 1.1, 0.39811213535568674, true), (0.05, 1.3, 0.5700316672581551, false)]
    {
        let disc = Disc { i: 1.0, kappa: 4.0, c1 }.prepare().unwrap();
        let phi = Matrix::<2>::identity() * a;
        let guess = disc.at_velocity(phi, turning(omega) * phi).unwrap();
        let turn = [Generator::rotation(1, 2)];
        let found = relative_equilibrium(&disc, &guess, &turn, &[Condition::Velocity(0, omega)]).unwrap();
        let stability = found.stability(&disc).unwrap();
        assert_eq!(stability.isotropy, 1);
        assert_paired(&stability);
        match stability.verdict {
            StabilityVerdict::Stable => assert!(expected),
            StabilityVerdict::Unstable { rate } => {
                assert!(!expected);
                assert!((rate - 0.20659290641083997_f64.sqrt()).abs() < 1e-12, "{rate}");
            }
            other => panic!("{other:?}"),
        }
        // Breathing, `sqrt(kappa/2I)` at every spin.
        let breathing = frequencies(&stability).into_iter().any(|w| (w - 2.0_f64.sqrt()).abs() < 1e-12);
        assert!(breathing, "{:?}", stability.eigenvalues);
    }
}

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

/// Rows "sleeping top": stable above `omega = sqrt(4 I1 u)/I3`, with its eigenvalues.
#[test]
fn a_top_sleeps() {
    let top = Top { j1: 1.0, j3: 0.5, u: 0.7 }.prepare().unwrap();
    let asleep = |omega: f64| {
        let guess = top.at_velocity(Matrix::<3>::identity(), turning(omega)).unwrap();
        let turn = [Generator::rotation(1, 2)];
        let found = relative_equilibrium(&top, &guess, &turn, &[Condition::Velocity(0, omega)]).unwrap();
        found.stability(&top).unwrap()
    };
    let fast = asleep(1.3);
    assert_eq!(fast.verdict, StabilityVerdict::Stable);
    // In space 1.4 and 1/3, in the frame that turns these less 1.3.
    assert_near(&frequencies(&fast), &[0.1, 1.3 - 1.0 / 3.0], 1e-13);
    let StabilityVerdict::Unstable { rate } = asleep(0.8).verdict else { panic!() };
    assert!((rate - 0.42687494916218993).abs() < 1e-13);
    let critical = 1.02469507659596;
    assert_eq!(asleep(critical + 1e-4).verdict, StabilityVerdict::Stable);
    assert!(matches!(asleep(critical - 1e-4).verdict, StabilityVerdict::Unstable { .. }));
}

/// Row "steady precession": slow and fast, at the tilt 0.6 with body spin 2, with their nutations.
#[test]
fn a_heavy_top_precesses() {
    let top = Top { j1: 1.0, j3: 0.5, u: 0.7 }.prepare().unwrap();
    let (sin, cos) = 0.6_f64.sin_cos();
    let tilted = Matrix::<3>::new(1.0, 0.0, 0.0, 0.0, cos, -sin, 0.0, sin, cos);
    for (precession, nutation) in
        [(0.18566947007547783, 2.362514634665743), (3.045339368624033, 2.920147429936328)]
    {
        let (space, body) = (Generator::<3>::rotation(1, 2), Generator::<3>::vorticity(1, 2));
        let own = 2.0 - precession * cos;
        let guess =
            top.at_velocity(tilted, space.space * tilted * precession + tilted * body.body * own).unwrap();
        let conditions = [Condition::Velocity(0, precession), Condition::Velocity(1, own)];
        let found = relative_equilibrium(&top, &guess, &[space, body], &conditions).unwrap();
        assert!((found.point.phi()[(2, 2)] - cos).abs() < 1e-12, "{found:?}");
        let stability = found.stability(&top).unwrap();
        assert_paired(&stability);
        assert_near(&frequencies(&stability), &[nutation], 1e-11);
        assert_eq!(stability.verdict, StabilityVerdict::Stable);
        assert!(unrest(&top, &found, 30.0) < 1e-9);
    }
}

/// Rows "free top, stationary rotation": Euler's theorem, about each axis.
#[test]
fn a_free_top_turns_about_its_outer_axes() {
    for (axis, expected) in [
        ((2, 3), Ok(0.25819888974716115)),
        ((3, 1), Err(0.1690308509457033)),
        ((1, 2), Ok(0.2182178902359924)),
    ] {
        let turn = Generator::<3>::rotation(axis.0, axis.1);
        let guess = FreeTop.at_velocity(Matrix::<3>::identity(), turn.space).unwrap();
        let found = relative_equilibrium(&FreeTop, &guess, &[turn], &[Condition::Velocity(0, 1.0)]).unwrap();
        let stability = found.stability(&FreeTop).unwrap();
        assert_paired(&stability);
        match (stability.verdict, expected) {
            (StabilityVerdict::Stable, Ok(nutation)) => {
                assert_near(&frequencies(&stability), &[nutation], 1e-13)
            }
            (StabilityVerdict::Unstable { rate }, Err(growth)) => assert!((rate - growth).abs() < 1e-13),
            (verdict, _) => panic!("{axis:?}: {verdict:?}"),
        }
    }
}

/// Rows "stationary rotation of a soft body": the middle axis grows.
#[test]
fn a_soft_body_turns_about_its_outer_axes() {
    let rows: [_; 3] = [
        ((2, 3), [0.9975739802911091, 1.0110162442581456, 1.015457456594734]),
        ((3, 1), [1.006899276912722, 0.9979209156271622, 1.0157982840338695]),
        ((1, 2), [1.0072430002429709, 1.0117007766817527, 0.9982677303902303]),
    ];
    for (k, (axis, stretches)) in rows.into_iter().enumerate() {
        let turn = Generator::<3>::rotation(axis.0, axis.1);
        let guess = Soft.at_velocity(Matrix::<3>::identity(), turn.space * 0.3).unwrap();
        let found = relative_equilibrium(&Soft, &guess, &[turn], &[Condition::Velocity(0, 0.3)]).unwrap();
        let columns: Vec<f64> = (0..3).map(|a| found.point.phi().column(a).norm()).collect();
        assert_near(&columns, &stretches, 1e-12);
        let stability = found.stability(&Soft).unwrap();
        assert_paired(&stability);
        match stability.verdict {
            StabilityVerdict::Unstable { rate } if k == 1 => {
                assert!((rate - 0.05065348298836461).abs() < 1e-11, "{rate}");
            }
            StabilityVerdict::Stable | StabilityVerdict::LinearlyStable if k != 1 => {
                let least = [0.07774584548903705, 0.0, 0.06528827954197998][k];
                assert!((frequencies(&stability)[0] - least).abs() < 1e-11);
            }
            other => panic!("{axis:?}: {other:?}"),
        }
    }
}

/// Row "steady flight": at rest in its frame, frequencies with their multiplicities.
#[test]
fn a_missile_vibrates_as_it_flies() {
    let guess = Missile.at_velocity(
        Vector::<3>::zeros(),
        Matrix::<3>::identity(),
        Vector::<3>::new(0.4, 0.0, 0.0),
        Matrix::<3>::zeros(),
    );
    let drift = [Generator::translation(1)];
    let found =
        relative_equilibrium(&Missile, &guess.unwrap(), &drift, &[Condition::MomentumMap(0, 0.5)]).unwrap();
    let stability = found.stability(&Missile).unwrap();
    let expected = [
        1.3238796088096094,
        1.33808737840353,
        1.33808737840353,
        1.33808737840353,
        1.33808737840353,
        1.5343789735293438,
    ];
    let found: Vec<f64> = frequencies(&stability).into_iter().filter(|w| *w > 1e-3).collect();
    assert_near(&found, &expected, 1e-11);
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
    let stability = equilibrium(&Flat, &guess).unwrap().stability(&Flat).unwrap();
    assert_eq!(stability.verdict, StabilityVerdict::Undecided(Doubt::ZeroMode));
}

/// The frequencies of a body that turns about the last axis, or in its plane, seen in the frame that turns with it. Those that
/// are known come with any multiplicity, `omega` itself, by which the axis tilts, or not.
fn assert_spectrum<const N: usize, M: Model<N>>(
    model: &M,
    guess: &M::Point<f64>,
    omega: f64,
    expected: &[f64],
) -> M::Point<f64> {
    let turn = [Generator::rotation(1, 2)];
    let found = relative_equilibrium(model, guess, &turn, &[Condition::Velocity(0, omega)]).unwrap();
    assert!(unrest(model, &found, 10.0) < 1e-9);
    let stability = found.stability(model).unwrap();
    assert_paired(&stability);
    assert!(!matches!(stability.verdict, StabilityVerdict::Unstable { .. }), "{:?}", stability.verdict);
    let frequencies: Vec<f64> = frequencies(&stability).into_iter().filter(|w| *w > 1e-3).collect();
    let near = |a: f64, b: &f64| (a - b).abs() < 1e-11;
    for one in &frequencies {
        assert!(expected.iter().any(|known| near(*one, known)), "{one} of {frequencies:?} is not known");
    }
    for known in expected.iter().filter(|known| !near(omega, known)) {
        assert!(frequencies.iter().any(|one| near(*one, known)), "{known} is not among {frequencies:?}");
    }
    found.point
}

/// Rows "spinning body" of d'Alembert's inertia: flattened, with waves around the axis.
#[test]
fn a_round_body_flattens_as_it_spins() {
    let rows = [
        (
            (1.0, 2.0, 0.4),
            (1.0281745265969475, 0.9885053652574968, 0.8457142857142858),
            [
                2.0384090375906874,
                2.777311654107267,
                1.6948917462656686,
                2.4948917462656685,
                0.4,
                1.866052135976106,
                2.266052135976106,
            ],
        ),
        (
            (0.0, 1.0, 0.6),
            (1.16619037896906, 1.0, 1.632),
            [
                2.0_f64.sqrt(),
                2.039607805437114,
                1.1549928774784245,
                2.3549928774784243,
                0.6,
                1.376305461424021,
                1.976305461424021,
            ],
        ),
    ];
    for ((lam, mu, omega), (a, c, spin), expected) in rows {
        let model = Round { lam, mu }.prepare().unwrap();
        let phi = Matrix::<3>::from_diagonal(&Vector::<3>::new(a, a, c).add_scalar(0.01));
        let guess = model.at_velocity(phi, turning::<3>(omega) * phi).unwrap();
        let point = assert_spectrum(&model, &guess, omega, &expected);
        let stretches: Vec<f64> = (0..3).map(|k| point.phi().column(k).norm()).collect();
        assert_near(&stretches, &[a, a, c], 1e-12);
        assert!((point.spin().0.0[(0, 1)].abs() - spin).abs() < 1e-12, "{:?}", point.spin());
    }
}

/// Rows "spinning body" of invariant kinetic energies: what spins is not deformed, and its bar mode is seen shifted.
#[test]
fn an_invariant_body_spins_undeformed() {
    let omega = 0.7;
    let guess = Flat.at_velocity(Matrix::<2>::identity(), turning(omega)).unwrap();
    assert_spectrum(&Flat, &guess, omega, &[0.49391598120173325, 1.8898223650461363, 3.23941735213160]);
    let guess = Vibrating.at_velocity(Matrix::<3>::identity(), turning(omega)).unwrap();
    let expected = [
        0.3785779102769618,
        0.49391598120173325,
        0.7,
        1.2909944487358056,
        1.4907119849998598,
        2.2452445769436284,
        3.23941735213160,
    ];
    assert_spectrum(&Vibrating, &guess, omega, &expected);
}
