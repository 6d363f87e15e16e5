//! The lattice of stretches: its equations with exponentials and in ratios of stretches, and its motion by adaptive steps
//! of order 8, in ratios, and by splitting: `cargo bench -p affine-runtime --bench lattice`. Times are medians of repeats in one process;
//! errors are of `q, p, M, N` at the end, against a run at the smallest tolerance.
#![allow(clippy::unwrap_used)]

use std::hint::black_box;
use std::time::Instant;

use affine_integrators::RungeKutta8;
use affine_runtime::frames::Matrix;
use affine_runtime::lattice::{
    Lattice, LatticeFlow, LatticeForm, LatticePieces, LatticeSplitting, RatioForm, TwoPolarForm,
};
use affine_runtime::model::{Group, Quantity};
use affine_runtime::prelude::*;

const REPEATS: usize = 11;

/// Problem P4.
#[affine_model(dim = 3, kinetic(casimir2 = 1.2, casimir1_squared = 0.1), emit(two_polar, ratios, splitting))]
struct Geodesic;

/// Stretches on springs.
#[affine_model(
    dim = 3,
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1),
    potential = q1^2 + q2^2 + q3^2,
    emit(two_polar, splitting)
)]
struct Springs;

/// Two of them.
#[affine_model(
    dim = 2,
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1),
    potential = q1^2 + q2^2,
    emit(two_polar, splitting)
)]
struct Pair;

fn skew<const N: usize>(entries: [f64; 3]) -> Matrix<N> {
    let mut matrix = Matrix::<N>::zeros();
    for (k, (a, b)) in (0..N).flat_map(|a| (a + 1..N).map(move |b| (a, b))).enumerate() {
        (matrix[(a, b)], matrix[(b, a)]) = (entries[k], -entries[k]);
    }
    matrix
}

fn start<const N: usize>(q: [f64; 3], m: [f64; 3], n: [f64; 3]) -> Lattice<N> {
    Lattice {
        q: Vector::<N>::from_fn(|a, _| q[a]),
        p: Vector::<N>::from_fn(|a, _| [0.15, -0.3, 0.2][a]),
        m: skew(m),
        n: skew(n),
        left: Matrix::identity(),
        right: Matrix::identity(),
    }
}

/// Median time, in microseconds.
fn time<R>(rounds: usize, mut run: impl FnMut() -> R) -> f64 {
    let mut times: Vec<f64> = (0..REPEATS)
        .map(|_| {
            let begin = Instant::now();
            (0..rounds).for_each(|_| {
                black_box(run());
            });
            begin.elapsed().as_secs_f64() * 1e6 / rounds as f64
        })
        .collect();
    times.sort_by(f64::total_cmp);
    times[REPEATS / 2]
}

fn distance<const N: usize>(a: &Lattice<N>, b: &Lattice<N>) -> f64 {
    let relative = |a: &[f64], b: &[f64]| {
        let size = b.iter().fold(1.0_f64, |most, v| most.max(v.abs()));
        a.iter().zip(b).map(|(a, b)| (a - b).abs() / size).fold(0.0, f64::max)
    };
    let pairs = [
        relative(a.q.as_slice(), b.q.as_slice()),
        relative(a.p.as_slice(), b.p.as_slice()),
        relative(a.m.as_slice(), b.m.as_slice()),
        relative(a.n.as_slice(), b.n.as_slice()),
    ];
    pairs.into_iter().fold(0.0, f64::max)
}

/// Time of one evaluation where each depends on the one before, in nanoseconds.
fn equations() {
    const CHAIN: usize = 10_000;
    let lattice = start::<3>([0.9, 0.1, -0.7], [0.5, -0.4, 0.3], [0.6, 0.25, -0.45]);
    let step = black_box(1e-9);
    let (couplings, places) = lattice.places::<Geodesic>();
    let plain = time(1, || {
        let mut state = places;
        for _ in 0..CHAIN {
            let rates = Geodesic.lattice_equations(&couplings, &state);
            state.iter_mut().zip(rates).for_each(|(value, rate)| *value += step * rate);
        }
        state
    });
    let (couplings, ratios) = Geodesic.in_ratios(&lattice);
    let rational = time(1, || {
        let mut state = ratios;
        for _ in 0..CHAIN {
            let rates = Geodesic.ratio_equations(&couplings, &state);
            state.iter_mut().zip(rates).for_each(|(value, rate)| *value += step * rate);
        }
        state
    });
    let ns = |total: f64| total * 1e3 / CHAIN as f64;
    println!("equations of P4, each evaluation on the result of the last one");
    println!("  (q, p, M, N), {:?}: {:.1} ns", Geodesic::LATTICE.operations, ns(plain));
    println!("  ratios, {:?}: {:.1} ns\n", Geodesic::RATIO_OPERATIONS, ns(rational));
}

/// P4 to `t_end` at several tolerances, without frames in ratios.
fn in_ratios(lattice: &Lattice<3>, t_end: f64, expected: &Lattice<3>) {
    let (couplings, state) = Geodesic.in_ratios(lattice);
    const GROUPS: &[Group] = &[
        Group::new(Quantity::Other("t"), 1),
        Group::new(Quantity::Other("t"), 1),
        Group::new(Quantity::LatticeMomenta, 9),
    ];
    let run = |tolerance: f64| {
        let rates = |_: f64, state: &<Geodesic as RatioForm<3>>::Ratios<f64>| {
            Geodesic.ratio_equations(&couplings, state)
        };
        let mut steps = RungeKutta8::new(rates, GROUPS, (0.0, state), t_end, tolerance).unwrap();
        while !steps.is_finished() {
            steps.advance().unwrap();
        }
        let q = lattice.q.sum() / 3.0 + t_end * Geodesic.mean_rate(lattice);
        Geodesic.of_ratios(&couplings, steps.y(), q)
    };
    for tolerance in [1e-6, 1e-9, 1e-12, 1e-15] {
        let error = distance(&run(tolerance), expected);
        println!(
            "  ratios, tolerance {tolerance:.0e}: {:8.1} us, error {error:.1e}",
            time(20, || run(tolerance))
        );
    }
}

fn motion<const N: usize, M: LatticePieces<N> + TwoPolarForm<N>>(
    model: &M,
    lattice: &Lattice<N>,
    t_end: f64,
    steps: [&[f64]; 4],
) -> Lattice<N> {
    let flow = |tolerance: f64| {
        let mut flow = LatticeFlow::new(model, 0.0, *lattice).tolerance(tolerance);
        *flow.advance_to(t_end).unwrap()
    };
    let expected = flow(1e-15);
    println!("{}, n = {N}, to t = {t_end}", M::DESCRIPTION.name);
    for tolerance in [1e-6, 1e-9, 1e-12] {
        let error = distance(&flow(tolerance), &expected);
        println!(
            "  adaptive, tolerance {tolerance:.0e}: {:8.1} us, error {error:.1e}",
            time(20, || flow(tolerance))
        );
    }
    for (order, steps) in [2, 4, 6, 8].into_iter().zip(steps) {
        for step in steps {
            let run = || {
                LatticeSplitting::new(model, order, (0.0, *lattice), t_end, *step).unwrap().unwrap().finish()
            };
            match run() {
                Ok(end) => {
                    let error = distance(&end, &expected);
                    println!("  splitting {order}, step {step}: {:8.1} us, error {error:.1e}", time(5, run));
                }
                Err(stop) => println!("  splitting {order}, step {step}: {stop}"),
            }
        }
    }
    expected
}

fn main() {
    equations();
    let steps: [&[f64]; 4] = [&[0.02, 0.002], &[0.1, 0.02], &[0.1, 0.02], &[0.2, 0.05]];
    let lattice = start::<3>([0.9, 0.1, -0.7], [0.5, -0.4, 0.3], [0.6, 0.25, -0.45]);
    let expected = motion(&Geodesic, &lattice, 10.0, steps);
    in_ratios(&lattice, 10.0, &expected);
    let wide = start::<3>([0.9, 0.03, -0.95], [0.15, 6.0, -0.1], [0.1, 0.4, 0.2]);
    motion(&Springs, &wide, 10.0, steps);
    let pair = start::<2>([0.9, -0.7, 0.0], [2.0, 0.0, 0.0], [0.6, 0.0, 0.0]);
    motion(&Pair, &pair, 10.0, steps);
    motion(&Pair, &pair, 100.0, steps);
}
