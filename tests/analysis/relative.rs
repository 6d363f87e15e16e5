//! Equilibria and relative equilibria that are known, and that they stay so.

use affine_runtime::analysis::{
    AnalysisError, Condition, Generator, StabilityVerdict, equilibrium, relative_equilibrium,
};
use affine_runtime::prelude::*;

use crate::models::{Disc, Geodesic, Missile, Soft, exponential, turning, unrest};

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

/// Rows "geodesic generator": `phi0 exp(F t)` and `exp(F t) phi0` of isotropic geodesics, where `F` is normal.
#[test]
fn normal_matrices_generate_isotropic_geodesics() {
    #[affine_model(dim = 3, kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1))]
    struct Left;
    #[affine_model(dim = 3, kinetic(casimir2 = 0.2, casimir1_squared = 0.1, space_inertia = 1))]
    struct Right;
    let phi = Matrix::<3>::new(1.1, 0.2, -0.1, 0.05, 0.9, 0.15, -0.2, 0.1, 1.05);
    let inverse = phi.try_inverse().unwrap();
    let one = [Condition::Velocity(0, 1.0)];

    let f = Matrix::<3>::new(0.0, -1.0, 0.5, 1.0, 0.0, 0.25, -0.5, -0.25, 0.0);
    let guess = Left.at_velocity(phi, phi * f).unwrap();
    let generator = Generator { space: phi * f * inverse, ..Generator::zero() };
    let found = relative_equilibrium(&Left, &guess, &[generator], &one).unwrap();
    let end = Matrix::<3>::new(
        0.6832727441426091,
        -0.8338622366615205,
        0.3127493043664125,
        0.6108854916102383,
        0.4331338596790195,
        0.5236544430630499,
        -0.5491363453678394,
        0.2489467951421426,
        0.8882425160869689,
    );
    assert!((exponential(found.zeta.space) * found.point.phi() - end).norm() < 1e-12);
    assert!(unrest(&Left, &found, 10.0) < 1e-10);

    let f = Matrix::<3>::new(0.3, -0.7, 0.0, 0.7, 0.3, 0.0, 0.0, 0.0, -0.4);
    let guess = Right.at_velocity(phi, f * phi).unwrap();
    let generator = Generator { body: inverse * f * phi, ..Generator::zero() };
    let found = relative_equilibrium(&Right, &guess, &[generator], &one).unwrap();
    let end = Matrix::<3>::new(
        1.0921917132471257,
        -0.5761568346203039,
        -0.2336833341582722,
        1.0081846591710273,
        1.1031066504433034,
        0.06790405252534522,
        -0.13406400920712785,
        0.06703200460356393,
        0.7038360483374213,
    );
    assert!((found.point.phi() * exponential(found.zeta.body) - end).norm() < 1e-12);
    assert!(unrest(&Right, &found, 2.0) < 1e-10);
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
