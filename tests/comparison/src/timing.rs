//! Time of one evaluation of a right-hand side, with that of moving the numbers.

use std::hint::black_box;
use std::time::Instant;

use affine_runtime::lanes::Lanes;

/// States of the throughput measurement.
const STATES: usize = 4096;
/// States of a block in lanes.
const BLOCK: usize = 64;
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

/// A right-hand side. A trait, since a closure is not made part of the function that is compiled for wide vectors.
pub(crate) trait Equations<S> {
    /// Writes the slope; to be `#[inline(always)]`.
    fn slope(&self, y: &S, slope: &mut S);
}

/// Nanoseconds for one state of a block in lanes, with the widest vectors there are. The nearest cache holds the block: one
/// of 4096 states is read and written as slowly as it is evaluated.
pub(crate) fn in_lanes<T: Lanes, S: Copy>(state: S, equations: &impl Equations<S>) -> f64 {
    let states = vec![state; BLOCK / T::LANES];
    let mut slopes = states.clone();
    let arch = pulp::Arch::new();
    let whole = least(|| {
        for _ in 0..STATES / BLOCK {
            arch.dispatch(Pass { states: black_box(&states), slopes: &mut slopes, equations });
            black_box(&mut slopes);
        }
    });
    whole / STATES as f64
}

/// A right-hand side at each state.
struct Pass<'a, S, E> {
    states: &'a [S],
    slopes: &'a mut [S],
    equations: &'a E,
}

impl<S, E: Equations<S>> pulp::WithSimd for Pass<'_, S, E> {
    type Output = ();
    #[inline(always)]
    fn with_simd<V: pulp::Simd>(self, _: V) {
        for (state, slope) in self.states.iter().zip(self.slopes) {
            self.equations.slope(state, slope);
        }
    }
}

/// Times of `f` from a state on.
pub(crate) fn alone<S: AsRef<[f64]> + AsMut<[f64]> + Copy>(start: S, f: impl Fn(&S) -> S) -> Times {
    let chain = least(|| {
        let mut y = black_box(start);
        for _ in 0..LINKS {
            let slope = f(&y);
            for (y, slope) in y.as_mut().iter_mut().zip(slope.as_ref()) {
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
pub(crate) fn least(mut work: impl FnMut()) -> f64 {
    let mut least = f64::INFINITY;
    for _ in 0..REPEATS {
        let begin = Instant::now();
        work();
        least = least.min(begin.elapsed().as_secs_f64() * 1e9);
    }
    least
}
