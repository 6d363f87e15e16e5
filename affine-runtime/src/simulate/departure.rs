//! To which side a function goes that begins at zero.

use super::conservation::larger;
use super::standing::Side;

/// Where it is looked at first: a part of the interval, and some roundings of time.
const NEAREST: f64 = 1.0 / ((1_u64 << 40) as f64);
const ROUNDINGS: f64 = 64.0;
/// Changes count from so many times the rounding of the function on.
const ABOVE_ROUNDING: f64 = 16.0;
/// Changes count from so many times the least of them on: those of a few quanta have no rate.
const QUANTA: f64 = 8.0;
/// `f(t) - f(t0) ~ (t - t0)^p` with `p` below this is linear.
const LINEAR: f64 = 1.5;

/// A function that has left.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Departure {
    /// The side to which it goes.
    pub(super) side: Side,
    /// A time just after, at which it is on that side.
    pub(super) t: f64,
    /// Its value there.
    pub(super) value: f64,
    /// The size of its rate at the beginning; `None` where that vanishes.
    pub(super) rate: Option<f64>,
}

/// Where `f`, whose value `f0` at `t0` is zero up to rounding, goes from there on the way to `end`; `None` where it stays at
/// zero.
///
/// What is looked at is `f(t) - f0`, at times that double their distance from `t0`: the first change that rounding does not
/// explain, and the next one agrees with, tells the side, and both of them whether it grows like `t - t0` or like a higher
/// power. A function that turns back before it is beyond `f0` goes to the other side, with a rate that vanishes.
///
/// # Errors
/// Those of `f`.
pub(super) fn departure<E>(
    mut f: impl FnMut(f64) -> Result<f64, E>,
    (t0, f0): (f64, f64),
    end: f64,
) -> Result<Option<Departure>, E> {
    let span = end - t0;
    let nearest = larger(NEAREST * span.abs(), ROUNDINGS * f64::EPSILON * larger(t0.abs(), end.abs()));
    if nearest >= span.abs() {
        return Ok(None);
    }
    let mut s = nearest.copysign(span);
    let rounding = ABOVE_ROUNDING * roughness(&mut f, t0, s)?;
    // The least change, the one before if it counts, and what they tell.
    let (mut least, mut before, mut going): (f64, Option<(f64, f64)>, _) = (0.0, None, None);
    // The side of all changes, if there is one.
    let mut always = None;
    loop {
        let t = if s == span { end } else { t0 + s };
        let value = f(t)?;
        let change = value - f0;
        let side = Side::of(change);
        if least == 0.0 {
            (least, always) = (change.abs(), side);
        }
        always = always.filter(|always| Some(*always) == side);
        going = match going {
            Some((toward, _)) if side == Some(Side::opposite(toward)) => Some((toward.opposite(), None)),
            None => before.filter(|(_, before)| grows(*before, change)).and_then(|(from, before)| {
                let is_linear = change.abs() < before.abs() * (s / from).powf(LINEAR);
                Some((side?, is_linear.then(|| (before / from).abs())))
            }),
            known => known,
        };
        if let Some((side, rate)) = going
            && Side::of(value) == Some(side)
        {
            return Ok(Some(Departure { side, t, value, rate }));
        }
        if s == span {
            // A function that jumps away is at once where it stays.
            let jumped = always.filter(|side| Side::of(value) == Some(*side));
            return Ok(jumped.map(|side| Departure { side, t, value, rate: Some(f64::INFINITY) }));
        }
        before = (change.abs() >= larger(rounding, QUANTA * least))
            .then_some((s, change))
            .filter(|_| change != 0.0);
        s = if 2.0 * s.abs() < span.abs() { 2.0 * s } else { span };
    }
}

/// A change goes on to the same side.
fn grows(before: f64, change: f64) -> bool {
    Side::of(before) == Side::of(change) && change.abs() >= before.abs()
}

/// Largest difference between neighbours of four values close together: the rounding of the function, unless its motion is
/// larger.
fn roughness<E>(f: &mut impl FnMut(f64) -> Result<f64, E>, t0: f64, s: f64) -> Result<f64, E> {
    let mut values = [0.0; 4];
    for (value, part) in values.iter_mut().zip([0.25, 0.5, 0.75, 1.0]) {
        *value = f(t0 + part * s)?;
    }
    Ok(values.windows(2).fold(0.0, |most, pair| larger(most, (pair[1] - pair[0]).abs())))
}
