//! Long runs: how errors grow.

use affine_runtime::prelude::*;
use affine_runtime::report::{Demand, Oracle, StabilityReport};
use affine_runtime::simulate::Method;

use super::Extent;
use super::growth::{Exponents, STARTS, up_to};
use super::reference::rows;
use super::shared::{relative_distance, scene};

#[affine_model(
    dim = 3,
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1),
    potential = hyperbolic_dilatation(10) + neo_hookean(0.5),
    emit(taylor),
)]
pub(crate) struct Vibrating;

#[affine_model(
    dim = 3,
    kinetic(dalembert = diag(1, 1.5, 2)),
    potential = hyperbolic_dilatation(10) + neo_hookean(0.5),
    emit(taylor),
)]
pub(crate) struct Elastic;

#[affine_model(dim = 2, kinetic(dalembert = 1), potential = 0.5*tr(G), emit(taylor))]
pub(crate) struct Spring;

pub(super) fn cases(report: &mut StabilityReport, extent: Extent) -> affine_runtime::Result<()> {
    report.heading("long runs by Taylor series at 1e-15");
    let t_end = match extent {
        Extent::Full => 1e4,
        Extent::Long => 1e5,
    };
    if let Some(start) = rows(include_str!("../../../tests/data/p2.csv")).first() {
        let placements = started(start.phi);
        let starts = placements.map(|phi| Vibrating.at_momentum(phi, Comoving(start.spin)));
        energies(report, "P2", (&Vibrating, starts.collect::<Result<_, _>>()?), t_end);
    }
    if let Some(start) = rows(include_str!("../../../tests/data/p3.csv")).first() {
        let placements = started(start.phi);
        let starts = placements.map(|phi| Elastic.at_momentum(phi, TwoPoint(start.spin)));
        energies(report, "P3", (&Elastic, starts.collect::<Result<_, _>>()?), t_end);
    }
    phases(report, t_end)
}

/// Times a factor of two apart, the last of them the end.
fn times(t_end: f64) -> Vec<f64> {
    (0..6).rev().map(|k| t_end / f64::from(1 << k)).collect()
}

/// The energy: at most `eps sqrt(steps)` at every time, up to a factor; and the exponent of its growth, from several
/// starts.
fn energies<const N: usize, M: Model<N>>(
    report: &mut StabilityReport,
    name: &'static str,
    (model, starts): (&M, Vec<M::Point<f64>>),
    t_end: f64,
) {
    let drifts = |start: M::Point<f64>, t_end: f64| -> affine_runtime::Result<(Vec<f64>, u64)> {
        let simulation = Simulation::new(model, start).until(t_end).tolerance(1e-15);
        let method = Method::Taylor { order: None };
        let run = simulation.method(method).every(t_end / 1024.0).max_steps(u64::MAX).run()?;
        let drift = run.conservation().of(affine_runtime::model::Conserved::Energy).copied();
        let drifts = drift.map(|drift| run.relative_drifts(&drift)).unwrap_or_default();
        Ok((drifts, run.statistics().steps))
    };
    let named = |scene_of, quantity| scene(name, N, scene_of, quantity, Oracle::Invariance);
    let long = drifts(starts[0], t_end);
    let steps = long.as_ref().map_or(0, |(_, steps)| *steps);
    let bound = 10.0 * f64::EPSILON * (steps as f64).sqrt();
    report.case(named(format!("t = {t_end:e}"), "energy, 10 eps sqrt(steps)"), Demand::Held(bound), || {
        let (drifts, steps) = long?;
        Ok((up_to(&drifts, 1), steps))
    });
    let shorter = t_end / f64::from(STARTS);
    let runs: Vec<_> = starts.into_iter().map(|start| drifts(start, shorter)).collect();
    let good: Vec<_> = runs.iter().flatten().cloned().collect();
    let found = Exponents::of(&good.iter().map(|(drifts, _)| drifts.clone()).collect::<Vec<_>>());
    let all = good.iter().map(|(_, steps)| steps).sum();
    report.case(named(found.scatter(), "exponent of its growth"), Demand::Held(0.75), || {
        runs.into_iter().try_for_each(|run| run.map(|_| ()))?;
        Ok((found.median, all))
    });
}

/// Placements of the starts of an ensemble, the first one as given.
fn started(phi: Matrix<3>) -> impl Iterator<Item = Matrix<3>> {
    let change = Matrix::<3>::new(1.0, -0.7, 0.2, 0.4, 0.9, -0.3, -0.5, 0.6, 0.8);
    (0..STARTS).map(move |k| phi + change * (0.02 * f64::from(k)))
}

/// On equal springs `phi(t) = phi0 cos t + phi_dot0 sin t`: from `phi_dot0 = J phi0` a rotation, so that the error is one of phase.
fn phases(report: &mut StabilityReport, t_end: f64) -> affine_runtime::Result<()> {
    let phi = Matrix::<2>::new(1.2, 0.3, -0.1, 0.9);
    let velocity = Matrix::<2>::new(0.0, -1.0, 1.0, 0.0) * phi;
    let start = Spring.at_velocity(phi, velocity)?;
    let simulation = Simulation::new(&Spring, start).until(t_end).tolerance(1e-15).output(times(t_end));
    let run = simulation.method(Method::Taylor { order: None }).max_steps(u64::MAX).run();
    let exact = |t: f64| phi * t.cos() + velocity * t.sin();
    let named = |quantity| scene("springs", 2, format!("t = {t_end:e}"), quantity, Oracle::ClosedForm);
    report.case(named("phi, eps per radian"), Demand::Held(10.0 * f64::EPSILON * t_end), || {
        let run = run.as_ref().map_err(|halt| halt.clone())?;
        Ok((relative_distance(run.end().1.phi(), &exact(t_end)), run.statistics().steps))
    });
    report.case(named("exponent of its growth"), Demand::Held(1.25), || {
        let run = run.as_ref().map_err(|halt| halt.clone())?;
        let errors: Vec<f64> =
            run.iter().map(|(t, point)| relative_distance(point.phi(), &exact(t))).collect();
        let exponent = match errors.as_slice() {
            [first, .., last] => (last / first).log2() / 5.0,
            _ => f64::NAN,
        };
        Ok((exponent, run.statistics().steps))
    });
    Ok(())
}
