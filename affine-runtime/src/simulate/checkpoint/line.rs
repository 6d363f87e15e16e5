//! Checkpoints as a line of a manifest: their numbers, one after the other.

use core::iter;

use super::numbers::chosen;
use super::{Bits, Checkpoint, Place};
use crate::error::Setting;
use crate::inner::Tape;
use crate::integrate::FusedArithmetic;

const ARITHMETIC: [FusedArithmetic; 3] =
    [FusedArithmetic::Nowhere, FusedArithmetic::InVectors, FusedArithmetic::Everywhere];

impl Checkpoint {
    /// `state` and its numbers, in hexadecimal digits.
    pub(in crate::simulate) fn line(&self) -> String {
        let mut tape = Bits::Written(Vec::new());
        self.clone().exchange(&mut tape);
        let Bits::Written(numbers) = tape else { return String::new() };
        let words = numbers.iter().map(|number| format!(" {number:x}"));
        iter::once("state".to_owned()).chain(words).collect()
    }

    /// The checkpoint of a run from such a line.
    ///
    /// # Errors
    /// [`Setting::Checkpoint`] where that is none.
    pub(in crate::simulate) fn of_line(
        run: String,
        line: &str,
        model: &'static str,
    ) -> Result<Self, Setting> {
        let words = line.split(' ').skip(1).map(|word| u64::from_str_radix(word, 16));
        let numbers: Vec<u64> = words.collect::<Result<_, _>>().map_err(|_| Setting::Checkpoint { model })?;
        let mut checkpoint =
            Self { run, fused: FusedArithmetic::Nowhere, place: Place::default(), digest: 0 };
        checkpoint.exchange(&mut Bits::Read(numbers.iter()));
        // What is written of it is what was read.
        if checkpoint.line() == line { Ok(checkpoint) } else { Err(Setting::Checkpoint { model }) }
    }

    fn exchange(&mut self, tape: &mut Bits<'_>) {
        chosen(&mut self.fused, &ARITHMETIC, tape);
        self.place.exchange(tape);
        tape.bits(&mut self.digest);
    }
}
