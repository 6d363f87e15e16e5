//! Many vibrating bodies at once: 4096 starts around that of one body, in vector lanes, against one simulation after the
//! other, on one thread and on all of them; and what it costs to give each body a model of its own, outputs or events.
//!
//! Run times on shared machines are noise: what counts is the ratio, taken in one run, the median of several. Instructions are none:
//! `valgrind --tool=callgrind target/release/examples/vibrating_ensemble outputs 512`, or `plain`, `a model each`, `events`.

use std::time::Instant;

use affine_runtime::lanes::{F64x8, Lanes};
use affine_runtime::prelude::*;

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
    "plain, in lanes, one thread",
    "  a model each",
    "  outputs, 20 each",
    "  events, two functions",
];

fn main() -> affine_runtime::Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let count = arguments.get(1).and_then(|count| count.parse().ok()).unwrap_or(BODIES);
    let model = VibratingBody { kappa: 10.0, c: 0.5 }.prepare()?;
    let starts = (0..count).map(|k| start(&model, k)).collect::<affine_runtime::Result<Vec<Point>>>()?;
    let models = vec![model; count];
    let Ok(one_thread) = rayon::ThreadPoolBuilder::new().num_threads(1).build() else { return Ok(()) };
    if let Some(asked) = arguments.first() {
        let asked = ASKED.iter().position(|own| own.trim().starts_with(asked.as_str())).unwrap_or(2);
        let found = one_thread.install(|| ask(asked, &models, &starts));
        println!("{}: {} ends, {} outputs and events", ASKED[asked].trim(), found.0.len(), found.1);
        return Ok(());
    }
    let mut rates = ASKED.map(|_| Vec::new());
    let (mut pairs, mut counted) = (Vec::new(), [0; 2]);
    for _ in 0..REPEATS {
        let (alone, rate) = timed(|| one_by_one(&models[0], &starts));
        rates[0].push(rate);
        let ((together, _), rate) = timed(|| ask(1, &models, &starts));
        rates[1].push(rate);
        pairs = alone.into_iter().zip(together).collect();
        one_thread.install(|| {
            for asked in 2..ASKED.len() {
                let ((_, found), rate) = timed(|| ask(asked, &models, &starts));
                rates[asked].push(rate);
                counted = [counted[1], found];
            }
        });
    }
    let worst = pairs.iter().map(|(alone, together)| match (alone, together) {
        (Some((alone, _)), Some(together)) => (alone.phi() - together.phi()).norm() / alone.phi().norm(),
        _ => f64::NAN,
    });
    let worst =
        worst.fold(0.0, |worst: f64, error| if error <= worst || worst.is_nan() { worst } else { error });
    println!("{BODIES} bodies to t = {T_END} at {TOLERANCE:e}, {} lanes", F64x8::LANES);
    println!("largest difference between the two ways: {worst:.1e}");
    let steps: u64 = pairs.iter().flat_map(|(alone, _)| alone.iter().map(|(_, steps)| steps)).sum();
    println!("{steps} steps, {} outputs, {} events", counted[0], counted[1]);
    let [alone, _, plain, ..] = rates.each_mut().map(|rates| median(rates));
    for (name, rates) in ASKED.iter().zip(&mut rates) {
        let rate = median(rates);
        let (speed, time) = (rate / alone, plain / rate);
        println!(
            "{name:<28} {rate:>9.0} trajectories a second {speed:>6.2}x, {time:.2} times the plain time"
        );
    }
    Ok(())
}

/// The ends of all bodies, in the order of what is [asked](ASKED), and how many outputs or events there were.
fn ask(asked: usize, models: &[PreparedVibratingBody], starts: &[Point]) -> (Vec<Option<Point>>, usize) {
    let ensemble = || Ensemble::new(&models[0], starts.iter().copied()).until(T_END).tolerance(TOLERANCE);
    let (mut ends, mut counted) = (Vec::new(), 0);
    let ran = match asked {
        3 => {
            let each = Ensemble::of(models.iter().zip(starts.iter().copied()));
            each.until(T_END).tolerance(TOLERANCE).run().map(|found| ends = found)
        }
        4 => ensemble().every(T_END / 19.0).each(|body| {
            counted += body.folded.len();
            ends.push(body.end);
        }),
        5 => {
            let entry = |i, k| Event::new("entry", move |_, point: &Point| point.phi()[(i, k)]).rising();
            ensemble().events(move || vec![entry(0, 1), entry(1, 0)]).each(|body| {
                counted += body.events.len();
                ends.push(body.end);
            })
        }
        _ => ensemble().run().map(|found| ends = found),
    };
    // Settings that make no sense would be no ends, and a difference that is no number.
    (ran.map_or(Vec::new(), |()| ends.into_iter().map(Result::ok).collect()), counted)
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
