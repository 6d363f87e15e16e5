//! To which side a function goes that begins at zero.

use super::standing::Side;
use crate::inner::larger;

/// Where it is looked at first: a part of the interval, and some roundings of time.
const NEAREST: f64 = 1.0 / ((1_u64 << 40) as f64);
const ROUNDINGS: f64 = 64.0;
/// Changes count from so many times the rounding of the function on.
const ABOVE_ROUNDING: f64 = 16.0;
/// Changes count from so many times the least of them on: those of a few quanta have no rate.
const QUANTA: f64 = 8.0;
/// The last distance is at most so many times the one before, and at least half as many times: what is closer tells no power.
const LAST: f64 = 3.0;
/// `f(t) - f(t0) ~ (t - t0)^p` with `p` below this is linear.
const LINEAR: f64 = 1.5;

/// A function that has left.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Departure {
    /// The side to which it goes.
    pub(super) side: Side,
    /// A time just after, at which it is on that side.
    pub(super) t: f64,
    /// The value of the function at that time.
    pub(super) value: f64,
    /// The size of its rate at the beginning; `None` where that vanishes, or is not to be told.
    pub(super) rate: Option<f64>,
}

/// Where `f`, whose value `f0` at `t0` is zero up to rounding, goes on the way from a time, at which it is still there, to
/// another; `None` where it stays at zero.
///
/// What is looked at is `f(t) - f0`, at times that double their distance from where the way begins: the first change that
/// rounding does not explain, and the next one agrees with, tells the side, and both of them whether it grows like `t - t0` or
/// like a higher power. A function that turns back before it is beyond `f0` goes to the other side, with a rate that vanishes.
///
/// # Errors
/// Those of `f`.
pub(super) fn departure<E>(
    mut f: impl FnMut(f64) -> Result<f64, E>,
    (t0, f0): (f64, f64),
    (from, end): (f64, f64),
) -> Result<Option<Departure>, E> {
    let (span, passed) = (end - from, from - t0);
    let nearest = larger(NEAREST * span.abs(), ROUNDINGS * f64::EPSILON * larger(from.abs(), end.abs()));
    if nearest >= span.abs() {
        return Ok(None);
    }
    let mut s = nearest.copysign(span);
    let rounding = ABOVE_ROUNDING * roughness(&mut f, from, s)?;
    // The least change, the one before if it counts, and what they tell.
    let (mut least, mut before, mut going): (f64, Option<(f64, f64)>, _) = (0.0, None, None);
    // The side of all changes, if there is one.
    let mut always = None;
    loop {
        let (t, since) = (if s == span { end } else { from + s }, passed + s);
        let value = f(t)?;
        let change = value - f0;
        let side = Side::of(change);
        if least == 0.0 {
            (least, always) = (change.abs(), side);
        }
        always = always.filter(|always| Some(*always) == side);
        going = match going {
            Some((toward, _)) if side == Some(Side::opposite(toward)) => Some((toward.opposite(), None)),
            None => before.filter(|(_, before)| Side::of(*before) == side).and_then(|(earlier, before)| {
                let is_linear = change.abs() < before.abs() * libm::pow(since / earlier, LINEAR);
                Some((side?, is_linear.then(|| (before / earlier).abs())))
            }),
            known => known,
        };
        if let Some((side, rate)) = going
            && Side::of(value) == Some(side)
        {
            return Ok(Some(Departure { side, t, value, rate }));
        }
        if s == span {
            // A function that jumps away is at once where it stays; one that has gone a few roundings looks like it.
            let jumped = always.filter(|side| Side::of(value) == Some(*side));
            return Ok(jumped.map(|side| Departure { side, t, value, rate: None }));
        }
        before = (change.abs() >= larger(rounding, QUANTA * least))
            .then_some((since, change))
            .filter(|_| change != 0.0);
        s = if LAST * s.abs() < span.abs() { 2.0 * s } else { span };
    }
}

/// Largest difference between neighbours of four values close together: the rounding of the function, unless its motion is
/// larger.
fn roughness<E>(f: &mut impl FnMut(f64) -> Result<f64, E>, from: f64, s: f64) -> Result<f64, E> {
    let mut values = [0.0; 4];
    for (value, part) in values.iter_mut().zip([0.25, 0.5, 0.75, 1.0]) {
        *value = f(from + part * s)?;
    }
    Ok(values.windows(2).fold(0.0, |most, pair| larger(most, (pair[1] - pair[0]).abs())))
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use core::convert::Infallible;

    use super::{Departure, departure};
    use crate::simulate::standing::Side::{self, Negative, Positive};

    /// From `f(t0)`, with the number of values that it took.
    fn leaving(f: impl Fn(f64) -> f64, t0: f64, end: f64) -> (Option<Departure>, u32) {
        let mut calls = 0;
        let counted = |t: f64| {
            calls += 1;
            assert!((t - t0) * (end - t) >= 0.0 && t != t0, "{t} is not on the way from {t0} to {end}");
            Ok::<f64, Infallible>(f(t))
        };
        let left = departure(counted, (t0, f(t0)), (t0, end));
        (left.unwrap_or_else(|never| match never {}), calls)
    }

    const ENDS: [(f64, f64); 6] =
        [(0.0, 1.0), (0.0, -1e-3), (0.7, 1.0), (-3.0, -4.5), (1e3, 1.5e3), (1e6, 1e6 + 1.0)];

    #[test]
    fn linear_departures_have_their_rate() {
        for (t0, end) in ENDS {
            for rate in [1.0, -1.0, 1e-8, -1e8] {
                let (left, calls) = leaving(|t| rate * (t - t0) * (1.0 + (t - t0)), t0, end);
                let left = left.unwrap();
                let side = if rate * (end - t0) > 0.0 { Positive } else { Negative };
                assert_eq!((left.side, Side::of(left.value)), (side, Some(side)), "{t0} {end} {rate}");
                assert!((left.rate.unwrap() / f64::abs(rate) - 1.0).abs() < 1e-3, "{left:?}");
                assert!(
                    (left.t - t0) * (end - left.t) > 0.0 && (left.t - t0).abs() < 1e-9 * t0.abs().max(1.0)
                );
                assert!(calls < 16, "{calls}");
            }
        }
    }

    #[test]
    fn higher_powers_have_none() {
        for (t0, end) in ENDS {
            for power in [2, 3, 4] {
                for sign in [1.0, -1.0] {
                    let (left, calls) = leaving(|t| sign * (t - t0).powi(power), t0, end);
                    let left = left.unwrap();
                    assert_eq!(left.rate, None, "{t0} {end} {power}");
                    assert_eq!(Some(left.side), Side::of(sign * (end - t0).powi(power)));
                    assert!(calls < 60, "{calls}");
                }
            }
        }
    }

    /// Up at a rate and down again, from just below: found as long as it comes above zero.
    #[test]
    fn flights_that_come_back() {
        for (t0, end) in [(0.0, 1.0), (0.45, 3.0), (0.0, -1.0)] {
            let sign = f64::signum(end - t0);
            for rate in [1.0, 1e-3, 1e-6, 1e-9] {
                let flight = |residual: f64| {
                    move |t: f64| residual + rate * sign * (t - t0) - 5.0 * (t - t0) * (t - t0)
                };
                for residual in [0.0, 1e-3 * rate * rate, -1e-3 * rate * rate] {
                    let left = leaving(flight(residual), t0, end).0.unwrap();
                    assert_eq!(left.side, Positive, "{t0} {rate} {residual}");
                    assert!(left.value > 0.0 && sign * (left.t - t0) < 0.2 * rate, "{left:?}");
                }
                // A peak of rate^2/20 that does not reach zero.
                let left = leaving(flight(-0.1 * rate * rate), t0, end).0.unwrap();
                assert_eq!((left.side, left.rate), (Negative, None), "{t0} {rate}");
            }
        }
    }

    /// Looked at from a later time on, at which the function is still at zero up to rounding.
    #[test]
    fn rates_are_those_since_the_beginning() {
        let quantum = 1e-10;
        for (t0, sign) in [(0.0, 1.0), (0.7, -1.0), (1e3, 1.0)] {
            let leaving = |rate: f64, passed: f64, ahead: f64| {
                let rounded = |t: f64| {
                    let since = sign * (t - t0);
                    Ok::<f64, Infallible>(((rate * since - 5.0 * since * since) / quantum).round() * quantum)
                };
                let way = (t0 + sign * passed, t0 + sign * (passed + ahead));
                let left = departure(rounded, (t0, 0.0), way);
                left.unwrap_or_else(|never| match never {}).unwrap()
            };
            for ahead in [1e-5, 1e-4, 1.0] {
                for (rate, passed) in [(0.0, 1e-6), (0.0, 3e-6), (1e-6, 1e-6), (5e-6, 3e-6)] {
                    let left = leaving(rate, passed, ahead);
                    assert_eq!((left.side, left.rate), (Negative, None), "{t0} {passed} {ahead} {rate}");
                }
                let left = leaving(-1e-3, 1e-7, ahead);
                assert!(left.side == Negative && (left.rate.unwrap() / 1e-3 - 1.0).abs() < 0.2, "{left:?}");
            }
        }
    }

    /// Values that are rounded to a quantum have no rate in its range.
    #[test]
    fn rounding_is_no_motion() {
        let quantum = 1e-10;
        let rounded = |value: f64| (value / quantum).round() * quantum;
        let left = leaving(|t| rounded(-5.0 * t * t), 0.0, 1.0).0.unwrap();
        assert_eq!((left.side, left.rate), (Negative, None));
        let left = leaving(|t| rounded(1e-3 * t - 5.0 * t * t), 0.0, 1.0).0.unwrap();
        assert_eq!(left.side, Positive, "up to 5e-8");
        let left = leaving(|t| rounded(1e-5 * t - 5.0 * t * t), 0.0, 1.0).0.unwrap();
        assert_eq!((left.side, left.rate), (Negative, None), "up to 5e-12");
        let left = leaving(|t| rounded(-t), 0.0, 1.0).0.unwrap();
        assert!(left.side == Negative && (left.rate.unwrap() - 1.0).abs() < 0.2, "{left:?}");
        // Noise of a function that stays, and of one that goes.
        let noise = |t: f64| 1e-15 * (f64::from((t.to_bits() % 1009) as u32) / 504.5 - 1.0);
        for end in [1.0, -0.3, 1e-3] {
            assert_eq!(leaving(|t| if t == 0.0 { 0.0 } else { noise(t) }, 0.0, end).0, None, "{end}");
            let left = leaving(|t| noise(t) - 5.0 * t * t, 0.0, end).0.unwrap();
            assert_eq!((left.side, left.rate), (Negative, None), "{end}");
        }
        assert_eq!(leaving(|_| 0.0, 0.3, 1.0).0, None);
        assert_eq!(leaving(|_| -1e-17, 0.3, 1.0).0, None);
    }

    #[test]
    fn jumps_and_what_is_no_number() {
        for value in [-1.0, f64::NEG_INFINITY, 1e-300] {
            let left = leaving(|t| if t == 0.0 { 0.0 } else { value }, 0.0, 1.0).0.unwrap();
            assert_eq!((Some(left.side), left.rate), (Side::of(value), None), "{value}");
        }
        // Where the function has begun to go is not asked.
        let late = leaving(|t| if t < 0.9 { 0.0 } else { -1.0 }, 0.0, 1.0).0.unwrap();
        assert_eq!(late.side, Negative);
        assert_eq!(leaving(|t| if t == 0.0 { 0.0 } else { f64::NAN }, 0.0, 1.0).0, None);
        // No times in between.
        assert_eq!(leaving(|t| t - 1.0, 1.0, 1.0 + 8.0 * f64::EPSILON).0, None);
        assert_eq!(leaving(|t| t - 1.0, 1.0, 1.0).0, None);
    }
}
