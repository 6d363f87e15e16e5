//! Which share of the fused multiply-adds that one core can do is reached: by equations in lanes, by bodies in lanes, by
//! Runge-Kutta 8 and Taylor steps of one body.
//!
//! Additions and multiplications of equations and of Taylor coefficients are counted by calling them with numbers that count;
//! other operations are left out. A Runge-Kutta step has [`STAGE_SUMS`] multiply-adds a component besides. A multiply-add is two
//! operations, so that equations whose additions and multiplications do not pair cannot reach the whole.

use std::hint::black_box;

use affine_runtime::capability::{InLanes, Taylor};
use affine_runtime::counting::Counting;
use affine_runtime::lanes::F64x8;
use affine_runtime::model::{Operations, StateVector};
use affine_runtime::prelude::*;

use crate::problems::Visitor;
use crate::right_hand_sides::reduced_in_lanes;
use crate::timing::least;

/// Multiply-adds for each component in a step of Runge-Kutta 8: 50 coefficients between stages, 8 of the solution, 8 and 3 of the
/// two estimates of its error.
const STAGE_SUMS: u64 = 50 + 8 + 8 + 3;
const STAGES: u64 = 12;
/// Of the Taylor series.
const ORDER: usize = 18;
const BODIES: usize = 512;
const TOLERANCE: f64 = 1e-9;
/// Products that do not wait for each other: two units of four cycles, and as many again.
const CHAINS: usize = 16;
const LINKS: usize = 1 << 16;

/// Prints a line for each problem.
pub(crate) struct Shares;

impl Visitor for Shares {
    fn visit<M: InLanes<3, Point<f64>: Send + Sync> + Taylor<3> + Sync>(
        &mut self,
        name: &'static str,
        model: &M,
        [start, _]: [M::Point<f64>; 2],
        t_end: f64,
    ) -> affine_runtime::Result<()> {
        if !["P1", "P2", "P3"].contains(&name) {
            return Ok(());
        }
        let starts: Vec<M::Point<f64>> = (0..BODIES).map(|k| near(model, &start, k)).collect();
        let per_evaluation = equations(model, &start);
        let components = M::Reduced::<f64>::LEN as u64;
        let per_step = STAGES * per_evaluation + 2 * STAGE_SUMS * components;

        let in_lanes = reduced_in_lanes::<F64x8, M>(model, &start);
        let mut steps = 0;
        for start in &starts {
            let run = one(model, *start, t_end, Method::RungeKutta8)?;
            steps += run.statistics().steps + run.statistics().rejected;
        }
        let bodies = least(|| {
            let ensemble = Ensemble::new(model, starts.iter().copied()).until(t_end).tolerance(TOLERANCE);
            let _ = black_box(ensemble.run());
        });
        let each = least(|| {
            for start in &starts[..8] {
                let _ = black_box(one(model, *start, t_end, Method::RungeKutta8));
            }
        });
        let (mut own, mut of_series) = (0, 0);
        let taylor = Method::Taylor { order: Some(ORDER) };
        for start in &starts[..8] {
            own += one(model, *start, t_end, Method::RungeKutta8)?.statistics().steps;
            of_series += one(model, *start, t_end, taylor)?.statistics().steps;
        }
        let series = least(|| {
            for start in &starts[..8] {
                let _ = black_box(one(model, *start, t_end, taylor));
            }
        });
        let per_series = coefficients(model, &start) + 2 * ORDER as u64 * components;

        let peak = peak();
        let shares = [
            per_evaluation as f64 / in_lanes,
            (steps * per_step) as f64 / bodies,
            (own * per_step) as f64 / each,
            (of_series * per_series) as f64 / series,
        ];
        let shares = shares.map(|rate| format!("{rate:>9.1}{:>6.0} %", 100.0 * rate / peak));
        println!(
            "{name:<6}{peak:>8.1}{}   {:>8.1}{:>12.0}{:>12.0}",
            shares.concat(),
            BODIES as f64 / bodies * 1e6,
            each / own as f64,
            series / of_series as f64
        );
        Ok(())
    }
}

/// What the columns are.
pub(crate) fn print_head() {
    println!(
        "operations in a nanosecond of one core, and their share of those in fused multiply-adds on the widest vectors\n"
    );
    println!(
        "{:<6}{:>8}{:>17}{:>17}{:>17}{:>17}   {:>8}{:>12}{:>12}",
        "", "most", "equations,", "bodies,", "one body,", "one body,", "bodies", "ns a step,", "ns a step,"
    );
    println!(
        "{:<6}{:>8}{:>17}{:>17}{:>17}{:>17}   {:>8}{:>12}{:>12}",
        "", "", "lanes", "lanes", "RK8", "Taylor 18", "in ms", "RK8", "Taylor 18"
    );
}

/// A start near another one.
fn near<M: Model<3>>(model: &M, start: &M::Point<f64>, index: usize) -> M::Point<f64> {
    let mut full = model.flatten(start);
    for (k, value) in full.as_mut().iter_mut().enumerate() {
        *value *= 1.0 + 0.02 * ((index * (2 * k + 3)) as f64).sin();
    }
    model.unflatten(&full)
}

fn one<M: Model<3>>(
    model: &M,
    start: M::Point<f64>,
    t_end: f64,
    method: Method,
) -> affine_runtime::Result<Trajectory<3, M::Point<f64>>> {
    Ok(Simulation::new(model, start).until(t_end).tolerance(TOLERANCE).output([]).method(method).run()?)
}

/// Additions and multiplications of an evaluation of the reduced equations.
fn equations<M: Model<3>>(model: &M, start: &M::Point<f64>) -> u64 {
    let start = counted::<M>(model, start);
    let (reduced, constants) = model.reduce(Counting::from(0.0), &start);
    let (_, done) = Counting::count(|| model.reduced_equations(Counting::from(0.0), &constants, &reduced));
    products(done)
}

/// Those of the coefficients of a Taylor series.
fn coefficients<M: Taylor<3>>(model: &M, start: &M::Point<f64>) -> u64 {
    let start = counted::<M>(model, start);
    let (reduced, constants) = model.reduce(Counting::from(0.0), &start);
    let mut coefficients = vec![reduced; ORDER + 1];
    let mut rows = vec![M::Row::<Counting>::zeros(); ORDER];
    let at = (Counting::from(0.0), Counting::from(1.0));
    let ((), done) = Counting::count(|| model.coefficients(at, &constants, &mut coefficients, &mut rows));
    products(done)
}

fn counted<M: Model<3>>(model: &M, start: &M::Point<f64>) -> M::Point<Counting> {
    let mut full = M::Full::<Counting>::zeros();
    for (own, value) in full.as_mut().iter_mut().zip(model.flatten(start).as_ref()) {
        *own = Counting::from(*value);
    }
    model.unflatten(&full)
}

fn products(done: Operations) -> u64 {
    (done.mul + done.add) as u64
}

/// Operations in a nanosecond, in fused multiply-adds that do not wait for each other.
fn peak() -> f64 {
    let arch = pulp::Arch::new();
    let mut lanes = 0;
    let whole = least(|| lanes = arch.dispatch(Chains));
    (2 * CHAINS * LINKS * lanes) as f64 / whole
}

struct Chains;

impl pulp::WithSimd for Chains {
    /// Numbers in a vector.
    type Output = usize;
    #[inline(always)]
    fn with_simd<V: pulp::Simd>(self, simd: V) -> usize {
        let (factor, term) = (simd.splat_f64s(black_box(0.75)), simd.splat_f64s(black_box(0.25)));
        let mut chains = [simd.splat_f64s(black_box(2.0)); CHAINS];
        for _ in 0..LINKS {
            for chain in &mut chains {
                *chain = simd.mul_add_f64s(*chain, factor, term);
            }
        }
        black_box(chains);
        V::F64_LANES
    }
}
