//! Self-gravitating ellipsoids: the ball, spheroids of Maclaurin, ellipsoids of Jacobi and of Riemann's type S.

use affine_runtime::analysis::{
    BranchPoint, Condition, Continuation, Doubt, Generator, ModeClass, RelativeEquilibrium, Special,
    StabilityVerdict, equilibrium,
};
use affine_runtime::model::Model;
use affine_runtime::prelude::*;

use super::{Row, assert_frequencies, assert_near, assert_paired, turned};
use crate::gravity::{PI_G_RHO, STAR, Star};
use crate::models::unrest;

type Point = <Star as Model<3>>::Point<f64>;

pub(super) fn assert_row(row: &Row) {
    match row.text("kind") {
        "sphere" => assert_ball(row),
        "Maclaurin, critical" => assert_critical(row),
        "Maclaurin" => assert_spheroid(row),
        "Maclaurin, energy-momentum" => assert_signatures(row),
        "Jacobi" | "Riemann S-type" => assert_ellipsoid(row),
        "Riemann S-type, zero eigenvalue (tilted branch)" => assert_tilted_branch(row),
        other => panic!("no kind {other}"),
    }
}

/// Of volume 1, from the proportions of its axes.
fn ellipsoid(axes: [f64; 3]) -> Matrix<3> {
    let size = axes.iter().product::<f64>().cbrt();
    Matrix::<3>::from_diagonal(&Vector::<3>::from(axes.map(|axis| axis / size)))
}

/// In units of `pi G rho`.
fn unit(frequency: f64) -> f64 {
    frequency * PI_G_RHO.sqrt()
}

/// Found from beside where it is.
fn found(axes: [f64; 3], velocities: [f64; 2]) -> RelativeEquilibrium<3, Point> {
    let beside = Matrix::<3>::from_diagonal(&Vector::<3>::new(1.005, 1.0, 1.0 / 1.005)) * ellipsoid(axes);
    let start = |phi, rate| STAR.at_velocity(phi, rate);
    let found = turned(&STAR, beside, velocities.map(unit), start).unwrap();
    let columns = [0, 1, 2].map(|k| found.point.phi().column(k).norm());
    let known = [0, 1, 2].map(|k| ellipsoid(axes)[(k, k)]);
    assert_near(&columns, &known, 1e-12);
    found
}

fn assert_ball(row: &Row) {
    let guess = STAR.at_velocity(ellipsoid([1.02, 1.0, 0.97]), Matrix::<3>::zeros()).unwrap();
    let modes = equilibrium(&STAR, &guess).unwrap().isolated().unwrap().modes(&STAR).unwrap();
    let [shear] = modes.modes.as_slice() else { panic!("{modes}") };
    assert_eq!((shear.class, shear.multiplicity(), modes.zeros), (ModeClass::Shear, 5, 3));
    assert!((shear.squared / PI_G_RHO - row.number("omega2_l2_fivefold")).abs() < 1e-12, "{modes}");
}

/// By continuation from the ball at rest.
fn assert_critical(row: &Row) {
    let along = |spin: f64| Ok((STAR, vec![Condition::MomentumMap(0, spin)]));
    let ball = STAR.at_velocity(Matrix::<3>::identity(), Matrix::<3>::zeros()).unwrap();
    let (kind, last) = match row.text("which") {
        "bifurcation" => (Special::Bifurcation, 0.37),
        "dynamical" => (Special::Collision, 0.55),
        other => panic!("no point {other}"),
    };
    let turn = [Generator::rotation(1, 2)];
    let branch = Continuation::new(&turn, (-0.01, last), 0.08, along).run(&ball, 0.0).unwrap();
    let own = |point: &&(Special, BranchPoint<3, _>)| point.0 == kind;
    let (_, point) = branch.special.iter().find(own).unwrap_or_else(|| panic!("{branch}"));
    let axes = point.stretches();
    let ratio = axes[2] / axes[0];
    let squared = point.turn.velocities[0].powi(2) / PI_G_RHO;
    let found = [ratio, (1.0 - ratio * ratio).sqrt(), squared];
    assert_near(&found, &["c_over_a", "e", "Omega2"].map(|name| row.number(name)), 1e-10);
}

fn spheroid(e: f64) -> [f64; 3] {
    [1.0, 1.0, ((1.0 - e) * (1.0 + e)).sqrt()]
}

fn assert_spheroid(row: &Row) {
    let axes = spheroid(row.parameter("e"));
    assert!((axes[2] - row.number("c_over_a")).abs() < 1e-15);
    let omega = row.number("Omega2").sqrt();
    let turn = found(axes, [omega, 0.0]);
    let stability = turn.stability(&STAR).unwrap();
    let is_stable = row.text("stability") == "stable";
    let mut known = vec![row.number("m0_frequency")];
    known.extend(row.numbers("m1_in_rotating_frame"));
    if is_stable {
        known.extend(row.numbers("bar_in_rotating_frame"));
        assert_eq!(stability.verdict, StabilityVerdict::Stable);
    } else {
        known.push(row.number("bar_in_rotating_frame/im"));
        let StabilityVerdict::Unstable { rate } = stability.verdict else { panic!("{stability:?}") };
        assert!((rate - unit(row.number("bar_in_rotating_frame/re"))).abs() < 1e-12, "{rate}");
    }
    // The axis tilts by omega, which momenta leave out.
    known.retain(|one| (one - omega).abs() > 1e-12);
    let known: Vec<f64> = known.into_iter().map(unit).collect();
    assert_frequencies(&stability, &known, &[unit(omega)], 1e-12);
    let shared = found(axes, [omega / 2.0; 2]).stability(&STAR).unwrap();
    let bar = row.number("bar_frequency_squared_half_half_frame") * PI_G_RHO;
    let squares: Vec<f64> = shared.eigenvalues.iter().map(|one| -(one.value * one.value).re).collect();
    assert!(squares.iter().any(|one| (one - bar).abs() < 1e-12), "{bar} is not among {squares:?}");
}

/// With isotropy the second variation depends on the choice of `zeta`.
fn assert_signatures(row: &Row) {
    let e = row.parameter("e");
    // Chandrasekhar, section 32.
    let polar = (1.0 - e) * (1.0 + e);
    let omega = 2.0 * polar.sqrt() / e.powi(3) * (3.0 - 2.0 * e * e) * e.asin() - 6.0 * polar / (e * e);
    let omega = omega.sqrt();
    for (name, velocities) in [
        ("xi=Omega,eta=0", [omega, 0.0]),
        ("xi=eta=Omega~12", [omega / 2.0; 2]),
        ("xi=0,eta=Omega", [0.0, omega]),
    ] {
        let known = row.at(&format!("signature_plus_minus_zero/{name}"));
        let [positive, negative, zero] = [0, 1, 2].map(|k| known[k].as_u64().unwrap() as usize);
        let stability = found(spheroid(e), velocities).stability(&STAR).unwrap();
        let own = stability.stiffnesses.iter().filter(|one| **one < 0.0).count();
        assert_eq!((stability.stiffnesses.len() - own, own), (positive, negative), "{name}");
        // Of the zeta for which it is nearest to definite.
        let best = row.number("bar_frequency_squared_half_half_frame") > 0.0;
        let expected = if best { (10, 0, zero) } else { (8, 2, zero) };
        assert_eq!(stability.signature, Some(expected), "{name}");
    }
}

fn proportions(row: &Row) -> [f64; 3] {
    let c = if row.has("c_over_a") { row.number("c_over_a") } else { row.parameter("c_over_a") };
    [1.0, row.parameter("b_over_a"), c]
}

fn assert_ellipsoid(row: &Row) {
    let velocities = ["Omega_left", "lambda_right"].map(|name| row.number(name));
    let turn = found(proportions(row), velocities).isolated().unwrap();
    let stability = turn.stability(&STAR).unwrap();
    let signature = [0, 1, 2].map(|k| row.at("signature_plus_minus_zero")[k].as_u64().unwrap() as usize);
    let [positive, negative, zero] = signature;
    assert_eq!(stability.signature, Some((positive, negative, zero)));
    match (stability.verdict, row.text("stability")) {
        (StabilityVerdict::Stable, "stable") => assert!(!row.has("odd_growth/0")),
        (StabilityVerdict::Unstable { rate }, "unstable") => {
            assert!((rate - unit(row.number("odd_growth/0/0"))).abs() < 1e-12, "{rate}");
        }
        other => panic!("{other:?}"),
    }
    let mut known: Vec<f64> = row.numbers("even_squared").into_iter().map(f64::sqrt).collect();
    known.extend(row.numbers("odd_frequencies"));
    // The axes tilt in space and in the body, which momenta leave out.
    let tilts = velocities.map(|one| unit(one.abs()));
    let mut known: Vec<f64> = known.into_iter().map(unit).collect();
    known.retain(|one| tilts.iter().all(|tilt| (one - tilt).abs() > 1e-12));
    assert_frequencies(&stability, &known, &tilts, 1e-12);
    if row.text("kind") == "Jacobi" {
        assert!(unrest(&STAR, &turn, 3.0) < 1e-9);
    }
}

/// Where ellipsoids with tilted axes branch off: no stiffness is left in one direction, and the point is not alone.
fn assert_tilted_branch(row: &Row) {
    let velocities = ["Omega_left", "lambda_right"].map(|name| row.number(name));
    let turn = found(proportions(row), velocities);
    let stability = turn.stability(&STAR).unwrap();
    assert_paired(&stability);
    assert_eq!(stability.verdict, StabilityVerdict::Undecided(Doubt::ZeroMode));
    let known = unit(row.number("other_odd_frequency"));
    assert!(stability.eigenvalues.iter().any(|one| (one.value.im - known).abs() < 1e-11));
    let degenerate = turn.isolated().unwrap_err().to_string();
    assert_eq!(degenerate, "solutions go on in 1 directions where 0 are expected");
}
