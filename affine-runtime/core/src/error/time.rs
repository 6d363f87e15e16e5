//! How messages write times: those of a run may be of any size, and 300 digits are not read.

use core::fmt;

/// Times of these sizes are written in digits.
const IN_DIGITS: core::ops::Range<f64> = 1e-5..1e16;

/// A time as it is read in a message: with an exponent where its digits would be many.
pub struct Time(pub f64);

impl fmt::Display for Time {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(t) = *self;
        if t == 0.0 || IN_DIGITS.contains(&t.abs()) { write!(f, "{t}") } else { write!(f, "{t:e}") }
    }
}
