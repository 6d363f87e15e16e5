//! Many steps of splitting: how rounding adds up.

use affine_runtime::model::Conserved;
use affine_runtime::prelude::*;
use affine_runtime::report::{Demand, Oracle, StabilityReport, relative_distance};
use affine_runtime::simulate::Method;

use super::Extent;
use super::shared::scene;

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
            Extent::Fast => 1e1,
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

/// The largest of the values up to a part of the run.
fn up_to(values: &[f64], part: usize) -> f64 {
    values.iter().take(values.len() / part).fold(0.0, |most, &value| if value <= most { most } else { value })
}

/// Exponent of the growth of the largest value between a sixteenth of the run and all of it.
fn exponent(values: &[f64]) -> f64 {
    (up_to(values, 1) / up_to(values, 16)).log2() / 4.0
}

/// The rows of a quantity that errs: its error at the end against a bound, and the exponent of its growth.
fn growth<const N: usize, M: Model<N>>(
    report: &mut StabilityReport,
    (model, steps): (&'static str, f64),
    (quantity, of_exponent, oracle): (&'static str, &'static str, Oracle),
    (bound, most): (f64, f64),
    run: &Run<N, M>,
    errors: impl Fn(&Trajectory<N, M::Point<f64>>) -> Vec<f64>,
) {
    let named = |quantity, oracle| scene(model, N, format!("{steps:e} steps"), quantity, oracle);
    report.case(named(quantity, oracle), Demand::Held(bound), || {
        let run = run.as_ref().map_err(Clone::clone)?;
        Ok((up_to(&errors(run), 1), run.statistics().steps))
    });
    report.case(named(of_exponent, oracle), Demand::Held(most), || {
        let run = run.as_ref().map_err(Clone::clone)?;
        Ok((exponent(&errors(run)), run.statistics().steps))
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
    let at_start = kept(&phi, &velocity);
    let root = 10.0 * f64::EPSILON * steps.sqrt();
    let energies = |run: &Trajectory<2, <Springs as Model<2>>::Point<f64>>| -> Vec<f64> {
        let of_point = |point| kept(Phase::phi(point), &Springs.velocity(point).phi_dot);
        run.points().iter().map(|point| (of_point(point) / at_start - 1.0).abs()).collect()
    };
    let names = ("energy of the steps, 10 eps sqrt(N)", "exponent of the energy", Oracle::Invariance);
    growth::<2, Springs>(report, of, names, (root, 0.75), &run, energies);
    let turn = 2.0 * (STEP / 2.0).asin();
    let phases = |run: &Trajectory<2, <Springs as Model<2>>::Point<f64>>| -> Vec<f64> {
        let exact = |t: f64| {
            let (sine, cosine) = (turn * (t / STEP)).sin_cos();
            phi * cosine + velocity * (stretch.sqrt() * sine)
        };
        run.iter().map(|(t, point)| relative_distance(point.phi(), &exact(t))).collect()
    };
    let names = ("phi, 10 eps per radian", "exponent of the phase", Oracle::ClosedForm);
    growth::<2, Springs>(report, of, names, (10.0 * f64::EPSILON * turn * steps, 1.25), &run, phases);
    let names = ("spin, eps sqrt(N)", "exponent of the spin", Oracle::Invariance);
    let spins = |run: &Trajectory<2, _>| drifts(run, Conserved::Spin);
    growth::<2, Springs>(report, of, names, (f64::EPSILON * steps.sqrt(), 0.75), &run, spins);
    Ok(())
}

/// A vibrating body, every piece nonlinear.
fn body(report: &mut StabilityReport, steps: f64) -> affine_runtime::Result<()> {
    let phi = Matrix::<2>::new(1.2, 0.3, -0.1, 0.9);
    let start = Disc.at_momentum(phi, Comoving(Matrix::<2>::new(0.3, -0.4, 0.6, -0.1)))?;
    let run = run((&Disc, start), (4, 0.0625), steps);
    let of = ("body-metric", steps);
    for (names, quantity) in [
        (("spin, eps sqrt(N)", "exponent of the spin", Oracle::Invariance), Conserved::Spin),
        (("vorticity, eps sqrt(N)", "exponent of the vorticity", Oracle::Invariance), Conserved::Vorticity),
    ] {
        let bounds = (f64::EPSILON * steps.sqrt(), 0.75);
        growth::<2, Disc>(report, of, names, bounds, &run, |run| drifts(run, quantity));
    }
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
    let names = ("spin, eps |O| t", "exponent of the spin", Oracle::Invariance);
    growth::<2, Free>(report, of, names, (bound, 1.25), &run, |run| drifts(run, Conserved::Spin));
    Ok(())
}
