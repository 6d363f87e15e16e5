//! Statistics of what bodies pass through, without storing it: means, extremes and a histogram of ten thousand bodies that
//! vibrate in a harmonic trap.
//!
//! The centre moves by itself, `x'' = -w^2 x`, so that the mean of `x1^2` over full periods is `(x1^2 + (x1'/w)^2)/2` of the
//! start: every body is held against that.

use affine_runtime::prelude::*;
use affine_runtime::report::{Curve, CurveDiagram, CurvePanel};

/// Elastic, in a trap.
#[affine_model(
    dim = 3,
    kinetic(dalembert = 1, space_translation = 1),
    potential = hyperbolic_dilatation(5) + neo_hookean(0.5) + 2*(x[1]^2 + x[2]^2 + x[3]^2),
    emit(lanes),
)]
pub struct Trapped;

type Point = <Trapped as Model<3>>::Point<f64>;

const BODIES: usize = 10_000;
/// That of the trap.
const FREQUENCY: f64 = 2.0;
const PERIODS: f64 = 4.0;
/// The last output is where the first one is, and left out of means.
const OUTPUTS: u32 = 256;
const BINS: usize = 12;
/// Where the histogram of `|phi|` begins, and the width of a bin.
const FROM: f64 = 1.2;
const WIDTH: f64 = 0.1;

/// What is kept of the way of a body, and of all of them.
#[derive(Clone, Default)]
struct Seen {
    outputs: u32,
    squares: f64,
    largest: f64,
    histogram: [u64; BINS],
}

fn main() -> affine_runtime::Result<()> {
    let t_end = PERIODS * std::f64::consts::TAU / FREQUENCY;
    let starts = (0..BODIES).map(start).collect::<affine_runtime::Result<Vec<Point>>>()?;
    let (mut all, mut worst, mut stopped) = (Seen::default(), 0.0_f64, 0);
    Ensemble::new(&Trapped, starts.iter().copied())
        .until(t_end)
        .tolerance(1e-10)
        .every(t_end / f64::from(OUTPUTS))
        .progress_bar()
        .fold(
            |_, _| Seen::default(),
            |seen: &mut Seen, _, point: &Point| {
                if seen.outputs < OUTPUTS {
                    seen.outputs += 1;
                    seen.squares += point.x()[0].powi(2);
                    let size = point.phi().norm();
                    seen.largest = seen.largest.max(size);
                    let bin = ((size - FROM) / WIDTH).clamp(0.0, BINS as f64 - 1.0);
                    seen.histogram[bin as usize] += 1;
                }
            },
            |body| {
                stopped += usize::from(body.end.is_err());
                let (start, seen) = (&starts[body.number as usize], body.folded);
                let exact = 0.5 * (start.x()[0].powi(2) + (start.p()[0] / FREQUENCY).powi(2));
                worst = worst.max((seen.squares / f64::from(seen.outputs) - exact).abs());
                all.outputs += seen.outputs;
                all.squares += seen.squares;
                all.largest = all.largest.max(seen.largest);
                all.histogram.iter_mut().zip(seen.histogram).for_each(|(sum, count)| *sum += count);
            },
        )?;
    println!("{BODIES} bodies, {} outputs, none of which was kept; {stopped} stopped", all.outputs);
    println!("mean of x1^2: {:.6}; largest |phi|: {:.3}", all.squares / f64::from(all.outputs), all.largest);
    println!("means of the bodies are off by at most {worst:.1e} from the closed form");
    for (bin, count) in all.histogram.iter().enumerate() {
        let part = *count as f64 / f64::from(all.outputs);
        println!(
            "|phi| from {:.1}: {part:.4} {}",
            FROM + WIDTH * bin as f64,
            "#".repeat((100.0 * part) as usize)
        );
    }
    draw(&all)?;
    assert!(stopped == 0 && worst < 1e-8 && all.outputs == BODIES as u32 * OUTPUTS);
    Ok(())
}

/// The histogram.
fn draw(all: &Seen) -> affine_runtime::Result<()> {
    // A folder that cannot be made shows in the file that cannot be written.
    let _ = std::fs::create_dir_all("output");
    let bins = all.histogram.iter().enumerate();
    let steps = bins.flat_map(|(bin, count)| {
        let (from, part) = (FROM + WIDTH * bin as f64, *count as f64 / f64::from(all.outputs));
        [(from, part), (from + WIDTH, part)]
    });
    let panel = CurvePanel {
        x: "|phi|".into(),
        y: "part of all outputs".into(),
        logarithmic: false,
        range: None,
        curves: vec![Curve { category: 0, points: steps.collect() }],
    };
    CurveDiagram::new("Ten thousand vibrating bodies", vec![panel]).save_svg("output/statistics.svg")
}

/// Placements and momenta spread evenly, the same in every run.
fn start(body: usize) -> affine_runtime::Result<Point> {
    let vary = |k: usize| ((body * (2 * k + 3)) as f64).sin();
    let phi = Matrix::<3>::from_fn(|i, k| if i == k { 1.0 } else { 0.0 } + 0.08 * vary(3 * i + k));
    let pi = Matrix::<3>::from_fn(|i, k| 0.2 * vary(9 + 3 * i + k));
    let (x, p) = (Vector::<3>::from_fn(|i, _| vary(18 + i)), Vector::<3>::from_fn(|i, _| vary(21 + i)));
    Trapped.at_momentum(x, phi, p, TwoPoint(pi))
}
