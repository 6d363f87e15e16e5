//! Discs and bodies that turn, fly, or move along geodesics.

use affine_runtime::analysis::{
    AnalysisError, BranchPoint, Condition, Continuation, Generator, Special, StabilityVerdict,
    relative_equilibrium,
};
use affine_runtime::model::Model;
use affine_runtime::prelude::*;

use super::{Row, assert_frequencies, assert_near, frequencies, turned};
use crate::models::{
    Disc, Flat, FlatGeodesic, FlatMissile, Geodesic, Left, Logarithmic, Missile, RightGeodesic, Round, Soft,
    Vibrating, exponential, turning, unrest,
};

pub(super) fn assert_row(row: &Row) {
    match row.text("kind") {
        "rotating disc" => assert_disc(row),
        "rotating disc, critical points" => assert_critical_points(row),
        "elongated branch (planar Jacobi)" => assert_elongated(row),
        "planar Riemann" => assert_ellipse(row),
        "rotating disc, fold in omega" => assert_fold(row),
        "spinning body" if row.text("model").starts_with("dalembert") => assert_flattened(row),
        "spinning body" => assert_undeformed(row),
        "steady flight" if row.count("n") == 3 => {
            let one = Matrix::<3>::identity();
            let zero = Vector::<3>::zeros();
            let guess = Missile.at_velocity(zero, one, Vector::<3>::new(0.4, 0.0, 0.0), one * 0.0);
            assert_flight(&Missile, &guess.unwrap(), row);
        }
        "steady flight" => {
            let one = Matrix::<2>::identity();
            let zero = Vector::<2>::zeros();
            let guess = FlatMissile.at_velocity(zero, one, Vector::<2>::new(0.4, 0.0), one * 0.0);
            assert_flight(&FlatMissile, &guess.unwrap(), row);
        }
        "geodesic generator" => assert_normal_generator(row),
        "geodesic generator, anisotropic" => assert_anisotropic_generator(row),
        "stationary rotation of a soft body" => assert_stationary(row),
        other => panic!("no kind {other}"),
    }
}

fn disc(row: &Row) -> Disc {
    let [i, kappa, c1] = ["I", "kappa", "c1"].map(|name| row.parameter(name));
    Disc { i, kappa, c1 }
}

fn about_the_axis<const N: usize>() -> [Generator<N>; 1] {
    [Generator::rotation(1, 2)]
}

/// At a stretch, with the spin that belongs to it: breathing at every spin, and a bar mode that decides on stability. Which `zeta`
/// shows it is another matter.
fn assert_disc(row: &Row) {
    let disc = disc(row).prepare().unwrap();
    let (a, omega, spin) = (row.parameter("a"), row.number("omega"), row.number("spin_S12"));
    let phi = Matrix::<2>::identity() * (0.99 * a);
    let guess = disc.at_velocity(phi, turning(0.98 * omega) * phi).unwrap();
    let by_momentum =
        relative_equilibrium(&disc, &guess, &about_the_axis(), &[Condition::MomentumMap(0, spin)]).unwrap();
    let by_velocity =
        relative_equilibrium(&disc, &guess, &about_the_axis(), &[Condition::Velocity(0, omega)]).unwrap();
    for found in [&by_momentum, &by_velocity] {
        let phi = found.point.phi();
        let known = [found.velocities[0], phi[(0, 0)].hypot(phi[(1, 0)]), found.point.spin().0.0[(0, 1)]];
        assert_near(&known, &[omega, a, spin], 1e-12);
    }
    let breathing = row.number("breathing");
    let bar = row.number("bar_frequency_squared_nonrotating");
    let stability = by_velocity.stability(&disc).unwrap();
    assert_eq!(stability.isotropy, 1);
    assert!(frequencies(&stability).iter().any(|one| (one - breathing).abs() < 1e-12));
    assert_eq!(stability.stiffnesses[0] > 0.0, row.is("frame_xi_definite"), "{stability:?}");
    let shared = turned(&disc, phi, [omega / 2.0; 2], |phi, rate| disc.at_velocity(phi, rate)).unwrap();
    let shared = shared.stability(&disc).unwrap();
    assert_eq!(shared.stiffnesses[0] > 0.0, row.is("frame_xi_half_eta_half_definite"), "{shared:?}");
    match (stability.verdict, shared.verdict, row.text("stability")) {
        (StabilityVerdict::Stable, StabilityVerdict::Stable, "stable") => {
            assert_frequencies(&shared, &[breathing, bar.sqrt()], &[], 1e-12);
            assert!(unrest(&disc, &by_momentum, 50.0) < 1e-9);
        }
        (StabilityVerdict::Unstable { rate }, StabilityVerdict::Unstable { rate: of_shared }, "unstable") => {
            assert_near(&[rate, of_shared], &[(-bar).sqrt(); 2], 1e-12)
        }
        other => panic!("{other:?}"),
    }
}

/// From rest by the momentum, the planar Maclaurin: where others branch off, and where it breaks.
fn assert_critical_points(row: &Row) {
    let family = |spin: f64| {
        let disc = disc(row).prepare()?;
        Ok((disc, vec![Condition::MomentumMap(0, spin)]))
    };
    let (turn, last) = (about_the_axis(), row.number("dynamical/spin_S12"));
    let continuation = Continuation::new(&turn, (-0.01, 1.1 * last), 0.3 * last.min(0.5), family);
    let model = disc(row).prepare().unwrap();
    let one = Matrix::<2>::identity();
    let round = continuation.run(&model.at_velocity(one, one * 0.0).unwrap(), 0.0).unwrap();
    let expected = [(Special::Bifurcation, "bifurcation"), (Special::Collision, "dynamical")];
    assert_eq!(round.special.len(), expected.len(), "{round}");
    for ((kind, point), (expected, name)) in round.special.iter().zip(expected) {
        assert_eq!(*kind, expected, "{round}");
        let found = [point.stretches()[0], point.turn.velocities[0], point.parameter];
        let known = ["a", "omega", "spin_S12"].map(|of| row.number(&format!("{name}/{of}")));
        assert_near(&found, &known, 1e-9);
    }
    // No disc turns faster.
    let supremum = row.number("omega_supremum");
    let guess = model.at_velocity(one * 5.0, turning(supremum) * one * 5.0).unwrap();
    let at = |omega| relative_equilibrium(&model, &guess, &turn, &[Condition::Velocity(0, omega)]);
    assert!(matches!(at(1.001 * supremum), Err(AnalysisError::NoConvergence { .. })));
    assert!(at(0.999 * supremum).is_ok());
}

/// On the branch of the planar Jacobi, by the spin.
fn assert_elongated(row: &Row) {
    let disc = disc(row).prepare().unwrap();
    let stretches = row.array("stretches");
    let phi = Matrix::<2>::from_diagonal(&stretches.into());
    let omega = row.number("omega");
    let guess = disc.at_velocity(phi * 1.01, turning(omega) * phi).unwrap();
    let spin = Condition::MomentumMap(0, row.number("spin_S12"));
    let found = relative_equilibrium(&disc, &guess, &about_the_axis(), &[spin]).unwrap().isolated().unwrap();
    let columns = [0, 1].map(|a| found.point.phi().column(a).norm());
    assert_near(&columns, &stretches, 1e-12);
    assert_near(&found.velocities, &[omega], 1e-13);
    assert!(unrest(&disc, &found, 50.0) < 1e-9);
    let stability = found.stability(&disc).unwrap();
    assert_eq!(stability.verdict, StabilityVerdict::Stable);
    assert_eq!(stability.eigenvalues.len() + row.count("zero_eigenvalues"), 8);
    let radial: Vec<f64> = row.numbers("radial_frequencies_squared").into_iter().map(f64::sqrt).collect();
    assert_near(&frequencies(&stability), &radial, 1e-12);
}

/// Turned in space and in the body at once.
fn assert_ellipse(row: &Row) {
    let disc = disc(row).prepare().unwrap();
    let stretches = row.array("parameters/stretches");
    let velocities = ["Omega_left", "lambda_right"].map(|name| row.number(name));
    let near = Matrix::<2>::from_diagonal(&stretches.map(|one| one * 0.98).into());
    let found = turned(&disc, near, velocities, |phi, rate| disc.at_velocity(phi, rate)).unwrap();
    let columns = [0, 1].map(|a| found.point.phi().column(a).norm());
    assert_near(&columns, &stretches, 1e-12);
    assert!(unrest(&disc, &found, 50.0) < 1e-9);
    let stability = found.stability(&disc).unwrap();
    assert_eq!((stability.verdict, row.text("stability")), (StabilityVerdict::Stable, "stable"));
    let radial: Vec<f64> = row.numbers("radial_frequencies_squared").into_iter().map(f64::sqrt).collect();
    assert_frequencies(&stability, &radial, &[], 1e-12);
}

/// Against the velocity the branch turns back, and stays stable.
fn assert_fold(row: &Row) {
    let [i, kappa, a] = ["I", "kappa", "a"].map(|name| row.parameter(name));
    let fields = Logarithmic { i, kappa };
    let model = fields.prepare().unwrap();
    let spin = Condition::MomentumMap(0, row.number("spin_S12"));
    let phi = Matrix::<2>::identity() * (0.98 * a);
    let guess = model.at_velocity(phi, turning(row.number("omega")) * phi).unwrap();
    let found = relative_equilibrium(&model, &guess, &about_the_axis(), &[spin]).unwrap();
    assert_near(&found.velocities, &[row.number("omega")], 1e-13);
    let phi = found.point.phi();
    assert!((phi[(0, 0)].hypot(phi[(1, 0)]) - a).abs() < 1e-12);
    let breathing = row.number("breathing");
    let stability = found.stability(&model).unwrap();
    assert!(frequencies(&stability).iter().any(|one| (one - breathing).abs() < 1e-12), "{stability:?}");

    let by_velocity = |omega: f64| Ok((fields.prepare()?, vec![Condition::Velocity(0, omega)]));
    let guess = model.at_velocity(Matrix::<2>::identity(), turning(0.3)).unwrap();
    let branch =
        Continuation::new(&about_the_axis(), (0.2, 1.0), 0.15, by_velocity).run(&guess, 0.3).unwrap();
    let [(Special::Fold, fold)] = branch.special.as_slice() else { panic!("{branch}") };
    assert!((fold.parameter - row.number("fold_of_omega/omega")).abs() < 1e-12, "{branch}");
    assert!((fold.stretches()[0] - row.number("fold_of_omega/a")).abs() < 1e-9, "{branch}");
    let stable = |point: &BranchPoint<2, _>| point.stability.verdict == StabilityVerdict::Stable;
    assert!(branch.points.iter().all(stable));
    assert!(branch.points.iter().any(|point| point.stretches()[0] > a), "{branch}");
}

/// Frequencies of a body that turns about the last axis, in the frame that turns with it.
fn assert_spectrum<const N: usize, M: Model<N>>(
    model: &M,
    guess: &M::Point<f64>,
    known: &[f64],
    row: &Row,
) -> M::Point<f64> {
    let omega = row.parameter("omega");
    let condition = [Condition::Velocity(0, omega)];
    let found = relative_equilibrium(model, guess, &about_the_axis(), &condition).unwrap();
    assert!(unrest(model, &found, 10.0) < 1e-9);
    let stability = found.stability(model).unwrap();
    assert!(!matches!(stability.verdict, StabilityVerdict::Unstable { .. }), "{:?}", stability.verdict);
    let known: Vec<f64> = known.iter().copied().filter(|one| (one - omega).abs() > 1e-12).collect();
    assert_frequencies(&stability, &known, &[omega], 1e-11);
    found.point
}

/// D'Alembert's inertia: flattened, with waves around the axis.
fn assert_flattened(row: &Row) {
    let [i, lam, mu, omega] = ["I", "lam", "mu", "omega"].map(|name| row.parameter(name));
    assert!(i == 1.0 && row.numbers("growth").is_empty());
    let model = Round { lam, mu }.prepare().unwrap();
    let (a, c) = (row.number("a"), row.number("c"));
    let phi = Matrix::<3>::from_diagonal(&Vector::<3>::new(a, a, c).add_scalar(0.01));
    let guess = model.at_velocity(phi, turning::<3>(omega) * phi).unwrap();
    let known = ["m0", "m1_in_rotating_frame", "m2_in_rotating_frame"].map(|name| row.numbers(name)).concat();
    let point = assert_spectrum(&model, &guess, &known, row);
    assert_near(&[0, 1, 2].map(|k| point.phi().column(k).norm()), &[a, a, c], 1e-12);
    assert!((point.spin().0.0[(0, 1)].abs() - row.number("spin_S12")).abs() < 1e-12);
}

/// Invariant kinetic energies: what spins is not deformed, and its bar mode is seen shifted.
fn assert_undeformed(row: &Row) {
    let known = row.numbers("frequencies_in_left_frame");
    let (bar, shift) = (row.number("bar_frequency"), row.number("bar_shift_of_left_frame"));
    for one in [row.number("breathing"), (bar - shift).abs(), bar + shift] {
        assert!(known.iter().any(|known| (known - one).abs() < 1e-14));
    }
    let omega = row.parameter("omega");
    if row.count("n") == 2 {
        let guess = Flat.at_velocity(Matrix::<2>::identity(), turning(omega)).unwrap();
        assert_spectrum(&Flat, &guess, &known, row);
    } else {
        let guess = Vibrating.at_velocity(Matrix::<3>::identity(), turning(omega)).unwrap();
        assert_spectrum(&Vibrating, &guess, &known, row);
    }
}

/// Compressed along the flight, with frequencies and their multiplicities.
fn assert_flight<const N: usize, M: Model<N>>(model: &M, guess: &M::Point<f64>, row: &Row) {
    let momentum = [Condition::MomentumMap(0, row.parameter("p"))];
    let found = relative_equilibrium(model, guess, &[Generator::translation(1)], &momentum).unwrap();
    assert_near(&found.velocities, &[row.number("x_dot")], 1e-13);
    let columns: Vec<f64> = (0..N).map(|a| found.point.phi().column(a).norm()).collect();
    assert_near(&columns, &row.numbers("stretches"), 1e-13);
    let stability = found.stability(model).unwrap();
    let moving: Vec<f64> = frequencies(&stability).into_iter().filter(|one| *one > 1e-3).collect();
    assert_near(&moving, &row.numbers("frequencies"), 1e-11);
    assert!(row.numbers("growth").is_empty());
    assert!(stability.eigenvalues.iter().all(|one| one.value.re.abs() <= one.error));
}

/// `phi0 exp(F t)` or `exp(F t) phi0` of isotropic geodesics, where `F` is normal.
fn assert_normal_generator(row: &Row) {
    let (f, phi) = (row.matrix::<3>("parameters/F"), row.matrix::<3>("parameters/phi0"));
    let [i, a, b] = ["I", "A", "B"].map(|name| row.parameter(name));
    let inverse = phi.try_inverse().unwrap();
    if row.text("model") == "L" {
        let model = Left { i, a, b }.prepare().unwrap();
        let generator = Generator { space: phi * f * inverse, ..Generator::zero() };
        let guess = model.at_velocity(phi, phi * f).unwrap();
        assert_generator(&model, &guess, generator, phi * exponential(f), row);
    } else {
        let model = RightGeodesic { i, a, b }.prepare().unwrap();
        let generator = Generator { body: inverse * f * phi, ..Generator::zero() };
        let guess = model.at_velocity(phi, f * phi).unwrap();
        assert_generator(&model, &guess, generator, exponential(f) * phi, row);
    }
}

fn assert_generator<M: Model<3>>(
    model: &M,
    guess: &M::Point<f64>,
    generator: Generator<3>,
    generated: Matrix<3>,
    row: &Row,
) {
    let end = row.matrix::<3>("phi_at_1");
    let run = Simulation::new(model, *guess).until(1.0).tolerance(1e-13).run().unwrap();
    assert!((run.end().1.phi() - end).norm() < 1e-11);
    let missed = row.number("phi0_exp_F_minus_phi_at_1_max");
    assert!(((generated - end).amax() - missed).abs() < 1e-12);
    let is_one = row.is("is_relative_equilibrium");
    assert_eq!(is_one, row.number("normality_defect_max") == 0.0);
    let found = relative_equilibrium(model, guess, &[generator], &[Condition::Velocity(0, 1.0)]);
    if is_one {
        let found = found.unwrap();
        assert!((found.point.phi() - guess.phi()).norm() < 1e-12 && found.residual < 1e-13);
        assert!(unrest(model, &found, 2.0) < 1e-10);
    } else {
        // Another motion, if any.
        assert!(found.map_or(true, |found| (found.point.phi() - guess.phi()).norm() > 1e-3));
    }
}

/// Of an anisotropic inertia: `F = R diag(s)`, which is not normal.
fn assert_anisotropic_generator(row: &Row) {
    let one = [Condition::Velocity(0, 1.0)];
    if row.numbers("parameters/j").len() == 3 {
        let (f, end) = (row.matrix::<3>("F"), row.matrix::<3>("exp_F"));
        let phi = Matrix::<3>::new(1.1, 0.2, -0.1, 0.05, 0.9, 0.15, -0.2, 0.1, 1.05);
        let generator = Generator { space: phi * f * phi.try_inverse().unwrap(), ..Generator::zero() };
        let guess = Geodesic.at_velocity(phi, phi * f).unwrap();
        let found = relative_equilibrium(&Geodesic, &guess, &[generator], &one).unwrap();
        assert!((found.point.phi() - phi).norm() < 1e-12 && found.residual < 1e-13);
        assert!((exponential(found.zeta.space) * phi - phi * end).norm() < 1e-12);
        assert!(unrest(&Geodesic, &found, 2.0) < 1e-10);
    } else {
        let (f, end) = (row.matrix::<2>("F"), row.matrix::<2>("exp_F"));
        let phi = Matrix::<2>::new(1.1, 0.2, 0.05, 0.9);
        let generator = Generator { space: phi * f * phi.try_inverse().unwrap(), ..Generator::zero() };
        let guess = FlatGeodesic.at_velocity(phi, phi * f).unwrap();
        let found = relative_equilibrium(&FlatGeodesic, &guess, &[generator], &one).unwrap();
        assert!((found.point.phi() - phi).norm() < 1e-12 && found.residual < 1e-13);
        assert!((exponential(found.zeta.space) * phi - phi * end).norm() < 1e-12);
        assert!(unrest(&FlatGeodesic, &found, 2.0) < 1e-10);
    }
}

/// A soft body about each of its axes: the middle one grows.
fn assert_stationary(row: &Row) {
    let [lam, mu, omega] = ["lam", "mu", "omega"].map(|name| row.parameter(name));
    assert_eq!((lam, mu, row.array("parameters/j")), (1.0, 5.0, [1.0, 1.5, 2.0]));
    let axis = row.count("parameters/axis");
    let turn = Generator::<3>::rotation(axis % 3 + 1, (axis + 1) % 3 + 1);
    let guess = Soft.at_velocity(Matrix::<3>::identity(), turn.space * omega).unwrap();
    let condition = [Condition::Velocity(0, omega)];
    let found = relative_equilibrium(&Soft, &guess, &[turn], &condition).unwrap().isolated().unwrap();
    assert_near(&[0, 1, 2].map(|a| found.point.phi().column(a).norm()), &row.numbers("stretches"), 1e-12);
    let stability = found.stability(&Soft).unwrap();
    let known: Vec<f64> = row.numbers("frequencies_in_rotating_frame");
    let known: Vec<f64> = known.into_iter().filter(|one| (one - omega).abs() > 1e-12).collect();
    assert_frequencies(&stability, &known, &[omega], 1e-11);
    match (stability.verdict, row.numbers("growth").as_slice()) {
        (StabilityVerdict::Unstable { rate }, [growth]) => assert!((rate - growth).abs() < 1e-11, "{rate}"),
        (StabilityVerdict::Stable | StabilityVerdict::LinearlyStable, []) => {}
        other => panic!("{other:?}"),
    }
}
