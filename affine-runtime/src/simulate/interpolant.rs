//! Polynomials that stand for a motion: by its numbers at Chebyshev points, as many as it takes.

use core::f64::consts::PI;

use crate::error::Reason;
use crate::inner::{larger, norm};
use crate::numbers::Numbers;

/// Degrees of polynomials: they are doubled until the next one adds nothing, and the highest is for what none is enough for.
const LOWEST_DEGREE: usize = 4;
const HIGHEST_DEGREE: usize = 32;
/// A step that no degree is enough for is halved so many times.
const MOST_HALVINGS: u32 = 5;
/// Differences of so many bounds that halving leaves as they are belong to rounding.
const NEAR_THE_BOUND: f64 = 1024.0;
/// Times are known to a few roundings, and the motion changes by its size within a step.
const ROUNDINGS: f64 = 4.0;
/// A part of the interval by which a value beside a Chebyshev point does not differ from that there. Reciprocals of smaller ones
/// may be no numbers.
const NEXT_TO_A_POINT: f64 = 1e-150;
/// What an error of a momentum may move the placement by within a step is a part of the placement's own error, as for steps:
/// see [`ErrorNorm`](affine_integrators::ErrorNorm).
const PART_OF_DISPLACEMENT: f64 = 0.1;

/// A polynomial in time, by its values at the Chebyshev points of an interval, ends included.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Polynomial {
    pub(super) from: f64,
    pub(super) to: f64,
    degree: usize,
    /// Numbers of a phase point in `N` dimensions, point after point.
    values: Box<[f64]>,
}

impl Polynomial {
    /// Its value, by the barycentric formula (J.-P. Berrut, L. N. Trefethen, SIAM Review 46 (2004) 501-517): that of a
    /// Chebyshev point there, bit by bit.
    pub(super) fn at(&self, t: f64) -> Numbers {
        let part = (t - self.from) / (self.to - self.from);
        interpolated(part, self.degree, |k| {
            let width = self.values.len() / (self.degree + 1);
            let mut value = [0.0; 24];
            value[..width].copy_from_slice(&self.values[k * width..(k + 1) * width]);
            value
        })
    }
}

/// Chebyshev point `k` of `0..=degree`, as a part of the interval; the points of a degree are among those of its double.
fn chebyshev(k: usize, degree: usize) -> f64 {
    let sine = libm::sin(PI * k as f64 / (2 * degree) as f64);
    sine * sine
}

fn interpolated(part: f64, degree: usize, value: impl Fn(usize) -> Numbers) -> Numbers {
    let (mut sum, mut weights) = ([0.0; 24], 0.0);
    for k in 0..=degree {
        let distance = part - chebyshev(k, degree);
        if distance.abs() < NEXT_TO_A_POINT {
            return value(k);
        }
        let sign = if k % 2 == 0 { 1.0 } else { -1.0 };
        let weight = if k == 0 || k == degree { 0.5 * sign } else { sign } / distance;
        weights += weight;
        sum.iter_mut().zip(value(k)).for_each(|(sum, value)| *sum += weight * value);
    }
    sum.map(|sum| sum / weights)
}

/// What polynomials are made from.
pub(super) struct Fit<'f, const N: usize> {
    /// The motion.
    pub(super) at: &'f mut dyn FnMut(f64) -> Result<Numbers, Reason>,
    /// The largest difference from it, relative to the sizes of what it consists of.
    pub(super) bound: f64,
}

impl<const N: usize> Fit<'_, N> {
    /// Polynomials from a time to another, given the numbers at both, handed over in their order.
    ///
    /// # Errors
    /// Those of the motion.
    pub(super) fn cover(
        &mut self,
        begin: (f64, Numbers),
        end: (f64, Numbers),
        each: &mut dyn FnMut(Polynomial),
    ) -> Result<(), Reason> {
        self.halved(begin, end, (0, f64::INFINITY), each)
    }

    /// One polynomial or those of both halves; `halvings` before, with the difference that was left.
    fn halved(
        &mut self,
        begin: (f64, Numbers),
        end: (f64, Numbers),
        (halvings, before): (u32, f64),
        each: &mut dyn FnMut(Polynomial),
    ) -> Result<(), Reason> {
        // Times that are rounded are those of another point.
        let rounding = f64::EPSILON * larger(begin.0.abs(), end.0.abs()) / (end.0 - begin.0).abs();
        let bound = larger(self.bound, ROUNDINGS * rounding);
        let (polynomial, difference) = self.polynomial(begin, end, bound)?;
        let middle = begin.0 + 0.5 * (end.0 - begin.0);
        let is_rounding = difference <= NEAR_THE_BOUND * bound && difference > 0.5 * before;
        let is_parted = middle != begin.0 && middle != end.0;
        if difference <= bound || is_rounding || halvings == MOST_HALVINGS || !is_parted {
            each(polynomial);
            return Ok(());
        }
        let middle = (middle, (self.at)(middle)?);
        self.halved(begin, middle, (halvings + 1, difference), each)?;
        self.halved(middle, end, (halvings + 1, difference), each)
    }

    /// The first polynomial that the motion agrees with at the points of the double degree, or the last one, with the largest
    /// difference.
    fn polynomial(
        &mut self,
        (from, begin): (f64, Numbers),
        (to, end): (f64, Numbers),
        bound: f64,
    ) -> Result<(Polynomial, f64), Reason> {
        let mut degree = LOWEST_DEGREE;
        let mut values = vec![begin, end];
        self.refine((from, to), LOWEST_DEGREE, &mut values)?;
        loop {
            let coarse = values.clone();
            self.refine((from, to), 2 * degree, &mut values)?;
            let scales = scales::<N>(&values);
            let difference = (1..2 * degree).step_by(2).fold(0.0, |most, k| {
                let between = interpolated(chebyshev(k, 2 * degree), degree, |k| coarse[k]);
                larger(most, difference::<N>(&values[k], &between, &scales))
            });
            if difference <= bound || 2 * degree == HIGHEST_DEGREE {
                let (degree, values) =
                    if difference <= bound { (degree, coarse) } else { (2 * degree, values) };
                let width = 2 * N * (N + 1);
                let values = values.iter().flat_map(|value| value[..width].iter().copied()).collect();
                return Ok((Polynomial { from, to, degree, values }, difference));
            }
            degree *= 2;
        }
    }

    /// The motion at the Chebyshev points of a degree, from where it is known at those of a lower one.
    fn refine(
        &mut self,
        (from, to): (f64, f64),
        degree: usize,
        values: &mut Vec<Numbers>,
    ) -> Result<(), Reason> {
        let apart = degree / (values.len() - 1);
        let known = core::mem::take(values);
        for k in 0..=degree {
            values.push(match k % apart {
                0 => known[k / apart],
                _ => (self.at)(from + chebyshev(k, degree) * (to - from))?,
            });
        }
        Ok(())
    }
}

/// Where placement, affine spin, position and linear momentum are among the numbers.
const fn groups<const N: usize>() -> [(usize, usize); 4] {
    let square = N * N;
    [(0, square), (square, 2 * square), (2 * square, 2 * square + N), (2 * square + N, 2 * square + 2 * N)]
}

fn sized(numbers: &Numbers, (from, to): (usize, usize)) -> f64 {
    norm(&numbers[from..to])
}

fn difference<const N: usize>(a: &Numbers, b: &Numbers, scales: &[f64; 4]) -> f64 {
    let mut off = *a;
    off.iter_mut().zip(b).for_each(|(a, b)| *a -= b);
    groups::<N>().into_iter().zip(scales).fold(0.0, |most, (group, scale)| match sized(&off, group) {
        0.0 => most,
        off => larger(most, off / scale),
    })
}

/// What differences are measured against, group by group, as errors of steps are: see [`ErrorNorm`](affine_integrators::ErrorNorm).
fn scales<const N: usize>(values: &[Numbers]) -> [f64; 4] {
    let [phi, spin, x, p] = groups::<N>();
    let largest = |group| values.iter().fold(0.0, |most, value| larger(most, sized(value, group)));
    let moved = |group| {
        let displacement = |value: &Numbers| {
            let mut displacement = *value;
            displacement.iter_mut().zip(values[0]).for_each(|(value, begin)| *value -= begin);
            sized(&displacement, group)
        };
        values.iter().fold(0.0, |most, value| larger(most, displacement(value)))
    };
    let placement = largest(phi);
    let position = placement + largest(x);
    let slack = |reach: f64, moved: f64| larger(1.0, PART_OF_DISPLACEMENT * reach / moved);
    [
        placement,
        largest(spin) * slack(placement, moved(phi)),
        position,
        largest(p) * slack(position, moved(x)),
    ]
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    /// A motion of the first number, the others staying where they are.
    fn covered(motion: impl Fn(f64) -> f64, (from, to): (f64, f64), bound: f64) -> (Vec<Polynomial>, u32) {
        let mut calls = 0;
        let numbers = |t: f64| {
            let mut numbers = [0.0; 24];
            (numbers[0], numbers[3]) = (motion(t), 1.0);
            numbers
        };
        let mut at = |t: f64| {
            calls += 1;
            assert!((t - from) * (to - t) >= 0.0, "{t} is not between {from} and {to}");
            Ok(numbers(t))
        };
        let mut pieces = Vec::new();
        let ends = [(from, numbers(from)), (to, numbers(to))];
        Fit::<2> { at: &mut at, bound }.cover(ends[0], ends[1], &mut |piece| pieces.push(piece)).unwrap();
        (pieces, calls)
    }

    fn worst(pieces: &[Polynomial], motion: impl Fn(f64) -> f64) -> f64 {
        pieces.iter().fold(0.0, |worst, piece| {
            let off = |k: u32| {
                let t = piece.from + (piece.to - piece.from) * f64::from(k) / 97.0;
                (piece.at(t)[0] - motion(t)).abs()
            };
            (0..=97).map(off).fold(worst, f64::max)
        })
    }

    #[test]
    fn polynomials_are_themselves() {
        let motion = |t: f64| 1.0 - t + 3.0 * t.powi(3) - t.powi(4);
        for (from, to) in [(0.0, 1.0), (1.0, -0.5), (1e6, 1e6 + 1.0 / 64.0)] {
            let (pieces, calls) = covered(|t| motion(t - from), (from, to), 1e-13);
            assert_eq!((pieces.len(), pieces[0].degree, calls), (1, 4, 7), "as many points as it takes");
            assert_eq!((pieces[0].from, pieces[0].to), (from, to));
            let rounding = f64::EPSILON * from.abs();
            assert!(worst(&pieces, |t| motion(t - from)) < 1e-13 + 4.0 * rounding);
            assert_eq!(pieces[0].at(to)[0], motion(to - from), "the ends are kept");
            assert_eq!(pieces[0].values.len(), 5 * 12, "numbers of two dimensions");
        }
        let (pieces, _) = covered(motion, (0.0, 1.0), 1e-13);
        assert_eq!(pieces[0].at(5e-324)[0], 1.0, "beside an end");
    }

    #[test]
    fn the_bound_is_kept_by_degree_or_by_halves() {
        for bound in [1e-4, 1e-8, 1e-12] {
            for (speed, fewest, most) in [(1.0, 1, 1), (10.0, 1, 2), (50.0, 2, 16), (400.0, 16, 32)] {
                let motion = |t: f64| (speed * t).sin();
                let (pieces, _) = covered(motion, (0.3, 1.3), bound);
                assert!((fewest..=most).contains(&pieces.len()), "{speed} {bound}: {}", pieces.len());
                // Relative to the norm, which is at least 1; checks at some points are not all of them.
                assert!(worst(&pieces, motion) < 4.0 * bound, "{speed}: {:e}", worst(&pieces, motion));
                assert!(pieces.windows(2).all(|pair| pair[0].to == pair[1].from));
            }
        }
    }

    /// A kink is closed in, a jump and noise are given up after a few halves.
    #[test]
    fn what_is_no_polynomial() {
        let kink = |t: f64| 0.5 * f64::max(0.0, t - 0.3).powi(2);
        let (pieces, calls) = covered(kink, (0.0, 1.0), 1e-12);
        assert!(worst(&pieces, kink) < 1e-7 && calls < 400, "{:e} {calls}", worst(&pieces, kink));
        let noise = |t: f64| 1e-11 * (t.to_bits() % 1009) as f64 / 1009.0;
        let (pieces, calls) = covered(noise, (0.1, 1.0), 1e-12);
        assert!(worst(&pieces, noise) < 1e-10 && calls < 100, "{:e} {calls}", worst(&pieces, noise));
        let (pieces, calls) = covered(|t| if t < 0.3 { 0.0 } else { 1.0 }, (0.0, 1.0), 1e-12);
        assert!(pieces.len() <= 32 && calls < 2000, "{} {calls}", pieces.len());
        let (pieces, _) = covered(|_| 0.25, (1.0, 1.0_f64.next_up()), 1e-12);
        assert_eq!((pieces.len(), pieces[0].at(1.0)[0]), (1, 0.25));
    }
}
