//! Which bodies of an ensemble are run.

use core::ops::Range;

use crate::error::Setting;

/// A choice of bodies by their numbers. Of several choices, bodies that are in all of them are run.
#[derive(Debug)]
pub(super) enum Chosen {
    /// Every `of`th, from number `k` on.
    Shard { k: u64, of: u64 },
    /// These.
    Numbers(Range<u64>),
}

impl Chosen {
    pub(super) fn checked(&self) -> Result<(), Setting> {
        match *self {
            Self::Shard { k, of } if k >= of => Err(Setting::Shard { k, of }),
            _ => Ok(()),
        }
    }

    pub(super) fn has(&self, number: u64) -> bool {
        match self {
            Self::Shard { k, of } => number.checked_rem(*of) == Some(*k),
            Self::Numbers(numbers) => numbers.contains(&number),
        }
    }

    /// How many it leaves of so many bodies, about.
    #[cfg(feature = "progress")]
    pub(super) fn left(&self, count: u64) -> u64 {
        match self {
            Self::Shard { of, .. } => count.checked_div(*of).unwrap_or(0),
            Self::Numbers(numbers) => count.min(numbers.end).saturating_sub(numbers.start),
        }
    }
}
