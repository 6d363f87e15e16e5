//! Changes of the point that accumulate at a time.

use crate::inner::Tape;

/// Part of the time that a sequence of changes has taken which may be left of it where it is taken to accumulate: bounces of
/// that part are as high as a rounding of where the sequence began.
const LEFT: f64 = 1.0 / ((1 << 24) as f64);
/// Quotients of intervals one after the other that have to agree.
const IN_STEP: u32 = 3;
/// Quotients agree that differ by less than this factor.
const AGREEMENT: f64 = 4.0;
/// Times are one that differ by so many roundings.
const ROUNDINGS: f64 = 4.0;
/// Changes at one time that are no coincidence of events any more.
const AT_ONE_TIME: u32 = 64;

/// How often an event has changed the point, and when.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Changes {
    pub(super) count: u64,
    /// The last of them that were at one time.
    at_one_time: u32,
    /// Quotients of the last intervals that agree.
    in_step: u32,
    /// Bits of the time since when intervals shrink, of the last time, the last interval, and its quotient by the one
    /// before.
    past: [u64; 4],
}

impl Default for Changes {
    fn default() -> Self {
        Self { count: 0, at_one_time: 0, in_step: 0, past: [f64::NAN.to_bits(); 4] }
    }
}

impl Changes {
    /// Hands over, or takes back, what is known.
    pub(super) fn exchange(&mut self, tape: &mut impl Tape) {
        let Self { count, at_one_time, in_step, past } = self;
        tape.bits(count);
        for number in [at_one_time, in_step] {
            let mut bits = u64::from(*number);
            tape.bits(&mut bits);
            *number = bits as u32;
        }
        past.iter_mut().for_each(|bits| tape.bits(bits));
    }

    /// The event changes the point once more, where its function comes to zero or jumps over it; the time at which it
    /// accumulates, if it does.
    ///
    /// ```text
    /// t_k - t_(k-1) = d_k,   r = d_k/d_(k-1) < 1   =>   t_k -> t_k + d_k r/(1 - r)
    /// ```
    pub(super) fn happen(&mut self, t: f64, at_zero: bool) -> Option<f64> {
        let count = self.count + 1;
        if !at_zero {
            *self = Self { count, ..Self::default() };
            return None;
        }
        let [since, last, before, quotient] = self.past.map(f64::from_bits);
        let interval = (t - last).abs();
        let now = interval / before;
        let shrinks = now < 1.0;
        let agrees = now <= AGREEMENT * quotient && quotient <= AGREEMENT * now;
        let since = if shrinks { since } else { last };
        let in_step = match (shrinks, agrees) {
            (true, true) => self.in_step + 1,
            (true, false) => 1,
            (false, _) => 0,
        };
        let is_again = interval <= ROUNDINGS * f64::EPSILON * t.abs();
        let at_one_time = if is_again { self.at_one_time + 1 } else { 0 };
        *self = Self { count, at_one_time, in_step, past: [since, t, interval, now].map(f64::to_bits) };
        let left = interval * now / (1.0 - now);
        if at_one_time >= AT_ONE_TIME {
            Some(t)
        } else if in_step >= IN_STEP && left <= LEFT * (t - since).abs() {
            Some(t + left.copysign(t - last))
        } else {
            None
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    /// The time at which a sequence is taken to accumulate, and after how many.
    fn accumulated(times: impl IntoIterator<Item = f64>) -> Option<(f64, u64)> {
        let mut changes = Changes::default();
        times.into_iter().find_map(|t| changes.happen(t, true).map(|limit| (limit, changes.count)))
    }

    /// A ball that keeps a part of its velocity.
    fn bounces(t0: f64, first: f64, part: f64) -> impl Iterator<Item = f64> {
        (0..20_000).map(move |k| t0 + first * (1.0 - part.powi(k)) / (1.0 - part))
    }

    #[test]
    fn intervals_in_a_geometric_sequence() {
        for part in [0.001, 0.01, 0.1, 0.5, 0.9, 0.99] {
            for (t0, first) in [(0.0, 1.0), (3.0, 0.2), (-2.0, -1e-3), (5.0, -0.2)] {
                let exact = t0 + first / (1.0 - part);
                let (limit, count) = accumulated(bounces(t0, first, part)).unwrap();
                assert!((limit - exact).abs() < 1e-9 * (exact - t0).abs(), "{part} {first}: {limit} {exact}");
                assert!(count > 4 && count < 3000, "{part}: {count}");
            }
        }
    }

    #[test]
    fn what_goes_on_does_not_accumulate() {
        // Equal intervals, growing ones, and some that shrink without a limit, or to one that is far away.
        assert_eq!(accumulated((0..10_000).map(|k| 0.1 * f64::from(k))), None);
        assert_eq!(accumulated((0..300).map(|k| 1.1_f64.powi(k))), None);
        assert_eq!(accumulated((1..10_000).map(|k| f64::from(k).sqrt())), None);
        assert_eq!(accumulated((1..10_000).map(|k| f64::from(k).ln())), None);
        // Twice nearly at one time, and on.
        let pairs = (0..1000).flat_map(|k| [f64::from(k), f64::from(k) + 1e-12]);
        assert_eq!(accumulated(pairs), None);
        let close = [0.0, 1.0, 1.8, 2.4, 2.4 + 1e-10, 3.0, 4.0];
        assert_eq!(accumulated(close), None);
    }

    /// Three quotients of about one size, whatever was before.
    #[test]
    fn quotients_agree_before_it_is_told() {
        let times = |intervals: &[f64]| -> Vec<f64> {
            let mut t = 0.0;
            let later = |d: &f64| {
                t += d;
                t
            };
            intervals.iter().map(later).collect()
        };
        let count = |intervals: &[f64]| accumulated(times(intervals)).map(|(_, count)| count);
        // One of 4e-9 between quotients of 1/2.
        assert_eq!(count(&[0.0, 1.0, 0.5, 0.25, 1e-9, 5e-10, 2.5e-10]), None);
        assert_eq!(count(&[0.0, 1.0, 0.5, 0.25, 1e-9, 5e-10, 2.5e-10, 1.25e-10]), Some(8));
        // Of the equal intervals before the last one alone is a part of the sequence, which 2^-24 of the double of it ends.
        let mut long = vec![1.0; 100];
        long.extend((1..40).map(|k| 0.5_f64.powi(k)));
        assert_eq!(count(&long), Some(100 + 24));
    }

    /// Each time the function jumps over zero the sequence begins anew.
    #[test]
    fn jumps_do_not_accumulate() {
        let mut changes = Changes::default();
        assert!(bounces(0.0, 1.0, 0.5).take(100).all(|t| changes.happen(t, false).is_none()));
        assert_eq!(changes.count, 100);
        let mut changes = Changes::default();
        let one_jump = |(k, t): (usize, f64)| changes.happen(t, k != 20).is_some();
        assert_eq!(bounces(0.0, 1.0, 0.5).enumerate().position(one_jump), Some(46));
    }

    #[test]
    fn at_one_time_without_end() {
        assert_eq!(accumulated(core::iter::repeat_n(0.7, 64)), None);
        assert_eq!(accumulated(core::iter::repeat_n(0.7, 65)), Some((0.7, 65)));
        assert_eq!(accumulated(core::iter::repeat(0.0)), Some((0.0, 65)));
        // Times that differ by two roundings.
        let close = |k: u32| 1000.0 + f64::from(k) * 2.0 * f64::EPSILON * 512.0;
        assert_eq!(accumulated((0..100).map(close)), Some((close(64), 65)));
    }
}
