//! Numbers summed up in one, which is another where one of them is.

use crate::inner::Tape;

/// After the hash of Fowler, Noll and Vo (FNV-1a), by words in place of bytes, and turned, so that high bits of a number
/// reach all bits of the sum. The hashes of the standard library may differ from version to version.
pub(super) struct Digest(pub(super) u64);

impl Digest {
    pub(super) fn new() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }

    pub(super) fn word(&mut self, word: u64) {
        self.0 = (self.0 ^ word).wrapping_mul(0x0100_0000_01b3).rotate_left(23);
    }

    /// All that are not a number are one.
    pub(super) fn number(&mut self, number: f64) {
        self.word(if number.is_nan() { u64::MAX } else { number.to_bits() });
    }
}

impl Tape for Digest {
    fn bits(&mut self, bits: &mut u64) {
        self.word(*bits);
    }
}
