//! Many vibrating bodies at once: 4096 starts around that of one body, in vector lanes, against one simulation after the
//! other, on one thread and on all of them; and what it costs to give each body a model of its own, outputs or events.
//!
//! Run times on shared machines are noise: what counts is the ratio, taken in one run, the median of several.

use std::time::Instant;

use affine_runtime::lanes::{Lanes, Widest};
use affine_runtime::prelude::*;
use affine_runtime::simulate::Ends;

/// Affine in space, metrical in the body, with a stiff dilatation and a soft shear.
#[affine_model(
    dim = 3,
    symmetry(space = affine, body = metric),
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1),
    potential = hyperbolic_dilatation(kappa) + neo_hookean(c),
    emit(lanes),
)]
#[derive(Clone)]
pub struct VibratingBody {
    kappa: f64,
    c: f64,
}

type Point = <PreparedVibratingBody as Model<3>>::Point<f64>;

const BODIES: usize = 4096;
const REPEATS: usize = 5;
const T_END: f64 = 10.0;
const TOLERANCE: f64 = 1e-9;

/// What is asked of the bodies.
const ASKED: [&str; 6] = [
    "one by one",
    "in lanes, all threads",
    "in lanes, one thread",
    "  a model each",
    "  outputs, 20 each",
    "  events, two functions",
];

fn main() -> affine_runtime::Result<()> {
    let model = VibratingBody { kappa: 10.0, c: 0.5 }.prepare()?;
    let starts = (0..BODIES).map(|k| start(&model, k)).collect::<affine_runtime::Result<Vec<Point>>>()?;
    let models = vec![model; BODIES];
    let model = &models[0];
    let plain = || Ensemble::new(model, starts.iter().copied()).until(T_END).tolerance(TOLERANCE);
    let ends = |ends: Result<Ends<Point>, _>| ends.into_iter().flatten().map(Result::ok).collect::<Vec<_>>();
    let one_thread = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    let mut rates = ASKED.map(|_| Vec::new());
    let (mut pairs, mut counted) = (Vec::new(), [0; 2]);
    for _ in 0..REPEATS {
        let (alone, rate) = timed(|| one_by_one(model, &starts));
        rates[0].push(rate);
        let (together, rate) = timed(|| ends(plain().run()));
        rates[1].push(rate);
        pairs = alone.into_iter().zip(together).collect();
        let Ok(pool) = &one_thread else { continue };
        pool.install(|| {
            rates[2].push(timed(|| ends(plain().run())).1);
            let each = models.iter().zip(&starts).map(|(model, start)| (model, *start));
            rates[3].push(timed(|| ends(Ensemble::of(each).until(T_END).tolerance(TOLERANCE).run())).1);
            counted = [0; 2];
            let outputs = || plain().every(T_END / 19.0).each(|body| counted[0] += body.folded.len());
            rates[4].push(timed(outputs).1);
            let sections = || {
                let entry = |i, k| Event::new("entry", move |_, point: &Point| point.phi()[(i, k)]).rising();
                vec![entry(0, 1), entry(1, 0)]
            };
            rates[5].push(timed(|| plain().events(sections).each(|body| counted[1] += body.events.len())).1);
        });
    }
    let worst = pairs.iter().map(|(alone, together)| match (alone, together) {
        (Some((alone, _)), Some(together)) => (alone.phi() - together.phi()).norm() / alone.phi().norm(),
        _ => f64::NAN,
    });
    let worst =
        worst.fold(0.0, |worst: f64, error| if error <= worst || worst.is_nan() { worst } else { error });
    println!("{BODIES} bodies to t = {T_END} at {TOLERANCE:e}, {} lanes", Widest::LANES);
    println!("largest difference between the two ways: {worst:.1e}");
    let steps: u64 = pairs.iter().flat_map(|(alone, _)| alone.iter().map(|(_, steps)| steps)).sum();
    println!("{steps} steps, {} outputs, {} events", counted[0], counted[1]);
    let [alone, _, plain, ..] = rates.each_mut().map(|rates| median(rates));
    for (name, rates) in ASKED.iter().zip(&mut rates) {
        let rate = median(rates);
        let (speed, time) = (rate / alone, plain / rate);
        println!(
            "{name:<24} {rate:>9.0} trajectories a second {speed:>6.2}x, {time:.2} times the plain time"
        );
    }
    Ok(())
}

/// A body around the benchmark problem.
fn start(model: &PreparedVibratingBody, index: usize) -> affine_runtime::Result<Point> {
    let vary = |k: usize| 0.05 * ((index * (2 * k + 3)) as f64).sin();
    let phi = Matrix::<3>::new(1.1, 0.2, -0.1, 0.05, 0.9, 0.15, -0.2, 0.1, 1.05);
    let spin = Matrix::<3>::new(0.1, 0.4, -0.3, -0.2, -0.15, 0.25, 0.35, -0.1, 0.05);
    let (phi, spin) = (phi.map_with_location(|i, k, entry| entry + vary(3 * i + k)), spin);
    model.at_momentum(phi, Comoving(spin.map_with_location(|i, k, entry| entry + vary(9 + 3 * i + k))))
}

/// Ends, with the steps that they took.
fn one_by_one(model: &PreparedVibratingBody, starts: &[Point]) -> Vec<Option<(Point, u64)>> {
    let run = |start: &Point| {
        let simulation = Simulation::new(model, *start).until(T_END).tolerance(TOLERANCE).output([]);
        let run = simulation.method(Method::RungeKutta8).run().ok();
        run.map(|run| (*run.end().1, run.statistics().steps))
    };
    starts.iter().map(run).collect()
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
