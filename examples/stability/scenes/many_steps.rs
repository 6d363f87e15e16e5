//! Many steps of splitting: how rounding adds up.

use affine_runtime::model::Conserved;
use affine_runtime::prelude::*;
use affine_runtime::report::{Demand, Oracle, StabilityReport};
use affine_runtime::simulate::Method;

use super::Extent;
use super::growth::{Exponents, STARTS, exponent, mean_to_error, up_to};
use super::shared::{relative_distance, scene};

#[affine_model(dim = 2, kinetic(dalembert = 1), potential = 0.5*tr(G), emit(splitting))]
pub(crate) struct Springs;

#[affine_model(
    dim = 2,
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1),
    potential = harmonic_dilatation(10) + neo_hookean(0.5),
    emit(splitting),
)]
pub(crate) struct Disc;

#[affine_model(dim = 2, kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1), emit(splitting))]
pub(crate) struct Free;

/// Outputs of a run, which is as many parts of it.
const PARTS: usize = 1024;
/// A power of two: times of steps are exact.
const STEP: f64 = 0.125;

type Run<const N: usize, M> = affine_runtime::Result<Trajectory<N, <M as Model<N>>::Point<f64>>>;

pub(super) fn cases(report: &mut StabilityReport, extent: Extent) -> affine_runtime::Result<()> {
    report.heading("many steps of splitting");
    // Outputs are steps.
    let steps = PARTS as f64
        * match extent {
            Extent::Full => 1e3,
            Extent::Long => 1e5,
        };
    springs(report, steps)?;
    body(report, steps)?;
    constant_exponential(report, steps)
}

fn run<const N: usize, M: Model<N>>(
    (model, start): (&M, M::Point<f64>),
    (order, step): (usize, f64),
    steps: f64,
) -> Run<N, M> {
    let t_end = steps * step;
    let simulation = Simulation::new(model, start).until(t_end).every(t_end / PARTS as f64);
    Ok(simulation.method(Method::Splitting { order, step }).max_steps(u64::MAX).run()?)
}

/// The row of a quantity that errs: its largest error on the way against a bound.
fn size<const N: usize, M: Model<N>>(
    report: &mut StabilityReport,
    (model, steps): (&'static str, f64),
    (quantity, oracle): (&'static str, Oracle),
    bound: f64,
    run: &Run<N, M>,
    errors: impl Fn(&Trajectory<N, M::Point<f64>>) -> Vec<f64>,
) {
    let named = scene(model, N, format!("{steps:e} steps"), quantity, oracle);
    report.case(named, Demand::Held(bound), || {
        let run = run.as_ref().map_err(Clone::clone)?;
        Ok((up_to(&errors(run), 1), run.statistics().steps))
    });
}

/// The row of the exponent of its growth, the median over runs.
fn exponents<const N: usize, M: Model<N>>(
    report: &mut StabilityReport,
    (model, quantity): (&'static str, &'static str),
    most: f64,
    runs: &[Run<N, M>],
    errors: impl Fn(&Trajectory<N, M::Point<f64>>) -> Vec<f64>,
) {
    let good: Vec<_> = runs.iter().filter_map(|run| run.as_ref().ok()).collect();
    let steps = good.iter().map(|run| run.statistics().steps).sum();
    let found = Exponents::of(&good.iter().map(|run| errors(run)).collect::<Vec<_>>());
    let named = scene(model, N, found.scatter(), quantity, Oracle::Invariance);
    report.case(named, Demand::Held(most), || {
        runs.iter().try_for_each(|run| run.as_ref().map(|_| ()).map_err(Clone::clone))?;
        Ok((found.median, steps))
    });
}

fn drifts<const N: usize, P: Phase<N>>(run: &Trajectory<N, P>, quantity: Conserved) -> Vec<f64> {
    let conservation = run.conservation();
    conservation.of(quantity).map_or_else(|| vec![f64::NAN], |drift| run.relative_drifts(drift))
}

/// On equal springs a step of order 2 is a rotation by `2 asin(h/2)` that keeps `|phi|^2 + (1 - h^2/4) |phi_dot|^2` exactly:
/// what is left of energy and phase errors is rounding.
fn springs(report: &mut StabilityReport, steps: f64) -> affine_runtime::Result<()> {
    let phi = Matrix::<2>::new(1.2, 0.3, -0.1, 0.9);
    let velocity = Matrix::<2>::new(0.1, -0.6, 0.8, 0.2);
    let start = Springs.at_velocity(phi, velocity)?;
    let run = run((&Springs, start), (2, STEP), steps);
    let of = ("springs", steps);
    let stretch = 1.0 - STEP * STEP / 4.0;
    let kept = |phi: &Matrix<2>, velocity: &Matrix<2>| phi.norm_squared() + stretch * velocity.norm_squared();
    let root = 10.0 * f64::EPSILON * steps.sqrt();
    let energies = |run: &Trajectory<2, <Springs as Model<2>>::Point<f64>>| -> Vec<f64> {
        let of_point = |point| kept(Phase::phi(point), &Springs.velocity(point).phi_dot);
        let at_start = run.points().first().map_or(f64::NAN, of_point);
        run.points().iter().map(|point| (of_point(point) / at_start - 1.0).abs()).collect()
    };
    let quantity = ("energy of the steps, 10 eps sqrt(N)", Oracle::Invariance);
    size::<2, Springs>(report, of, quantity, root, &run, energies);
    let turn = 2.0 * (STEP / 2.0).asin();
    let phases = |run: &Trajectory<2, <Springs as Model<2>>::Point<f64>>| -> Vec<f64> {
        let exact = |t: f64| {
            let (sine, cosine) = (turn * (t / STEP)).sin_cos();
            phi * cosine + velocity * (stretch.sqrt() * sine)
        };
        run.iter().map(|(t, point)| relative_distance(point.phi(), &exact(t))).collect()
    };
    let quantity = ("phi, 10 eps per radian", Oracle::ClosedForm);
    size::<2, Springs>(report, of, quantity, 10.0 * f64::EPSILON * turn * steps, &run, phases);
    let named = scene(of.0, 2, format!("{steps:e} steps"), "exponent of the phase", Oracle::ClosedForm);
    report.case(named, Demand::Held(1.25), || {
        let run = run.as_ref().map_err(Clone::clone)?;
        Ok((exponent(&phases(run)), run.statistics().steps))
    });
    let quantity = ("spin, eps sqrt(N)", Oracle::Invariance);
    size::<2, Springs>(report, of, quantity, f64::EPSILON * steps.sqrt(), &run, |run| {
        drifts(run, Conserved::Spin)
    });
    let runs: Vec<_> = (0..STARTS)
        .map(|k| {
            let start = Springs.at_velocity(started(phi, k), velocity)?;
            self::run((&Springs, start), (2, STEP), steps / f64::from(STARTS))
        })
        .collect();
    exponents::<2, Springs>(report, (of.0, "exponent of the energy"), 0.75, &runs, energies);
    exponents::<2, Springs>(report, (of.0, "exponent of the spin"), 0.75, &runs, |run| {
        drifts(run, Conserved::Spin)
    });
    no_drift::<2, Springs>(report, of.0, &runs);
    Ok(())
}

/// The placement of a start of an ensemble.
fn started(phi: Matrix<2>, k: u32) -> Matrix<2> {
    let k = 0.03 * f64::from(k);
    phi + Matrix::<2>::new(k, -0.7 * k, 0.4 * k, 0.9 * k)
}

/// The spin at the end of several runs drifts to neither side.
fn no_drift<const N: usize, M: Model<N>>(
    report: &mut StabilityReport,
    model: &'static str,
    runs: &[Run<N, M>],
) {
    let signed = |run: &Run<N, M>| {
        let run = run.as_ref().ok()?;
        let [first, last] =
            [run.points().first()?, run.end().1].map(|point| run.orthonormal(point).spin().0.0[(0, 1)]);
        Some((last - first) / first)
    };
    let ends: Vec<f64> = runs.iter().filter_map(signed).collect();
    let quantity = "mean drift of the spin, in its errors";
    let named = scene(model, N, format!("{STARTS} starts"), quantity, Oracle::Invariance);
    report.case(named, Demand::Held(4.0), || {
        runs.iter().try_for_each(|run| run.as_ref().map(|_| ()).map_err(Clone::clone))?;
        Ok((mean_to_error(&ends), 0))
    });
}

/// A vibrating body, every piece nonlinear.
fn body(report: &mut StabilityReport, steps: f64) -> affine_runtime::Result<()> {
    let phi = Matrix::<2>::new(1.2, 0.3, -0.1, 0.9);
    let start = Disc.at_momentum(phi, Comoving(Matrix::<2>::new(0.3, -0.4, 0.6, -0.1)))?;
    let run = run((&Disc, start), (4, 0.0625), steps);
    let of = ("body-metric", steps);
    let runs: Vec<_> = (0..STARTS)
        .map(|k| {
            let spin = Matrix::<2>::new(0.3, -0.4, 0.6, -0.1);
            let start = Disc.at_momentum(started(phi, k), Comoving(spin))?;
            self::run((&Disc, start), (4, 0.0625), steps / f64::from(STARTS))
        })
        .collect();
    for (name, growing, quantity) in [
        ("spin, eps sqrt(N)", "exponent of the spin", Conserved::Spin),
        ("vorticity, eps sqrt(N)", "exponent of the vorticity", Conserved::Vorticity),
    ] {
        let bound = f64::EPSILON * steps.sqrt();
        size::<2, Disc>(report, of, (name, Oracle::Invariance), bound, &run, |run| drifts(run, quantity));
        exponents::<2, Disc>(report, (of.0, growing), 0.75, &runs, |run| drifts(run, quantity));
    }
    no_drift::<2, Disc>(report, of.0, &runs);
    // The error of order 4 vibrates; what grows would show in the second half.
    let named =
        scene(of.0, 2, format!("{steps:e} steps"), "energy, second half to first", Oracle::Invariance);
    report.case(named, Demand::Held(1.25), || {
        let run = run.as_ref().map_err(Clone::clone)?;
        let energies = drifts(run, Conserved::Energy);
        let (first, second) = energies.split_at(energies.len() / 2);
        Ok((up_to(second, 1) / up_to(first, 1), run.statistics().steps))
    });
    Ok(())
}

/// Without a force every step multiplies by the same exponential, and repeats its one rounding error: the drift is linear,
/// that of a generator that is wrong by a rounding, `eps |O| t`.
fn constant_exponential(report: &mut StabilityReport, steps: f64) -> affine_runtime::Result<()> {
    let phi = Matrix::<2>::new(1.2, 0.3, -0.1, 0.9);
    // Elliptic, so that the body vibrates for ever.
    let spin = Matrix::<2>::new(0.01, -0.4, 0.6, -0.01);
    let start = Free.at_momentum(phi, Comoving(spin))?;
    let run = run((&Free, start), (2, STEP), steps);
    let t = steps * STEP;
    let bound = f64::EPSILON * Free.velocity(&start).phi_dot.norm() * t;
    let of = ("body-metric, free", steps);
    let quantity = ("spin, eps |O| t", Oracle::Invariance);
    size::<2, Free>(report, of, quantity, bound, &run, |run| drifts(run, Conserved::Spin));
    let named = scene(of.0, 2, format!("{steps:e} steps"), "exponent of the spin", Oracle::Invariance);
    report.case(named, Demand::Held(1.25), || {
        let run = run.as_ref().map_err(Clone::clone)?;
        Ok((exponent(&drifts(run, Conserved::Spin)), run.statistics().steps))
    });
    Ok(())
}
