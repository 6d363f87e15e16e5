//! Bodies in a flat metric whose stretches are far from 1: units of length and of time that are large or small alike.
//!
//! With `phi(t) = c chi(t/c)` the kinetic energies of `phi` and `chi` are equal, and a potential of the shear alone is one of
//! both; of `q` it is that of `chi` with `q` counted from `-ln c`.

use affine_runtime::prelude::*;
use affine_runtime::report::{Demand, Oracle, StabilityReport};

use super::shared::{TOLERANCE, relative_distance, run, scene};
use super::stretches::{SAME, generic};

/// Under the logarithm of its volume.
#[affine_model(
    dim = 3,
    kinetic(dalembert = diag(1, 1.5, 2)),
    potential = (q + s)^2/600 + neo_hookean(0.5),
    emit(taylor),
)]
pub(crate) struct Logarithmic {
    s: f64,
}

/// The same in the plane.
#[affine_model(
    dim = 2,
    kinetic(dalembert = diag(1, 1.5)),
    potential = (q + s)^2/600 + neo_hookean(0.5),
    emit(taylor),
)]
pub(crate) struct LogarithmicDisc {
    s: f64,
}

/// Under powers of `D`.
#[affine_model(
    dim = 3,
    kinetic(dalembert = diag(1, 1.5, 2)),
    potential = a*exp(q) + b*exp(-q) + neo_hookean(0.5),
    emit(nystrom, splitting, taylor),
)]
pub(crate) struct Gas {
    a: f64,
    b: f64,
}

/// The same in the plane.
#[affine_model(
    dim = 2,
    kinetic(dalembert = diag(1, 1.5)),
    potential = a*exp(q) + b*exp(-q) + neo_hookean(0.5),
    emit(nystrom, splitting, taylor),
)]
pub(crate) struct GasDisc {
    a: f64,
    b: f64,
}

/// With friction that acts on the affine velocity.
#[affine_model(
    dim = 3,
    kinetic(dalembert = diag(1, 1.5, 2)),
    potential = neo_hookean(0.5),
    dissipation(space_inertia = k),
)]
pub(crate) struct Rubbed {
    k: f64,
}

/// The same in the plane.
#[affine_model(
    dim = 2,
    kinetic(dalembert = diag(1, 1.5)),
    potential = neo_hookean(0.5),
    dissipation(body_inertia = k),
)]
pub(crate) struct RubbedDisc {
    k: f64,
}

const LOGARITHMS: [f64; 10] = [100.0, 200.0, 236.0, 260.0, 300.0, -100.0, -200.0, -236.0, -260.0, -300.0];

/// Time that the motions of `chi` take.
const TIME: f64 = 1.0;

pub(super) fn cases(report: &mut StabilityReport) -> affine_runtime::Result<()> {
    for q in LOGARITHMS {
        in_space(report, q)?;
        in_the_plane(report, q)?;
    }
    methods_that_form_det(report)
}

/// `(phi, phi_dot)` of `chi`.
fn disc() -> (Matrix<2>, Matrix<2>) {
    (Matrix::<2>::new(1.2, 0.3, -0.1, 0.9), Matrix::<2>::new(0.3, -0.4, 0.6, -0.1))
}

/// The motion of `phi = c chi` against that of `chi`.
fn against<const N: usize, M: Model<N>>(
    report: &mut StabilityReport,
    (name, q): (&'static str, f64),
    (plain, start): (&M, M::Point<f64>),
    (mapped, from): (&M, M::Point<f64>),
) -> affine_runtime::Result<()> {
    let c = q.exp();
    let chi = run(plain, start, TIME)?;
    let named = scene(name, N, format!("q = {q}"), "phi", Oracle::Invariance);
    report.case(named, Demand::Held(SAME), || {
        let phi = run(mapped, from, TIME * c)?;
        Ok((relative_distance(&(phi.end().1.phi() / c), chi.end().1.phi()), phi.statistics().steps))
    });
    Ok(())
}

fn in_space(report: &mut StabilityReport, q: f64) -> affine_runtime::Result<()> {
    let (phi, rate) = generic();
    let c = q.exp();
    let (plain, mapped) = (Logarithmic { s: q }.prepare()?, Logarithmic { s: 0.0 }.prepare()?);
    let points = (plain.at_velocity(phi, rate)?, mapped.at_velocity(phi * c, rate)?);
    against(report, ("d'Alembert, q^2", q), (&plain, points.0), (&mapped, points.1))?;
    let (plain, mapped) = (Gas { a: 0.3, b: 0.2 }.prepare()?, Gas { a: 0.3 / c, b: 0.2 * c }.prepare()?);
    let points = (plain.at_velocity(phi, rate)?, mapped.at_velocity(phi * c, rate)?);
    against(report, ("d'Alembert, D and 1/D", q), (&plain, points.0), (&mapped, points.1))?;
    let (plain, mapped) = (Rubbed { k: 0.1 }.prepare()?, Rubbed { k: 0.1 * c }.prepare()?);
    let points = (plain.at_velocity(phi, rate)?, mapped.at_velocity(phi * c, rate)?);
    against(report, ("d'Alembert, friction", q), (&plain, points.0), (&mapped, points.1))
}

fn in_the_plane(report: &mut StabilityReport, q: f64) -> affine_runtime::Result<()> {
    let (phi, rate) = disc();
    let c = q.exp();
    let (plain, mapped) = (LogarithmicDisc { s: q }.prepare()?, LogarithmicDisc { s: 0.0 }.prepare()?);
    let points = (plain.at_velocity(phi, rate)?, mapped.at_velocity(phi * c, rate)?);
    against(report, ("d'Alembert, q^2", q), (&plain, points.0), (&mapped, points.1))?;
    let (plain, mapped) =
        (GasDisc { a: 0.3, b: 0.2 }.prepare()?, GasDisc { a: 0.3 / c, b: 0.2 * c }.prepare()?);
    let points = (plain.at_velocity(phi, rate)?, mapped.at_velocity(phi * c, rate)?);
    against(report, ("d'Alembert, D and 1/D", q), (&plain, points.0), (&mapped, points.1))?;
    let (plain, mapped) = (RubbedDisc { k: 0.1 }.prepare()?, RubbedDisc { k: 0.1 * c }.prepare()?);
    let points = (plain.at_velocity(phi, rate)?, mapped.at_velocity(phi * c, rate)?);
    against(report, ("d'Alembert, friction", q), (&plain, points.0), (&mapped, points.1))
}

/// Forces of Runge-Kutta-Nystrom steps and of splitting are functions of the placement alone, with its determinant: beyond
/// `|q| = 236` these methods refuse, by name, and `Method::Automatic` takes another.
fn methods_that_form_det(report: &mut StabilityReport) -> affine_runtime::Result<()> {
    let (phi, rate) = generic();
    let plain = Gas { a: 0.3, b: 0.2 }.prepare()?;
    let chi = run(&plain, plain.at_velocity(phi, rate)?, TIME)?;
    for (q, inside) in [(230.0_f64, true), (240.0, false), (-230.0, true), (-240.0, false)] {
        let c = q.exp();
        let mapped = Gas { a: 0.3 / c, b: 0.2 * c }.prepare()?;
        for (name, method, most) in [
            ("Nystrom", Method::RungeKuttaNystrom12, SAME),
            ("splitting", Method::Splitting { order: 8, step: 0.01 * c }, 1e-10),
        ] {
            let named =
                scene("d'Alembert, D and 1/D", 3, format!("{name}, q = {q}"), "phi", Oracle::Invariance);
            let demand = if inside { Demand::Held(most) } else { Demand::Refused("range") };
            report.case(named, demand, || {
                let from = mapped.at_velocity(phi * c, rate)?;
                let simulation = Simulation::new(&mapped, from).until(TIME * c).tolerance(TOLERANCE);
                let phi = simulation.output([TIME * c]).method(method).run()?;
                let error = relative_distance(&(phi.end().1.phi() / c), chi.end().1.phi());
                Ok((error, phi.statistics().steps))
            });
        }
    }
    Ok(())
}
