//! Polynomials that stand for a motion: by its numbers at Chebyshev points, as many as it takes.

use core::f64::consts::PI;

use crate::error::Reason;
use crate::inner::{larger, norm};
use crate::numbers::Numbers;

/// Degrees of polynomials: they are doubled until the next one adds nothing.
const LOWEST_DEGREE: usize = 4;
const HIGHEST_DEGREE: usize = 32;
/// Part of its difference from the motion that a polynomial of the double degree has at least where there is a kink within it, or
/// a motion with more turns than that degree can follow: both are parted.
const HARDLY_NEARER: f64 = 0.125;
/// Parts that are halved so many times and more are those around a kink: a step over more turns is not kept.
const MOST_HALVINGS_OF_ALL: u32 = 12;
/// Around a kink a step is halved so many times.
const MOST_HALVINGS: u32 = 30;
/// Times so many roundings apart are close to each other: third differences of a motion that a polynomial nearly follows are less
/// over them than its rounding.
const CLOSE: f64 = (1 << 15) as f64 * f64::EPSILON;
/// Larger differences are none of rounding.
const LARGEST_ROUNDING: f64 = 1e-3;
/// Rounding makes so many of its third differences of the difference from a polynomial, at the most.
const OF_ROUNDING: f64 = 16.0;
/// Times are known to a few roundings.
const ROUNDINGS: f64 = 4.0;
/// A part of the interval by which a value beside a Chebyshev point does not differ from that there. Reciprocals of smaller ones
/// may be no numbers.
const NEXT_TO_A_POINT: f64 = 1e-150;

/// A polynomial in time, by its values at the Chebyshev points of an interval, ends included.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Polynomial {
    pub(super) from: f64,
    pub(super) to: f64,
    degree: usize,
    /// It stands for the motion between its ends too.
    is_close: bool,
    /// Numbers of a phase point in `N` dimensions, point after point.
    values: Box<[f64]>,
}

impl Polynomial {
    /// One that stands for nothing but its ends.
    pub(super) fn of_ends<const N: usize>(begin: (f64, Numbers), end: (f64, Numbers)) -> Self {
        Self::new::<N>((begin.0, end.0), &[begin.1, end.1], false)
    }

    fn new<const N: usize>((from, to): (f64, f64), values: &[Numbers], is_close: bool) -> Self {
        let width = 2 * N * (N + 1);
        let numbers = values.iter().flat_map(|value| value[..width].iter().copied()).collect();
        Self { from, to, degree: values.len() - 1, is_close, values: numbers }
    }

    /// Its value, by the barycentric formula (J.-P. Berrut, L. N. Trefethen, SIAM Review 46 (2004) 501-517): that of a
    /// Chebyshev point there, bit by bit. `None` where it does not stand for the motion.
    pub(super) fn at(&self, t: f64) -> Option<Numbers> {
        if !self.is_close && t != self.from && t != self.to {
            return None;
        }
        let part = (t - self.from) / (self.to - self.from);
        Some(interpolated(part, self.degree, |k| {
            let width = self.values.len() / (self.degree + 1);
            let mut value = [0.0; 24];
            value[..width].copy_from_slice(&self.values[k * width..(k + 1) * width]);
            value
        }))
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
    at: &'f mut dyn FnMut(f64) -> Result<Numbers, Reason>,
    /// The largest difference from it, relative to the sizes of what it consists of.
    bound: f64,
    /// Polynomials that may still be made.
    left: &'f mut usize,
}

/// Values at the Chebyshev points of an interval, and what the polynomial through them is off the motion.
struct Fitted {
    values: Vec<Numbers>,
    scales: [f64; 4],
    difference: f64,
    /// What it may be: that of the fit, or what the rounding of times makes of the motion.
    bound: f64,
}

impl<'f, const N: usize> Fit<'f, N> {
    pub(super) fn new(
        at: &'f mut dyn FnMut(f64) -> Result<Numbers, Reason>,
        bound: f64,
        left: &'f mut usize,
    ) -> Self {
        Self { at, bound, left }
    }

    /// Polynomials from a time to another, given the numbers at both, handed over in their order. Those that are not close do
    /// not stand for the motion but at their ends: none is within the bound, or there are too many.
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
        let (span, middle) = ((begin.0, end.0), begin.0 + 0.5 * (end.0 - begin.0));
        if *self.left == 0 || halvings > MOST_HALVINGS || middle == begin.0 || middle == end.0 {
            each(Polynomial::of_ends::<N>(begin, end));
            return Ok(());
        }
        let highest = if halvings > MOST_HALVINGS_OF_ALL { LOWEST_DEGREE } else { HIGHEST_DEGREE };
        let fitted = self.fitted(begin, end, highest)?;
        let is_close = fitted.difference <= fitted.bound
            || fitted.difference > 0.5 * before && self.is_rounding(span, &fitted)?;
        if is_close {
            *self.left -= 1;
            each(Polynomial::new::<N>(span, &fitted.values, true));
            return Ok(());
        }
        let middle = (middle, (self.at)(middle)?);
        self.halved(begin, middle, (halvings + 1, fitted.difference), each)?;
        self.halved(middle, end, (halvings + 1, fitted.difference), each)
    }

    /// The first polynomial that the motion agrees with at the points between its own, or the last one that is tried, with what
    /// is known of the largest difference.
    fn fitted(
        &mut self,
        (from, begin): (f64, Numbers),
        (to, end): (f64, Numbers),
        highest: usize,
    ) -> Result<Fitted, Reason> {
        let (mut degree, mut before) = (1, f64::INFINITY);
        let mut values = vec![begin, end];
        loop {
            let scales = scales::<N>(&values);
            // Times that are rounded are those of another point.
            let rounding = ROUNDINGS * f64::EPSILON * larger(from.abs(), to.abs()) / (to - from).abs();
            let bound = larger(self.bound, rounding * steepest::<N>(&values, &scales));
            let enough = larger(bound, HARDLY_NEARER * before);
            let (mut finer, mut difference) = (Vec::with_capacity(2 * degree + 1), 0.0);
            for (k, value) in values[..degree].iter().enumerate() {
                let part = chebyshev(2 * k + 1, 2 * degree);
                let next = (self.at)(from + part * (to - from))?;
                let between = interpolated(part, degree, |k| values[k]);
                difference = larger(difference, apart::<N>(&next, &between, &scales));
                finer.extend([*value, next]);
                if degree >= LOWEST_DEGREE && difference > enough {
                    return Ok(Fitted { values, scales, difference, bound });
                }
            }
            if degree >= LOWEST_DEGREE && (difference <= bound || degree >= highest) {
                return Ok(Fitted { values, scales, difference, bound });
            }
            finer.push(end);
            before = if degree >= LOWEST_DEGREE { difference } else { f64::INFINITY };
            (degree, values) = (2 * degree, finer);
        }
    }

    /// What a polynomial is off the motion by is the rounding of the motion itself.
    fn is_rounding(&mut self, (from, to): (f64, f64), fitted: &Fitted) -> Result<bool, Reason> {
        let close = CLOSE * larger(from.abs(), to.abs()).copysign(to - from);
        if fitted.difference > LARGEST_ROUNDING || 8.0 * close.abs() > (to - from).abs() {
            return Ok(false);
        }
        let mut third = [0.0; 24];
        for (k, weight) in [1.0, -3.0, 3.0, -1.0].into_iter().enumerate() {
            let value = (self.at)(from + 0.375 * (to - from) + k as f64 * close)?;
            third.iter_mut().zip(value).for_each(|(third, value)| *third += weight * value);
        }
        Ok(fitted.difference <= OF_ROUNDING * apart::<N>(&third, &[0.0; 24], &fitted.scales))
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

fn apart<const N: usize>(a: &Numbers, b: &Numbers, scales: &[f64; 4]) -> f64 {
    let mut off = *a;
    off.iter_mut().zip(b).for_each(|(a, b)| *a -= b);
    groups::<N>().into_iter().zip(scales).fold(0.0, |most, (group, scale)| match sized(&off, group) {
        0.0 => most,
        off => larger(most, off / scale),
    })
}

/// The largest difference between neighbours among values at the Chebyshev points of an interval, over the part of it that is between
/// them.
fn steepest<const N: usize>(values: &[Numbers], scales: &[f64; 4]) -> f64 {
    let degree = values.len() - 1;
    values.windows(2).enumerate().fold(0.0, |most, (k, pair)| {
        let between = chebyshev(k + 1, degree) - chebyshev(k, degree);
        larger(most, apart::<N>(&pair[0], &pair[1], scales) / between)
    })
}

/// What differences are measured against, group by group; a position may be zero, and is held against the placement too.
fn scales<const N: usize>(values: &[Numbers]) -> [f64; 4] {
    let [phi, spin, x, p] =
        groups::<N>().map(|group| values.iter().fold(0.0, |most, value| larger(most, sized(value, group))));
    [phi, spin, phi + x, p]
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
        Fit::<2>::new(&mut at, bound, &mut 4096)
            .cover(ends[0], ends[1], &mut |piece| pieces.push(piece))
            .unwrap();
        (pieces, calls)
    }

    fn worst(pieces: &[Polynomial], motion: impl Fn(f64) -> f64) -> f64 {
        pieces.iter().fold(0.0, |worst, piece| {
            let off = |k: u32| {
                let t = piece.from + (piece.to - piece.from) * f64::from(k) / 97.0;
                piece.at(t).map(|value| (value[0] - motion(t)).abs())
            };
            (0..=97).filter_map(off).fold(worst, f64::max)
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
            assert_eq!(pieces[0].at(to).unwrap()[0], motion(to - from), "the ends are kept");
            assert_eq!(pieces[0].values.len(), 5 * 12, "numbers of two dimensions");
        }
        let (pieces, _) = covered(motion, (0.0, 1.0), 1e-13);
        assert_eq!(pieces[0].at(5e-324).unwrap()[0], 1.0, "beside an end");
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
        assert_eq!((pieces.len(), pieces[0].at(1.0).unwrap()[0]), (1, 0.25));
    }
}
