//! Verdicts, signatures and spectra that are known.

use affine_runtime::analysis::{
    AnalysisError, Condition, Continuation, Doubt, Generator, StabilityVerdict, equilibrium,
    relative_equilibrium,
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

/// Friction takes momenta away and leaves the symmetries: an elastic disc comes to rest, wherever it is turned to, and so it is with no
/// friction in the field.
#[test]
fn friction_leaves_symmetries() {
    #[affine_model(
        dim = 2,
        kinetic(dalembert = 1),
        potential = hyperbolic_dilatation(kappa) + neo_hookean(0.3),
        dissipation(dalembert = r)
    )]
    struct Damped {
        kappa: f64,
        r: f64,
    }
    for (r, stays) in [(0.1, 7), (0.0, 7)] {
        let model = Damped { kappa: 1.0, r }.prepare().unwrap();
        let guess = model.at_velocity(Matrix::<2>::identity() * 1.1, Matrix::<2>::zeros()).unwrap();
        let rest = equilibrium(&model, &guess).unwrap().isolated().unwrap();
        let stability = rest.stability(&model).unwrap();
        assert_eq!(
            (stability.verdict, stability.eigenvalues.len()),
            (StabilityVerdict::Stable, stays),
            "{r}"
        );
        let family = |kappa: f64| Ok((Damped { kappa, r }.prepare()?, Vec::new()));
        let branch = Continuation::new(&[], (1.0, 1.5), 0.2, family).run(&guess, 1.0).unwrap();
        assert_eq!((branch.special.len(), branch.ended), (0, None), "{r}");
    }
    // Friction by the axes of the body leaves turns of space. What is held has no symmetry, and a slow motion in its place.
    #[affine_model(
        dim = 2,
        kinetic(dalembert = 1),
        potential = hyperbolic_dilatation(2) + neo_hookean(0.3) + h*phi[1,2]^2,
        dissipation(dalembert = diag(0.1, 0.2))
    )]
    struct Held {
        h: f64,
    }
    for (h, stays) in [(0.0, 7), (1e-3, 8)] {
        let model = Held { h }.prepare().unwrap();
        let guess = model.at_velocity(Matrix::<2>::identity(), Matrix::<2>::zeros()).unwrap();
        let stability = equilibrium(&model, &guess).unwrap().isolated().unwrap().stability(&model).unwrap();
        assert_eq!(
            (stability.verdict, stability.eigenvalues.len()),
            (StabilityVerdict::Stable, stays),
            "{h}"
        );
    }
}

/// Geodesics that are left-invariant in space: what keeps the momentum of a turn stretches along its axis, and not only a plane. A
/// neighbour of the turn of space is torn apart, `det phi` kept.
#[test]
fn turns_that_stretch_are_not_called_stable() {
    #[affine_model(dim = 3, kinetic(casimir2 = 0.2, body_inertia = 1))]
    struct Torn;
    let turn = Generator::<3>::rotation(1, 2);
    let start = Torn.at_velocity(Matrix::<3>::identity(), turn.space).unwrap();
    let found = relative_equilibrium(&Torn, &start, &[turn], &[Condition::Velocity(0, 1.0)]).unwrap();
    let stability = found.stability(&Torn).unwrap();
    assert_eq!(stability.verdict, StabilityVerdict::Undecided(Doubt::NonCompact));
    let aside = Matrix::<3>::new(0.3, 0.2, 0.1, -0.1, 0.2, 0.4, 0.3, -0.2, -0.5) * 0.01;
    let near = Torn.at_velocity(Matrix::<3>::identity(), turn.space + aside).unwrap();
    let run = Simulation::new(&Torn, near).until(1e3).run().unwrap();
    assert!(run.end().1.phi().norm() > 5.0, "{}", run.end().1.phi());
    // In the plane nothing but the size is left to go.
    #[affine_model(dim = 2, kinetic(casimir2 = 0.2, body_inertia = 1))]
    struct Flat;
    let turn = Generator::<2>::rotation(1, 2);
    let start = Flat.at_velocity(Matrix::<2>::identity(), turn.space).unwrap();
    let found = relative_equilibrium(&Flat, &start, &[turn], &[Condition::Velocity(0, 1.0)]).unwrap();
    assert_eq!(found.stability(&Flat).unwrap().verdict, StabilityVerdict::Stable);
}

/// A ball that flies is stable as one at rest is, turning or not.
#[test]
fn verdicts_do_not_depend_on_who_looks() {
    #[affine_model(dim = 3, kinetic(dalembert = 1, space_translation = 1), potential = neo_hookean(0.5) + 5*q^2)]
    struct Ball;
    let (axis, turn) = (Generator::<3>::translation(1), Generator::<3>::rotation(2, 3));
    for omega in [0.0, 0.3] {
        for v in [0.0, 0.5] {
            let drift = Vector::<3>::new(v, 0.0, 0.0);
            let guess = Ball
                .at_velocity(Vector::<3>::zeros(), Matrix::<3>::identity(), drift, turn.space * omega)
                .unwrap();
            let conditions = [Condition::Velocity(0, v), Condition::Velocity(1, omega)];
            let found = relative_equilibrium(&Ball, &guess, &[axis, turn], &conditions).unwrap();
            let stability = found.stability(&Ball).unwrap();
            assert_eq!(
                stability.verdict,
                StabilityVerdict::Stable,
                "{omega}, {v}: {:?}",
                stability.signature
            );
        }
    }
}

/// A viscous star, which turns on without friction: unstable beyond `e = 0.812670010612`, long before one without (Chandrasekhar,
/// Ellipsoidal Figures of Equilibrium, 1969, section 37).
#[test]
fn viscosity_makes_stars_unstable() {
    #[affine_model(
        dim = 3,
        constraint = isochoric,
        kinetic(dalembert = 1/5),
        potential = self_gravity(1),
        dissipation(space_inertia = 0.01, casimir2 = 0.01)
    )]
    struct Star;
    for (e, is_stable) in [(0.5_f64, true), (0.8, true), (0.82, false), (0.94, false)] {
        // Semi-axes a, a, c of volume 1, and Maclaurin's formula.
        let c = (1.0 - e * e).cbrt();
        let phi = Matrix::<3>::from_diagonal(&Vector::<3>::new(c.sqrt().recip(), c.sqrt().recip(), c));
        let squared = 1.5
            * ((1.0 - e * e).sqrt() / e.powi(3) * (3.0 - 2.0 * e * e) * e.asin()
                - 3.0 * (1.0 - e * e) / (e * e));
        let (turn, omega) = (Generator::<3>::rotation(1, 2), squared.sqrt());
        let guess = Star.at_velocity(phi, turn.space * phi * omega).unwrap();
        let found = relative_equilibrium(&Star, &guess, &[turn], &[Condition::Velocity(0, omega)]).unwrap();
        assert!((found.point.phi() - phi).norm() < 1e-10, "{e}");
        let found = found.isolated().unwrap();
        match found.stability(&Star).unwrap().verdict {
            StabilityVerdict::Stable => assert!(is_stable, "{e}"),
            StabilityVerdict::Unstable { .. } => assert!(!is_stable, "{e}"),
            other => panic!("{e}: {other:?}"),
        }
    }
}

/// Bodies whose frequencies coincide, as those of balls do: singular values that are alike or vanish tell nothing untrue.
#[test]
fn round_bodies_have_their_stability_from_any_guess() {
    #[affine_model(
        dim = 3,
        kinetic(casimir2 = 0.2, body_inertia = 1),
        potential = hyperbolic_dilatation(10) + neo_hookean(0.5),
        dissipation(body_inertia = 0.1)
    )]
    struct Ball;
    #[affine_model(
        dim = 3,
        kinetic(body_inertia = 1, space_translation = 1),
        potential = hyperbolic_dilatation(1) + neo_hookean(1) + 0.4*norm(x)^2,
        dissipation(space_inertia = 0.3)
    )]
    struct Spring;
    for k in 0..6 {
        let part = |place: usize| 0.1 * (f64::from(k) * 1.7 + place as f64 * 2.3).sin();
        let phi = Matrix::<3>::identity() + Matrix::<3>::from_fn(|i, j| part(3 * i + j));
        let guess = Ball.at_velocity(phi, Matrix::zeros()).unwrap();
        let verdict = |found: Result<StabilityVerdict, AnalysisError>| found.unwrap();
        let ball = equilibrium(&Ball, &guess).and_then(|rest| rest.stability(&Ball));
        assert_eq!(verdict(ball.map(|found| found.verdict)), StabilityVerdict::Stable, "guess {k}");
        // Its centre vibrates for ever.
        let x = Vector::<3>::from_fn(|i, _| part(10 + i));
        let guess = Spring.at_velocity(x, phi, Vector::zeros(), Matrix::zeros()).unwrap();
        let spring = equilibrium(&Spring, &guess).and_then(|rest| rest.stability(&Spring));
        let verdict = verdict(spring.map(|found| found.verdict));
        assert_eq!(verdict, StabilityVerdict::Undecided(Doubt::Neutral), "guess {k}");
    }
}
