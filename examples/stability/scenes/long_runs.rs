//! Long runs: how errors grow.

use affine_runtime::prelude::*;
use affine_runtime::report::{Demand, Oracle, StabilityReport, relative_distance};
use affine_runtime::simulate::Method;

use super::Extent;
use super::reference::rows;
use super::shared::scene;

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
        Extent::Fast => 1e2,
        Extent::Full => 1e4,
        Extent::Long => 1e5,
    };
    if let Some(start) = rows(include_str!("../../../tests/data/p2.csv")).first() {
        let start = Vibrating.at_momentum(start.phi, Comoving(start.spin))?;
        energies(report, "P2", (&Vibrating, start), t_end);
    }
    if let Some(start) = rows(include_str!("../../../tests/data/p3.csv")).first() {
        let start = Elastic.at_momentum(start.phi, TwoPoint(start.spin))?;
        energies(report, "P3", (&Elastic, start), t_end);
    }
    phases(report, t_end)
}

/// Times a factor of two apart, the last of them the end.
fn times(t_end: f64) -> Vec<f64> {
    (0..6).rev().map(|k| t_end / f64::from(1 << k)).collect()
}

/// The energy: at most `eps sqrt(steps)` at every time, up to a factor; and the exponent of its growth.
fn energies<const N: usize, M: Model<N>>(
    report: &mut StabilityReport,
    name: &'static str,
    (model, start): (&M, M::Point<f64>),
    t_end: f64,
) {
    let simulation = Simulation::new(model, start).until(t_end).tolerance(1e-15);
    let run =
        simulation.method(Method::Taylor { order: None }).every(t_end / 1024.0).max_steps(u64::MAX).run();
    let named = |quantity| scene(name, N, format!("t = {t_end:e}"), quantity, Oracle::Invariance);
    let largest = |run: &Trajectory<N, M::Point<f64>>, part: usize| {
        let drift = run.conservation().of(affine_runtime::model::Conserved::Energy).copied();
        let drifts = drift.map(|drift| run.relative_drifts(&drift)).unwrap_or_default();
        drifts.into_iter().take(1024 / part).fold(0.0_f64, f64::max)
    };
    let steps = run.as_ref().map_or(0, |run| run.statistics().steps);
    let bound = 10.0 * f64::EPSILON * (steps as f64).sqrt();
    report.case(named("energy, 10 eps sqrt(steps)"), Demand::Held(bound), || {
        let run = run.as_ref().map_err(|halt| halt.clone())?;
        Ok((largest(run, 1), run.statistics().steps))
    });
    report.case(named("exponent of its growth"), Demand::Held(0.75), || {
        let run = run.as_ref().map_err(|halt| halt.clone())?;
        // Between a sixteenth of the time and all of it.
        let exponent = (largest(run, 1) / largest(run, 16)).log2() / 4.0;
        Ok((exponent, run.statistics().steps))
    });
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
