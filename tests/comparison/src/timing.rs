//! Time of one evaluation of a right-hand side, less that of moving the numbers.

use std::hint::black_box;
use std::time::Instant;

/// States of the throughput measurement.
const STATES: usize = 4096;
/// Evaluations of one chain.
const LINKS: usize = 4096;
/// Repeats, of which the least counts: what else runs on a machine only adds.
const REPEATS: usize = 60;

/// Nanoseconds of one evaluation.
#[derive(Clone, Copy)]
pub(crate) struct Times {
    /// Where each evaluation waits for the one before: `y <- y + h f(y)`.
    pub(crate) chain: f64,
    /// State after state, none waiting for another.
    pub(crate) throughput: f64,
}

/// Times of `f` around a state, less those of a function that only copies.
pub(crate) fn net<const D: usize>(start: [f64; D], f: impl Fn(&[f64; D]) -> [f64; D]) -> Times {
    let (whole, floor) = (gross(start, f), gross(start, |y| *y));
    Times { chain: whole.chain - floor.chain, throughput: whole.throughput - floor.throughput }
}

fn gross<const D: usize>(start: [f64; D], f: impl Fn(&[f64; D]) -> [f64; D]) -> Times {
    let chain = least(|| {
        let mut y = black_box(start);
        for _ in 0..LINKS {
            let slope = f(&y);
            for (y, slope) in y.iter_mut().zip(&slope) {
                // So little that the state stays where it is.
                *y += 1e-12 * slope;
            }
        }
        black_box(y);
    });
    let states = vec![start; STATES];
    let mut slopes = vec![start; STATES];
    let throughput = least(|| {
        for (state, slope) in black_box(&states).iter().zip(&mut slopes) {
            *slope = f(state);
        }
        black_box(&slopes);
    });
    Times { chain: chain / LINKS as f64, throughput: throughput / STATES as f64 }
}

/// Nanoseconds that some work takes at least.
fn least(mut work: impl FnMut()) -> f64 {
    let mut least = f64::INFINITY;
    for _ in 0..REPEATS {
        let begin = Instant::now();
        work();
        least = least.min(begin.elapsed().as_secs_f64() * 1e9);
    }
    least
}
