//! Equilibria and relative equilibria that are known, and that they stay so.

use affine_runtime::analysis::{
    AnalysisError, Condition, Continuation, Generator, RelativeEquilibrium, StabilityVerdict, equilibrium,
    relative_equilibrium,
};
use affine_runtime::model::Model;
use affine_runtime::prelude::*;

use crate::models::{Disc, Geodesic, Soft, turning, unrest};
use crate::rows::assert_paired;

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

/// Metrics and momenta in space: symmetries act in orthonormal bases.
#[test]
fn metrics_turn_in_their_own_bases() {
    #[affine_model(
        dim = 3,
        metrics(space = diag(4, 1, 2), body = diag(1, 2, 1)),
        kinetic(casimir2 = 0.2, space_inertia = 1),
        potential = hyperbolic_dilatation(10) + neo_hookean(0.5)
    )]
    struct Measured;
    // Orthonormal: phi_ij sqrt(g_i/eta_j).
    let rest = Matrix::<3>::from_diagonal(&Vector::<3>::new(0.5, 2.0_f64.sqrt(), 0.5_f64.sqrt()));
    let guess = Measured.at_velocity(rest, Matrix::<3>::zeros()).unwrap();
    let still = equilibrium(&Measured, &guess).unwrap();
    assert!((still.point.phi() - rest).norm() < 1e-13);
    let turn = [Generator::rotation(1, 2)];
    let found = relative_equilibrium(&Measured, &guess, &turn, &[Condition::Velocity(0, 0.6)]).unwrap();
    assert!(unrest(&Measured, &found, 20.0) < 1e-9);
    assert!(found.stability(&Measured).unwrap().verdict == StabilityVerdict::Stable);
    // Nothing is known of a point that is none.
    for entry in [f64::NAN, f64::INFINITY] {
        let lost = RelativeEquilibrium { point: Measured.unflatten(&[entry; 18]), ..found.clone() };
        assert_eq!(lost.stability(&Measured).unwrap_err(), AnalysisError::NoDecomposition);
    }
}

/// Bodies with drawn inertias and stiffnesses, that turn about a principal axis: what is found stays so for a
/// long time, unless it is called unstable, and then it leaves.
#[test]
fn drawn_bodies_turn_on() {
    #[affine_model(dim = 3, kinetic(dalembert = diag(j1, j2, j3)), potential = hyperbolic_dilatation(kappa) + neo_hookean(c1))]
    struct Drawn {
        j1: f64,
        j2: f64,
        j3: f64,
        kappa: f64,
        c1: f64,
    }
    let mut seed = 11_u64;
    let mut draw = |low: f64, high: f64| {
        seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        low + (high - low) * (seed >> 11) as f64 / (1_u64 << 53) as f64
    };
    let mut ranks = [0; 3];
    for k in 0..8 {
        let [j1, j2, j3] = std::array::from_fn(|_| draw(0.5, 2.0));
        let body = Drawn { j1, j2, j3, kappa: draw(4.0, 20.0), c1: draw(0.5, 2.0) }.prepare().unwrap();
        let turn = [Generator::<3>::rotation(k % 3 + 1, (k + 1) % 3 + 1)];
        let omega = draw(0.2, 0.5);
        let guess = body.at_velocity(Matrix::<3>::identity(), turn[0].space * omega).unwrap();
        let found = relative_equilibrium(&body, &guess, &turn, &[Condition::Velocity(0, omega)]).unwrap();
        // Euler's theorem, for bodies that hardly deform: how many moments of inertia are less.
        let moments = [j1 + j2, j2 + j3, j3 + j1];
        let rank = moments.iter().filter(|moment| **moment < moments[k % 3]).count();
        ranks[rank] += 1;
        match (rank, found.stability(&body).unwrap().verdict) {
            (2, StabilityVerdict::Stable) | (0, StabilityVerdict::LinearlyStable) => {
                assert!(unrest(&body, &found, 60.0) < 1e-8);
            }
            (1, StabilityVerdict::Unstable { rate }) => assert!(unrest(&body, &found, 2.0 / rate) < 1e-9),
            other => panic!("{other:?}"),
        }
    }
    assert!(ranks.iter().all(|count| *count > 0), "{ranks:?}");
}

/// Under constraints and with affine inertia: the same, about any axis of space.
#[test]
fn drawn_constraints_and_inertias_turn_on() {
    #[affine_model(
        dim = 3,
        kinetic(casimir2 = a, casimir1_squared = 0.1, body_inertia = diag(1, 1.2, 1.5), body_translation = 2),
        potential = hyperbolic_dilatation(8) + neo_hookean(c)
    )]
    struct Affine {
        a: f64,
        c: f64,
    }
    #[affine_model(dim = 3, constraint = isochoric, kinetic(dalembert = diag(1, j, 1.5)), potential = c*tr(G))]
    struct Isochoric {
        j: f64,
        c: f64,
    }
    #[affine_model(dim = 3, constraint = conformal, kinetic(dalembert = diag(1, j, 1.5)), potential = c*q^2)]
    struct Conformal {
        j: f64,
        c: f64,
    }
    let (one, none) = (Matrix::<3>::identity(), Vector::<3>::zeros());
    for k in 0..3 {
        let turn = Generator::<3>::rotation(k % 3 + 1, (k + 1) % 3 + 1);
        let draw = |seed: f64| 0.5 + 0.5 * (seed * (k + 1) as f64).sin().abs();
        let omega = 0.3 * draw(1.7);
        let rate = turn.space * omega;
        let affine = Affine { a: 0.3 * draw(0.9), c: draw(2.3) }.prepare().unwrap();
        assert_stays(&affine, &affine.at_velocity(none, one, none, rate).unwrap(), turn, omega);
        let isochoric = Isochoric { j: 1.3 * draw(3.1), c: 4.0 * draw(0.7) }.prepare().unwrap();
        assert_stays(&isochoric, &isochoric.at_velocity(one, rate).unwrap(), turn, omega);
        let conformal = Conformal { j: 1.3 * draw(3.1), c: 4.0 * draw(0.7) }.prepare().unwrap();
        assert_stays(&conformal, &conformal.at_velocity(one, rate).unwrap(), turn, omega);
    }
}

fn assert_stays<M: Model<3>>(model: &M, guess: &M::Point<f64>, turn: Generator<3>, omega: f64) {
    let found = relative_equilibrium(model, guess, &[turn], &[Condition::Velocity(0, omega)]).unwrap();
    let stability = found.stability(model).unwrap();
    assert_paired(&stability);
    let time = match stability.verdict {
        StabilityVerdict::Unstable { rate } => 2.0 / rate,
        _ => 60.0,
    };
    assert!(unrest(model, &found, time) < 1e-8, "{:?}", stability.verdict);
}

#[test]
fn failures_say_what_is_wrong() {
    #[affine_model(dim = 2, kinetic(dalembert = 1), potential = tr(G)*cos(t))]
    struct Driven;
    let guess = Driven.at_velocity(Matrix::<2>::identity(), Matrix::<2>::zeros()).unwrap();
    assert_eq!(equilibrium(&Driven, &guess).unwrap_err(), AnalysisError::DependsOnTime);
    // The springs of a centre that rests pulsate: it is thrown out, as the trace -2.4 of one turn says.
    #[affine_model(dim = 2, kinetic(dalembert = 1, space_translation = 1), potential = (1 + a*cos(2*t))*norm(x)^2/2 + tr(G)/2 - ln(det))]
    struct Pulsating {
        a: f64,
    }
    let still = |a: f64| {
        let (model, none) = (Pulsating { a }.prepare().unwrap(), Vector::<2>::zeros());
        let guess = model.at_velocity(none, Matrix::<2>::identity(), none, Matrix::<2>::zeros()).unwrap();
        (model, guess)
    };
    let (model, guess) = still(0.8);
    assert_eq!(equilibrium(&model, &guess).unwrap_err(), AnalysisError::DependsOnTime);
    let (model, guess) = still(0.0);
    assert!(equilibrium(&model, &guess).is_ok());
    // Also where the time comes in on the way.
    let family = |a: f64| Ok((Pulsating { a }.prepare()?, Vec::new()));
    let branch = Continuation::new(&[], (0.0, 1.0), 0.1, family).run(&guess, 0.0).unwrap();
    assert_eq!((branch.points.len(), branch.ended), (1, Some(AnalysisError::DependsOnTime)));
    // A length has no derivative where it vanishes, which is no matter of time.
    #[affine_model(dim = 2, kinetic(dalembert = 1, space_translation = 1), potential = cosh(norm(x)) + tr(G)/2 - ln(det))]
    struct Cusped;
    let none = Vector::<2>::zeros();
    let guess = Cusped.at_velocity(none, Matrix::<2>::identity(), none, Matrix::<2>::zeros()).unwrap();
    let error = equilibrium(&Cusped, &guess).unwrap_err();
    assert!(error.to_string().ends_with("the equations have no value there"), "{error}");
    // Straight lines do not rest.
    #[affine_model(dim = 2, kinetic(dalembert = 1), potential = phi[1,1])]
    struct Falling;
    let guess = Falling.at_velocity(Matrix::<2>::identity(), Matrix::<2>::zeros()).unwrap();
    let error = equilibrium(&Falling, &guess).unwrap_err();
    assert!(matches!(error, AnalysisError::NoConvergence { .. }), "{error}");
}

/// Conditions count the generators that are free, and ask for numbers.
#[test]
fn conditions_that_ask_nothing_are_refused() {
    let disc = Disc { i: 1.0, kappa: 4.0, c1: 0.3 }.prepare().unwrap();
    let guess = disc.at_velocity(Matrix::<2>::identity(), turning(0.3)).unwrap();
    let turn = Generator::rotation(1, 2);
    for (generators, condition) in [
        (&[turn][..], Condition::Velocity(1, 0.3)),
        (&[turn], Condition::MomentumMap(7, 0.3)),
        (&[], Condition::Velocity(0, 0.3)),
        (&[turn], Condition::Velocity(0, f64::NAN)),
        (&[turn, turn], Condition::MomentumMap(1, f64::INFINITY)),
    ] {
        let error = relative_equilibrium(&disc, &guess, generators, &[condition]).unwrap_err();
        let count = generators.len();
        let is_named = matches!(error, AnalysisError::Condition { generators, .. } if generators == count);
        assert!(is_named, "{condition:?}: {error}");
    }
}

/// Forces that are small beside the velocities of momenta of order 1 are not taken for rounding: there is the equilibrium, or none.
#[test]
fn a_guess_is_not_taken_for_rest_in_other_units() {
    for mass in [1e-60, 1e-30, 1e-15, 1e-6, 1e-3, 1.0, 1e3, 1e6, 1e15, 1e30] {
        for stiffness in [1e-30, 1e-6, 1.0, 1e6, 1e30] {
            let disc = Disc { i: mass, kappa: 4.0 * stiffness, c1: 0.3 * stiffness }.prepare().unwrap();
            let guess = disc.at_velocity(Matrix::<2>::identity() * 1.1, Matrix::<2>::zeros()).unwrap();
            match equilibrium(&disc, &guess) {
                Ok(rest) => {
                    let off = (rest.point.phi() - Matrix::<2>::identity()).norm();
                    assert!(off < 1e-10, "{mass:e}, {stiffness:e}: {off:e}");
                }
                Err(error) => {
                    assert!(matches!(error, AnalysisError::NoConvergence { .. }), "{error}");
                    let balance = (mass * stiffness).sqrt();
                    assert!(!(1e-3..=1e3).contains(&balance), "{mass:e}, {stiffness:e}: {error}");
                }
            }
        }
    }
}
