//! Accuracy and time of the two-polar decomposition beside nalgebra's singular values:
//! `cargo bench -p affine-runtime --bench decompositions`. Errors are against high-precision values, times are medians of
//! repeats in one process, both decompositions with both frames.
#![allow(clippy::unwrap_used)]

use std::collections::BTreeMap;
use std::hint::black_box;
use std::time::Instant;

use affine_runtime::decompose::TwoPolar;
use affine_runtime::frames::Matrix;

const REPEATS: usize = 21;
const ROUNDS: usize = 200;

/// Kind, matrix and the stretches as sums of two doubles.
type Case<const N: usize> = (String, Matrix<N>, Vec<[f64; 2]>);

fn cases<const N: usize>() -> Vec<Case<N>> {
    let rows = include_str!("../tests/data/two_polar.csv").lines().filter(|line| !line.starts_with('#'));
    let fields =
        rows.map(|row| row.split(',').collect::<Vec<_>>()).filter(|fields| fields[0] == N.to_string());
    fields
        .map(|fields| {
            let numbers: Vec<f64> = fields[2..].iter().map(|field| field.parse().unwrap()).collect();
            let (phi, stretches) = numbers.split_at(N * N);
            let stretches = stretches.chunks(2).map(|parts| [parts[0], parts[1]]).collect();
            (fields[1].to_owned(), Matrix::<N>::from_row_slice(phi), stretches)
        })
        .collect()
}

/// Largest errors in units of `eps`: relative to the largest stretch, and of every stretch relative to itself.
fn errors(found: &[f64], expected: &[[f64; 2]]) -> [f64; 2] {
    let mut worst = [0.0_f64; 2];
    for (value, [high, low]) in found.iter().zip(expected) {
        let error = ((value - high) - low).abs() / f64::EPSILON;
        worst[0] = worst[0].max(error / expected[0][0]);
        worst[1] = worst[1].max(error / high);
    }
    worst
}

/// Median time of one call, in nanoseconds.
fn time(calls: usize, mut all: impl FnMut()) -> f64 {
    let mut times: Vec<f64> = (0..REPEATS)
        .map(|_| {
            let start = Instant::now();
            (0..ROUNDS).for_each(|_| all());
            start.elapsed().as_secs_f64() * 1e9 / (calls * ROUNDS) as f64
        })
        .collect();
    times.sort_by(f64::total_cmp);
    times[REPEATS / 2]
}

macro_rules! compare {
    ($n:literal) => {{
        let cases = cases::<$n>();
        let mut worst: BTreeMap<&str, [[f64; 2]; 2]> = BTreeMap::new();
        for (kind, phi, expected) in &cases {
            let ours = TwoPolar::of(phi).map(|found| errors(found.stretches.as_slice(), expected)).unwrap();
            let svd = phi.svd(true, true);
            let theirs = errors(svd.singular_values.as_slice(), expected);
            let entry = worst.entry(kind).or_default();
            for (held, found) in entry.iter_mut().zip([ours, theirs]) {
                (0..2).for_each(|k| held[k] = held[k].max(found[k]));
            }
        }
        println!("n = {}: largest error in eps     to the largest stretch      relative to itself", $n);
        println!("{:24} {:>14} {:>12} {:>14} {:>12}", "", "two_polar", "nalgebra", "two_polar", "nalgebra");
        for (kind, [ours, theirs]) in &worst {
            println!("{kind:24} {:14.2} {:12.2} {:14.2} {:12.2e}", ours[0], theirs[0], ours[1], theirs[1]);
        }
        let random: Vec<_> = cases.iter().filter(|case| case.0 == "random").map(|case| case.1).collect();
        let ours = time(random.len(), || {
            random.iter().for_each(|phi| {
                black_box(TwoPolar::of(black_box(phi))).unwrap();
            });
        });
        let theirs = time(random.len(), || {
            random.iter().for_each(|phi| {
                black_box(black_box(phi).svd(true, true));
            });
        });
        println!("time of one, random matrices: two_polar {ours:.0} ns, nalgebra {theirs:.0} ns\n");
    }};
}

fn main() {
    compare!(2);
    compare!(3);
}
