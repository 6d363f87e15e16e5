//! Fast spins, uneven masses, other units.

use affine_runtime::decompose::LinearMap;
use affine_runtime::prelude::*;
use affine_runtime::report::{Demand, Oracle, StabilityReport};

use super::shared::{relative_distance, run, run_by, scene};

#[affine_model(dim = 2, kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1))]
pub(crate) struct Disc;

#[affine_model(dim = 3, kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1))]
pub(crate) struct Body;

#[affine_model(
    dim = 3,
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1),
    potential = hyperbolic_dilatation(10) + neo_hookean(0.5),
)]
pub(crate) struct Vibrating;

#[affine_model(dim = 3, kinetic(dalembert = [[a, 0, 0], [0, b, 0], [0, 0, c]]), potential = 0.5*tr(G))]
pub(crate) struct Spring {
    a: f64,
    b: f64,
    c: f64,
}

#[affine_model(
    dim = 3,
    kinetic(dalembert = [[j, 0, 0], [0, 1.5*j, 0], [0, 0, 2*j]]),
    potential = hyperbolic_dilatation(kappa) + neo_hookean(c),
    emit(taylor),
)]
pub(crate) struct Elastic {
    j: f64,
    kappa: f64,
    c: f64,
}

#[affine_model(
    dim = 2,
    kinetic(casimir2 = 0.2*i, body_inertia = [[i, 0], [0, 1.5*i]]),
    potential = hyperbolic_dilatation(kappa) + neo_hookean(c),
)]
pub(crate) struct UnevenDisc {
    i: f64,
    kappa: f64,
    c: f64,
}

/// Roundings of a hundred steps; the two motions are one, number by number in other units.
const SAME: f64 = 1e-11;

pub(super) fn cases(report: &mut StabilityReport) -> affine_runtime::Result<()> {
    report.heading("fast spin, uneven masses, other units");
    spins(report);
    masses(report)?;
    units(report)
}

/// A rotation by the angle `1e8 t`, to ten roundings of the angle; and the whirl that a vorticity adds to a vibration.
fn spins(report: &mut StabilityReport) {
    for rate in [1e4, 1e8] {
        let named = |model, n, oracle| scene(model, n, format!("spin {rate:e}, t = 1"), "phi", oracle);
        let demand = Demand::Held(10.0 * f64::EPSILON * rate);
        report.case(named("body-metric", 2, Oracle::ClosedForm), demand, || {
            let turn = Matrix::<2>::new(0.0, -rate, rate, 0.0);
            let unit = Matrix::<2>::identity();
            let solution = run(&Disc, Disc.at_velocity(unit, turn)?, 1.0)?;
            let (sine, cosine) = rate.sin_cos();
            let exact = Matrix::<2>::new(cosine, -sine, sine, cosine);
            Ok((relative_distance(solution.end().1.phi(), &exact), solution.statistics().steps))
        });
        report.case(named("body-metric", 3, Oracle::ClosedForm), demand, || {
            let turn = Matrix::<3>::new(0.0, -0.6, 0.0, 0.6, 0.0, -0.8, 0.0, 0.8, 0.0) * rate;
            let solution = run(&Body, Body.at_velocity(Matrix::<3>::identity(), turn)?, 1.0)?;
            let exact = turn.skew_exponential();
            Ok((relative_distance(solution.end().1.phi(), &exact), solution.statistics().steps))
        });
        // The motion of Psi goes on in the whirl's frame: slower by w = 2/3 and faster by 5/3.
        let named = scene(
            "body-metric, vibrating",
            3,
            format!("spin {rate:e}, t = 1e-3"),
            "energy",
            Oracle::Invariance,
        );
        report.case(named, Demand::Held((10.0 * f64::EPSILON * rate * 1e-3).max(1e-11)), || {
            let phi = Matrix::<3>::new(1.1, 0.2, -0.1, 0.05, 0.9, 0.15, -0.2, 0.1, 1.05);
            let turn = Matrix::<3>::new(0.0, -0.6, 0.0, 0.6, 0.0, -0.8, 0.0, 0.8, 0.0) * rate;
            let solution = run(&Vibrating, Vibrating.at_velocity(phi, phi * turn)?, 1e-3)?;
            Ok((super::shared::energy(&solution), solution.statistics().steps))
        });
    }
}

/// Columns of different mass on equal springs vibrate each at its own frequency: `cos(t/sqrt(J_A))`.
fn masses(report: &mut StabilityReport) -> affine_runtime::Result<()> {
    let phi = Matrix::<3>::new(1.1, 0.2, -0.1, 0.05, 0.9, 0.15, -0.2, 0.1, 1.05);
    for ratio in [1e-12_f64, 1e-6, 1e6, 1e12] {
        // The lightest column goes round once in a time 2 pi.
        let lightest = ratio.min(1.0);
        let masses = [1.0 / lightest, ratio / lightest, 1.0 / lightest];
        let model = Spring { a: masses[0], b: masses[1], c: masses[2] }.prepare()?;
        let named = scene(
            "d'Alembert, springs",
            3,
            format!("masses 1 : {ratio:e}, t = 1"),
            "phi",
            Oracle::ClosedForm,
        );
        report.case(named, Demand::Held(SAME), || {
            let solution = run(&model, model.at_velocity(phi, Matrix::<3>::zeros())?, 1.0)?;
            let exact = Matrix::<3>::from_fn(|i, a| phi[(i, a)] * (1.0 / masses[a].sqrt()).cos());
            Ok((relative_distance(solution.end().1.phi(), &exact), solution.statistics().steps))
        });
    }
    Ok(())
}

/// Energies and momenta in other units, and times in other units.
fn units(report: &mut StabilityReport) -> affine_runtime::Result<()> {
    let phi = Matrix::<3>::new(1.1, 0.2, -0.1, 0.05, 0.9, 0.15, -0.2, 0.1, 1.05);
    let velocity = Matrix::<3>::new(0.1, 0.4, -0.3, -0.2, -0.15, 0.25, 0.35, -0.1, 0.05);
    let plain = Elastic { j: 1.0, kappa: 10.0, c: 0.5 }.prepare()?;
    let plain = run(&plain, plain.at_velocity(phi, velocity)?, 2.0)?;
    let small = Matrix::<2>::new(1.2, 0.3, -0.1, 0.9);
    let rate = Matrix::<2>::new(0.3, -0.4, 0.6, -0.1);
    let disc = UnevenDisc { i: 1.0, kappa: 10.0, c: 0.5 }.prepare()?;
    let disc = run(&disc, disc.at_velocity(small, small * rate)?, 2.0)?;
    for unit in [1e100_f64, 1e-100] {
        let energies = [("energy", unit, unit, 1.0), ("time", unit, 1.0 / unit, unit)];
        for (what, mass, stiffness, time) in energies {
            let named =
                |model, n| scene(model, n, format!("unit of {what} {unit:e}"), "phi", Oracle::Invariance);
            for (name, method) in
                [("d'Alembert", Method::RungeKutta8), ("d'Alembert, Taylor", Method::Taylor { order: None })]
            {
                report.case(named(name, 3), Demand::Held(SAME), || {
                    let model = Elastic { j: mass, kappa: 10.0 * stiffness, c: 0.5 * stiffness }.prepare()?;
                    let start = model.at_velocity(phi, velocity / time)?;
                    let scaled = run_by(method, &model, start, 2.0 * time)?;
                    let error = relative_distance(scaled.end().1.phi(), plain.end().1.phi());
                    Ok((error, scaled.statistics().steps))
                });
            }
            report.case(named("body J", 2), Demand::Held(SAME), || {
                let model = UnevenDisc { i: mass, kappa: 10.0 * stiffness, c: 0.5 * stiffness }.prepare()?;
                let scaled = run(&model, model.at_velocity(small, small * rate / time)?, 2.0 * time)?;
                Ok((relative_distance(scaled.end().1.phi(), disc.end().1.phi()), scaled.statistics().steps))
            });
        }
    }
    Ok(())
}
