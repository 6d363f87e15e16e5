//! Stiff dilatation and stiff shear.

use affine_runtime::decompose::LinearMap;
use affine_runtime::prelude::*;
use affine_runtime::report::{Demand, Oracle, StabilityReport};

use super::reference::{Row, rows};
use super::shared::{apart, energy, floor, relative_distance, run, scene};

const P2: &str = include_str!("../../../tests/data/p2.csv");
const P2R: &str = include_str!("../../../tests/data/p2r.csv");
const P6: &str = include_str!("../../../tests/data/p6.csv");
const P7: &str = include_str!("../../../tests/data/p7.csv");
const P8: &str = include_str!("../../../tests/data/p8.csv");

#[affine_model(
    dim = 3,
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1),
    potential = hyperbolic_dilatation(kappa) + neo_hookean(c),
)]
pub(crate) struct Stiff {
    kappa: f64,
    c: f64,
}

#[affine_model(
    dim = 3,
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, space_inertia = 1),
    potential = hyperbolic_dilatation(kappa) + neo_hookean(0.5),
)]
pub(crate) struct Mirrored {
    kappa: f64,
}

#[affine_model(
    dim = 2,
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1),
    potential = hyperbolic_dilatation(kappa) + neo_hookean(0.5),
)]
pub(crate) struct Planar {
    kappa: f64,
}

#[affine_model(
    dim = 2,
    constraint = isochoric,
    kinetic(casimir2 = 0.2, body_inertia = 1),
    potential = neo_hookean(0.5),
)]
pub(crate) struct ConfinedPlanar;

#[affine_model(
    dim = 3,
    kinetic(dalembert = diag(1, 1.5, 2)),
    potential = hyperbolic_dilatation(kappa) + neo_hookean(0.5),
)]
pub(crate) struct Elastic {
    kappa: f64,
}

#[affine_model(dim = 3, constraint = isochoric, kinetic(dalembert = diag(1, 1.5, 2)), potential = neo_hookean(0.5))]
pub(crate) struct ConfinedElastic;

#[affine_model(
    dim = 3,
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, body_translation = 1),
    potential = hyperbolic_dilatation(kappa) + neo_hookean(0.5),
)]
pub(crate) struct Missile {
    kappa: f64,
}

#[affine_model(
    dim = 3,
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, body_translation = 1),
    potential = hyperbolic_dilatation(kappa) + neo_hookean(0.5),
    emit(splitting),
)]
pub(crate) struct SplitMissile {
    kappa: f64,
}

#[affine_model(
    dim = 3,
    constraint = isochoric,
    kinetic(casimir2 = 0.2, body_inertia = 1, body_translation = 1),
    potential = neo_hookean(0.5),
)]
pub(crate) struct ConfinedMissile;

/// A tolerance for pictures.
const LOOSE: f64 = 1e-3;

pub(super) const KAPPAS: [f64; 11] = [1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12];

pub(super) fn cases(report: &mut StabilityReport) -> affine_runtime::Result<()> {
    report.heading("stiff dilatation, separable");
    separable(report)?;
    separable_in_the_plane(report)?;
    report.heading("stiff dilatation, not separable");
    elastic(report)?;
    missile(report)?;
    super::stiff_in_the_plane::cases(report)?;
    report.heading("stiff shear");
    shear(report)
}

/// The isochoric part of the motion does not know `kappa`: it is that of the reference for `kappa = 10`.
fn separable(report: &mut StabilityReport) -> affine_runtime::Result<()> {
    let error =
        |phi: &Matrix<3>, row: &Row| relative_distance(&phi.isochoric_part(), &row.phi.isochoric_part());
    for kappa in KAPPAS {
        let named = |model, quantity, oracle| scene(model, 3, format!("kappa = {kappa:e}"), quantity, oracle);
        let (reference, mirrored) = (rows(P2), rows(P2R));
        let ([start, .., end], [start_r, .., end_r]) = (reference.as_slice(), mirrored.as_slice()) else {
            return Ok(());
        };
        let model = Stiff { kappa, c: 0.5 }.prepare()?;
        let solution = run(&model, model.at_momentum(start.phi, Comoving(start.spin))?, end.t);
        let solution = solution?;
        report.case(named("body-metric", "Psi, t = 50", Oracle::Reference), Demand::Held(1e-9), || {
            Ok((error(solution.end().1.phi(), end), solution.statistics().steps))
        });
        let omega = (kappa / 4.5).sqrt();
        let demand = Demand::Held(floor(omega, end.t));
        report.case(named("body-metric", "energy", Oracle::Invariance), demand, || {
            Ok((energy(&solution), solution.statistics().steps))
        });
        let model = Mirrored { kappa }.prepare()?;
        let solution = run(&model, model.at_momentum(start_r.phi, Spatial(start_r.spin))?, end_r.t);
        report.case(named("space-metric", "Psi, t = 50", Oracle::Reference), Demand::Held(1e-9), || {
            let solution = solution?;
            Ok((error(solution.end().1.phi(), end_r), solution.statistics().steps))
        });
    }
    Ok(())
}

/// In the plane it is the motion of the body that is confined to det phi = 1.
fn separable_in_the_plane(report: &mut StabilityReport) -> affine_runtime::Result<()> {
    let phi = Matrix::<2>::new(1.2, 0.3, -0.1, 0.9);
    let spin = Matrix::<2>::new(0.3, -0.4, 0.6, -0.3);
    let whole = spin + Matrix::<2>::identity() * 0.2;
    let confined = ConfinedPlanar.at_momentum(phi.isochoric_part(), Comoving(spin))?;
    let confined = run(&ConfinedPlanar, confined, 10.0)?;
    for kappa in KAPPAS {
        let model = Planar { kappa }.prepare()?;
        let solution = run(&model, model.at_momentum(phi, Comoving(whole))?, 10.0);
        let named = scene("body-metric", 2, format!("kappa = {kappa:e}"), "Psi, t = 10", Oracle::Limit);
        report.case(named, Demand::Held(1e-9), || {
            let solution = solution?;
            let psi = solution.end().1.phi().isochoric_part();
            Ok((relative_distance(&psi, confined.end().1.phi()), solution.statistics().steps))
        });
    }
    Ok(())
}

/// From `det phi = 1` and a traceless velocity the dilatation vibrates with an amplitude of the order of `1/kappa`.
fn elastic(report: &mut StabilityReport) -> affine_runtime::Result<()> {
    let reference = rows(P6);
    if let [start, .., end] = reference.as_slice() {
        let model = Elastic { kappa: 1e6 }.prepare()?;
        let solution = run(&model, model.at_momentum(start.phi, TwoPoint(start.spin))?, end.t);
        let named = scene("d'Alembert", 3, format!("kappa = 1e6, t = {}", end.t), "phi", Oracle::Reference);
        report.case(named, Demand::Held(1e-9), || {
            let solution = solution?;
            Ok((relative_distance(solution.end().1.phi(), &end.phi), solution.statistics().steps))
        });
    }
    let t = 1.0;
    let phi = Matrix::<3>::new(1.1, 0.2, -0.1, 0.05, 0.9, 0.15, -0.2, 0.1, 1.05).isochoric_part();
    let rate = Matrix::<3>::new(0.1, 0.4, -0.3, -0.2, -0.15, 0.25, 0.35, -0.1, 0.05);
    let velocity = phi * rate;
    let confined = run(&ConfinedElastic, ConfinedElastic.at_velocity(phi, velocity)?, t)?;
    for kappa in KAPPAS {
        let model = Elastic { kappa }.prepare()?;
        let solution = run(&model, model.at_velocity(phi, velocity)?, t);
        both(
            report,
            ("d'Alembert", kappa, t),
            solution,
            &confined,
            (kappa / 9.0 * (1.0 + 1.0 / 1.5 + 0.5)).sqrt(),
        );
    }
    Ok(())
}

fn missile(report: &mut StabilityReport) -> affine_runtime::Result<()> {
    let p = Vector::<3>::new(0.3, -0.2, 0.5);
    let reference = rows(P7);
    if let [start, .., end] = reference.as_slice() {
        let model = Missile { kappa: 1e4 }.prepare()?;
        let at = model.at_momentum(start.x, start.phi, p, Comoving(start.spin))?;
        let solution = run(&model, at, end.t);
        let named =
            scene("drunk missile", 3, format!("kappa = 1e4, t = {}", end.t), "phi", Oracle::Reference);
        report.case(named, Demand::Held(1e-9), || {
            let solution = solution?;
            Ok((relative_distance(solution.end().1.phi(), &end.phi), solution.statistics().steps))
        });
    }
    let t = 1.0;
    let phi = Matrix::<3>::new(1.1, 0.2, -0.1, 0.05, 0.9, 0.15, -0.2, 0.1, 1.05).isochoric_part();
    let spin = Matrix::<3>::new(0.1, 0.4, -0.3, -0.2, -0.15, 0.25, 0.35, -0.1, 0.05);
    let confined = ConfinedMissile.at_momentum(Vector::<3>::zeros(), phi, p, Comoving(spin))?;
    let confined = run(&ConfinedMissile, confined, t)?;
    for kappa in KAPPAS {
        let model = Missile { kappa }.prepare()?;
        let solution = run(&model, model.at_momentum(Vector::<3>::zeros(), phi, p, Comoving(spin))?, t);
        both(report, ("drunk missile", kappa, t), solution, &confined, (kappa / 4.5).sqrt());
    }
    // Loosely, where splitting passes over the dilatation.
    for kappa in KAPPAS {
        let model = SplitMissile { kappa }.prepare()?;
        let start = model.at_momentum(Vector::<3>::zeros(), phi, p, Comoving(spin))?;
        let solution = Simulation::new(&model, start).until(t).tolerance(LOOSE).max_steps(1_000_000).run();
        let named =
            scene("drunk missile, split", 3, format!("kappa = {kappa:e}, t = {t}"), "phi", Oracle::Limit);
        report.case(named, Demand::Held((4.0 / kappa).max(LOOSE)), || {
            solution.map(|s| apart(&s, &confined)).map_err(Into::into)
        });
    }
    Ok(())
}

/// Distance to the confined body, of the order of the compliance, and the energy.
pub(super) fn both<const N: usize, P: Phase<N>, Q: Phase<N>>(
    report: &mut StabilityReport,
    (model, kappa, t): (&'static str, f64, f64),
    solution: affine_runtime::Result<Trajectory<N, P>>,
    confined: &Trajectory<N, Q>,
    omega: f64,
) {
    let named = |quantity, oracle| scene(model, N, format!("kappa = {kappa:e}, t = {t}"), quantity, oracle);
    // The pressure that holds det phi = 1 is of order 1, the compliance 1/kappa.
    let distance = Demand::Held((4.0 / kappa).max(1e-9));
    report.case(named("phi", Oracle::Limit), distance, || {
        solution.as_ref().map(|s| apart(s, confined)).map_err(Clone::clone)
    });
    report.case(named("energy", Oracle::Invariance), Demand::Held(floor(omega, t)), || {
        solution.as_ref().map(|s| (energy(s), s.statistics().steps)).map_err(Clone::clone)
    });
}

/// `T` is quadratic in momenta: with energies `s^2` times larger and momenta `s` times, the motion is the same in a time `s`
/// times shorter.
fn shear(report: &mut StabilityReport) -> affine_runtime::Result<()> {
    let reference = rows(P8);
    let [start, .., end] = reference.as_slice() else { return Ok(()) };
    for c in KAPPAS {
        let s = (c / 1e4).sqrt();
        let model = Stiff { kappa: 10.0 * s * s, c }.prepare()?;
        let at = model.at_momentum(start.phi, Comoving(start.spin * s))?;
        let solution = run(&model, at, end.t / s);
        let named = scene("body-metric", 3, format!("c = {c:e}"), "phi", Oracle::Reference);
        report.case(named, Demand::Held(1e-9), || {
            let solution = solution?;
            Ok((relative_distance(solution.end().1.phi(), &end.phi), solution.statistics().steps))
        });
    }
    Ok(())
}
