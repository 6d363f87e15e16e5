//! Stiff friction: viscous bodies against solutions of 25 digits, with the friction over six powers of ten.

use affine_runtime::prelude::*;
use affine_runtime::report::{Demand, Oracle, StabilityReport};

use super::shared::{relative_distance, scene};

/// Viscosity of every deformation.
#[affine_model(
    dim = 3,
    symmetry(space = affine, body = metric),
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1),
    potential = 10/2*sinh(q)^2 + 0.5*(tr(G)*exp(-2*q) - n),
    dissipation(body_inertia = r),
)]
pub(crate) struct Viscous {
    pub(crate) r: f64,
}

/// Viscosity of the volume, and a little of the rest.
#[affine_model(
    dim = 2,
    kinetic(dalembert = 1),
    potential = (tr(G) - n)^2,
    dissipation(casimir1_squared = r, body_inertia = 0.1),
)]
struct Bulk {
    r: f64,
}

/// Anisotropic viscosity beside a stiff spring of shear, whose oscillations die out.
#[affine_model(
    dim = 3,
    symmetry(space = affine, body = metric),
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1),
    potential = 10/2*sinh(q)^2 + 3e7*(tr(G)*exp(-2*q) - n),
    dissipation(body_inertia = [[502000, 250000, 500000], [250000, 127000, 250000], [500000, 250000, 502000]]),
)]
struct Spring;

/// A light body that follows its drive: friction is fast for ever.
#[affine_model(
    dim = 3,
    symmetry(space = affine, body = metric),
    kinetic(casimir2 = 2e-7, casimir1_squared = 1e-7, body_inertia = 1e-6),
    potential = 10/2*sinh(q)^2 + 0.5*(tr(G)*exp(-2*q) - n) + 0.3*sin(5*t)*G[1,2],
    dissipation(body_inertia = 1),
)]
struct Driven;

const VISCOUS: [(f64, &str); 3] = [
    (1e4, include_str!("../../../tests/data/p9_1e4.csv")),
    (1e6, include_str!("../../../tests/data/p9_1e6_long.csv")),
    (1e8, include_str!("../../../tests/data/p9_1e8.csv")),
];
const BULK: [(f64, &str); 3] = [
    (1e3, include_str!("../../../tests/data/p10_1e3.csv")),
    (1e5, include_str!("../../../tests/data/p10_1e5.csv")),
    (1e7, include_str!("../../../tests/data/p10_1e7.csv")),
];
const SPRING: &str = include_str!("../../../tests/data/p11.csv");
const DRIVEN: &str = include_str!("../../../tests/data/p12.csv");
const TOLERANCES: [f64; 3] = [1e-3, 1e-6, 1e-10];

pub(super) fn cases(report: &mut StabilityReport) -> affine_runtime::Result<()> {
    report.heading("stiff friction");
    for (r, data) in VISCOUS {
        let model = Viscous { r }.prepare()?;
        let [(_, phi, spin), end] = ends::<3>(data);
        let start = model.at_momentum(phi, Comoving(spin))?;
        creeps(report, ("viscous body", format!("r = {r:e}")), &model, start, end);
    }
    for (r, data) in BULK {
        let model = Bulk { r }.prepare()?;
        let [(_, phi, spin), end] = ends::<2>(data);
        let start = model.at_momentum(phi, Comoving(spin))?;
        creeps(report, ("bulk viscosity", format!("r = {r:e}")), &model, start, end);
    }
    let [(_, phi, spin), end] = ends::<3>(SPRING);
    let start = Spring.at_momentum(phi, Comoving(spin))?;
    creeps(report, ("viscous body", "stiff spring".to_owned()), &Spring, start, end);
    let [(_, phi, spin), end] = ends::<3>(DRIVEN);
    let start = Driven.at_momentum(phi, Comoving(spin))?;
    creeps(report, ("viscous body", "light and driven".to_owned()), &Driven, start, end);
    Ok(())
}

/// Time, placement and `Sigma_hat`.
type Row<const N: usize> = (f64, Matrix<N>, Matrix<N>);

/// The first and the last row of a solution.
fn ends<const N: usize>(data: &str) -> [Row<N>; 2] {
    let mut rows = data.lines().filter(|line| !line.starts_with(['#', 't'])).map(|line| {
        let numbers: Vec<f64> = line.split(',').filter_map(|number| number.parse().ok()).collect();
        let matrix = |from: usize| Matrix::<N>::from_row_slice(&numbers[from..from + N * N]);
        (numbers[0], matrix(1), matrix(1 + N * N))
    });
    let nothing = (f64::NAN, Matrix::<N>::zeros(), Matrix::<N>::zeros());
    let first = rows.next().unwrap_or(nothing);
    [first, rows.next_back().unwrap_or(nothing)]
}

fn creeps<const N: usize, M: Model<N>>(
    report: &mut StabilityReport,
    (name, extreme): (&'static str, String),
    model: &M,
    start: M::Point<f64>,
    (t_end, phi, _): Row<N>,
) {
    for tolerance in TOLERANCES {
        let named = scene(name, N, format!("{extreme}, {tolerance:e}"), "phi", Oracle::Reference);
        report.case(named, Demand::Held(tolerance), || {
            let run =
                Simulation::new(model, start).until(t_end).tolerance(tolerance).output([t_end]).run()?;
            Ok((relative_distance(run.end().1.phi(), &phi), run.statistics().steps))
        });
    }
}
