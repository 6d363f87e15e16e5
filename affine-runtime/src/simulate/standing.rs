//! On which side of zero the function of an event stands, from one sample to the next.

use super::accumulation::Changes;
use crate::inner::Tape;

/// A side of zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) enum Side {
    Negative,
    Positive,
}

impl Side {
    /// Where a value lies; `None` for zero and for what is no number.
    #[inline]
    pub(super) fn of(value: f64) -> Option<Self> {
        match value {
            _ if value < 0.0 => Some(Self::Negative),
            _ if value > 0.0 => Some(Self::Positive),
            _ => None,
        }
    }

    pub(super) fn opposite(self) -> Self {
        match self {
            Self::Negative => Self::Positive,
            Self::Positive => Self::Negative,
        }
    }
}

/// Where the function of an event stands at a sample, as far as changes of its sign go.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) enum Standing {
    /// On a side of zero.
    On(Side),
    /// At zero, or no number: to whichever side it goes, that is no change of its sign.
    Open,
    /// At zero, coming from a side: its sign changes if it leaves for the other one.
    Leaving {
        from: Side,
        /// Its own change has left it there.
        left: Option<Left>,
    },
}

/// How the change of its own event has left a function at zero. Bits, so that every number has a text.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Left {
    t: u64,
    value: u64,
    rate: u64,
}

impl Left {
    /// At a time with a value, where it came at a rate.
    pub(super) fn at((t, value): (f64, f64), rate: f64) -> Self {
        Self { t: t.to_bits(), value: value.to_bits(), rate: rate.to_bits() }
    }

    /// The time and the value.
    pub(super) fn place(self) -> (f64, f64) {
        (f64::from_bits(self.t), f64::from_bits(self.value))
    }

    /// The rate at which it came.
    pub(super) fn rate(self) -> f64 {
        f64::from_bits(self.rate)
    }

    /// Hands over, or takes back, what is known.
    pub(super) fn exchange(&mut self, tape: &mut impl Tape) {
        let Self { t, value, rate } = self;
        [t, value, rate].into_iter().for_each(|bits| tape.bits(bits));
    }
}

impl Standing {
    /// At a sample where nothing but the value is known.
    #[inline]
    pub(super) fn of(value: f64) -> Self {
        Side::of(value).map_or(Self::Open, Self::On)
    }

    /// The side on which it is, or from which it comes.
    pub(super) fn side(self) -> Option<Side> {
        match self {
            Self::On(side) | Self::Leaving { from: side, .. } => Some(side),
            Self::Open => None,
        }
    }
}

/// What is remembered of an event.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Memory {
    pub(super) standing: Standing,
    pub(super) changes: Changes,
}
