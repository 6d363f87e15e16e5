//! Many vibrating bodies at once: 4096 starts around that of one body, in vector lanes, against one simulation after the
//! other, on one thread and on all of them.
//!
//! Run times on shared machines are noise: what counts is the ratio, taken in one run, the median of several.

use std::time::Instant;

use affine_runtime::lanes::{Lanes, Widest};
use affine_runtime::prelude::*;

/// Affine in space, metrical in the body, with a stiff dilatation and a soft shear.
#[affine_model(
    dim = 3,
    symmetry(space = affine, body = metric),
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1),
    potential = hyperbolic_dilatation(10) + neo_hookean(0.5),
    emit(lanes),
)]
pub struct VibratingBody;

type Point = <VibratingBody as Model<3>>::Point<f64>;

const BODIES: usize = 4096;
const REPEATS: usize = 5;
const T_END: f64 = 10.0;
const TOLERANCE: f64 = 1e-9;

fn main() -> affine_runtime::Result<()> {
    let starts = (0..BODIES).map(start).collect::<affine_runtime::Result<Vec<Point>>>()?;
    let one_thread = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    let mut rates = [Vec::new(), Vec::new(), Vec::new()];
    let mut ends = Vec::new();
    for _ in 0..REPEATS {
        let (alone, rate) = timed(|| one_by_one(&starts));
        rates[0].push(rate);
        if let Ok(pool) = &one_thread {
            rates[1].push(timed(|| pool.install(|| in_lanes(&starts))).1);
        }
        let (together, rate) = timed(|| in_lanes(&starts));
        rates[2].push(rate);
        ends = alone.into_iter().zip(together).collect();
    }
    let worst = ends.iter().map(|(alone, together)| match (alone, together) {
        (Some(alone), Some(together)) => (alone.phi() - together.phi()).norm() / alone.phi().norm(),
        _ => f64::NAN,
    });
    let worst =
        worst.fold(0.0, |worst: f64, error| if error <= worst || worst.is_nan() { worst } else { error });
    println!("{BODIES} bodies to t = {T_END} at {TOLERANCE:e}, {} lanes", Widest::LANES);
    println!("largest difference between the two ways: {worst:.1e}");
    let scalar = median(&mut rates[0]);
    for (name, rates) in
        ["one by one", "in lanes, one thread", "in lanes, all threads"].iter().zip(&mut rates)
    {
        let rate = median(rates);
        println!("{name:<22} {rate:>9.0} trajectories a second   {:>5.2}x", rate / scalar);
    }
    Ok(())
}

/// A body around the benchmark problem.
fn start(index: usize) -> affine_runtime::Result<Point> {
    let vary = |k: usize| 0.05 * ((index * (2 * k + 3)) as f64).sin();
    let phi = Matrix::<3>::new(1.1, 0.2, -0.1, 0.05, 0.9, 0.15, -0.2, 0.1, 1.05);
    let spin = Matrix::<3>::new(0.1, 0.4, -0.3, -0.2, -0.15, 0.25, 0.35, -0.1, 0.05);
    let (phi, spin) = (phi.map_with_location(|i, k, entry| entry + vary(3 * i + k)), spin);
    VibratingBody
        .at_momentum(phi, Comoving(spin.map_with_location(|i, k, entry| entry + vary(9 + 3 * i + k))))
}

fn one_by_one(starts: &[Point]) -> Vec<Option<Point>> {
    let run = |start: &Point| {
        let simulation = Simulation::new(&VibratingBody, *start).until(T_END).tolerance(TOLERANCE).output([]);
        simulation.method(Method::RungeKutta8).run().ok().map(|run| *run.end().1)
    };
    starts.iter().map(run).collect()
}

fn in_lanes(starts: &[Point]) -> Vec<Option<Point>> {
    let ensemble = Ensemble::new(&VibratingBody, starts.iter().copied()).until(T_END).tolerance(TOLERANCE);
    ensemble.run().map_or_else(|_| Vec::new(), |ends| ends.into_iter().map(Result::ok).collect())
}

fn timed<R>(work: impl FnOnce() -> R) -> (R, f64) {
    let begin = Instant::now();
    let result = work();
    (result, BODIES as f64 / begin.elapsed().as_secs_f64())
}

fn median(values: &mut [f64]) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}
