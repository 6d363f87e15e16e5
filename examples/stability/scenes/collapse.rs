//! Collapse of bodies in a flat metric.

use affine_runtime::prelude::*;
use affine_runtime::report::{Demand, Oracle, StabilityReport};
use affine_runtime::simulate::{Method, Reason};

use super::shared::{TOLERANCE, scene};

#[affine_model(dim = 2, kinetic(dalembert = 1))]
pub(crate) struct Disc;

#[affine_model(dim = 3, kinetic(dalembert = diag(1, 1.5, 2)))]
pub(crate) struct Body;

#[affine_model(dim = 3, kinetic(dalembert = 1), potential = 0.5*tr(G))]
pub(crate) struct Spring;

#[affine_model(dim = 2, kinetic(dalembert = 1), potential = 0.5*tr(G))]
pub(crate) struct PlanarSpring;

#[affine_model(dim = 2, kinetic(dalembert = 1), potential = 0.5*tr(G), emit(taylor))]
pub(crate) struct PlanarSeries;

/// What the time of collapse may err by.
const SAME_TIME: f64 = 1e-10;

pub(super) fn cases(report: &mut StabilityReport) -> affine_runtime::Result<()> {
    report.heading("collapse");
    // det(1 + s M) = (1 - s/2)(1 + s/4)(...) with the eigenvalues of M on its diagonal, mixed by a shear.
    let mixed = |eigenvalues: Vector<3>| {
        let shear = Matrix::<3>::new(1.0, 0.5, -0.25, 0.0, 1.0, 0.75, 0.0, 0.0, 1.0);
        let back = Matrix::<3>::new(1.0, -0.5, 0.625, 0.0, 1.0, -0.75, 0.0, 0.0, 1.0);
        shear * Matrix::<3>::from_diagonal(&eigenvalues) * back
    };
    let phi = Matrix::<3>::new(1.1, 0.2, -0.1, 0.05, 0.9, 0.15, -0.2, 0.1, 1.05);
    for (what, rates, t) in [
        ("once", Vector::<3>::new(-0.8, 0.25, 0.1), 1.25),
        ("twice up to the end", Vector::<3>::new(-0.8, -0.5, 0.1), 1.25),
    ] {
        for method in [Method::Automatic, Method::RungeKutta8] {
            let start = Body.at_velocity(phi, phi * mixed(rates))?;
            collapses(report, ("d'Alembert", what), (&Body, start), method, (t, 4.0));
        }
    }
    let unit = Matrix::<2>::identity();
    for method in [Method::Automatic, Method::RungeKutta8, Method::RungeKutta5] {
        let start = Disc.at_velocity(unit, unit * -0.5)?;
        collapses(report, ("d'Alembert", "to a point"), (&Disc, start), method, (2.0, 3.0));
        // det changes its sign twice within 1e-3 of the time, and once does so within 1e-6.
        for apart in [1e-3, 1e-6] {
            let rate = Matrix::<2>::new(-0.5, 0.0, 0.0, -0.5 * (1.0 - apart));
            let start = Disc.at_velocity(unit, rate)?;
            collapses(report, ("d'Alembert", "twice, near a point"), (&Disc, start), method, (2.0, 3.0));
        }
    }
    let start = Disc.at_velocity(unit, Matrix::<2>::new(-0.5, 0.1, 0.1, 0.2))?;
    let least = -0.15 - (0.35_f64 * 0.35 + 0.01).sqrt();
    for method in [Method::Automatic, Method::RungeKutta8] {
        collapses(report, ("d'Alembert", "to a line"), (&Disc, start), method, (-1.0 / least, 3.0));
    }
    // phi = cos t phi0 + sin t phi_dot0 with both columns alike: det touches zero or changes its sign twice, t from pi/4 on.
    for apart in [0.0, 1e-6, 1e-3, 0.1] {
        for (name, method) in [
            ("Taylor", Method::Taylor { order: None }),
            ("Gauss", Method::Gauss { stages: 3, step: 0.25 }),
            ("Runge-Kutta", Method::RungeKutta8),
            ("coarse Runge-Kutta", Method::RungeKutta8),
        ] {
            let tolerance = if name.starts_with("coarse") { 1e-3 } else { TOLERANCE };
            let start = PlanarSeries.at_velocity(unit, Matrix::<2>::new(-1.0, 0.0, 0.0, -1.0 + apart))?;
            let simulation =
                Simulation::new(&PlanarSeries, start).until(2.0).tolerance(tolerance).method(method);
            // The methods' own errors at their tolerance or step.
            let most = match name {
                "Gauss" => 1e-5,
                "coarse Runge-Kutta" => 1e-2,
                _ => SAME_TIME,
            };
            let named = scene(
                "d'Alembert, springs",
                2,
                format!("twice, {apart:e} apart, {name}"),
                "time of collapse",
                Oracle::ClosedForm,
            );
            report.case(named, Demand::Held(most), || match simulation.run() {
                Err(halt) => match halt.stop.reason {
                    Reason::Placement { t, .. } => {
                        Ok(((t / core::f64::consts::FRAC_PI_4 - 1.0).abs(), halt.stop.steps))
                    }
                    _ => Err(halt.into()),
                },
                Ok(run) => Ok((f64::INFINITY, run.statistics().steps)),
            });
        }
    }
    // phi = phi0 cos t + phi_dot0 sin t: the first column vanishes at t = pi/4.
    let start =
        Spring.at_velocity(phi, phi * Matrix::<3>::from_diagonal(&Vector::<3>::new(-1.0, 0.3, 0.2)))?;
    let quarter = core::f64::consts::FRAC_PI_4;
    collapses(report, ("d'Alembert, springs", "once"), (&Spring, start), Method::Automatic, (quarter, 2.0));
    let start = PlanarSpring.at_velocity(unit, Matrix::<2>::new(-1.0, 0.0, 0.0, 0.3))?;
    collapses(
        report,
        ("d'Alembert, springs", "once"),
        (&PlanarSpring, start),
        Method::Automatic,
        (quarter, 1.6),
    );
    Ok(())
}

/// The error of the time at which a run says that the body collapsed.
fn collapses<const N: usize, M: Model<N>>(
    report: &mut StabilityReport,
    (name, what): (&'static str, &str),
    (model, start): (&M, M::Point<f64>),
    method: Method,
    (collapse, t_end): (f64, f64),
) {
    let by = if method == Method::Automatic { "" } else { ", Runge-Kutta" };
    let named = scene(name, N, format!("{what}{by}"), "time of collapse", Oracle::ClosedForm);
    report.case(named, Demand::Held(SAME_TIME), || {
        let run = Simulation::new(model, start).until(t_end).tolerance(TOLERANCE).method(method).run();
        match run {
            Err(halt) => match halt.stop.reason {
                Reason::Placement { t, .. } => Ok(((t / collapse - 1.0).abs(), halt.stop.steps)),
                _ => Err(halt.into()),
            },
            // It went through the singularity: silently wrong.
            Ok(run) => Ok((f64::INFINITY, run.statistics().steps)),
        }
    });
}
