//! Checkpoints as a line of a manifest: their numbers, one after the other.

use super::{Bits, Checkpoint, Place};
use crate::error::Setting;
use crate::inner::Tape;
use crate::integrate::FusedArithmetic;
use crate::simulate::accumulation::Changes;
use crate::simulate::standing::{Memory, Side, Standing};

/// More numbers than any state has: a length above is none.
const MOST: u64 = 1 << 16;
const ARITHMETIC: [FusedArithmetic; 3] =
    [FusedArithmetic::Nowhere, FusedArithmetic::InVectors, FusedArithmetic::Everywhere];
const SIDES: [Side; 2] = [Side::Negative, Side::Positive];

impl Checkpoint {
    /// `state` and its numbers, in hexadecimal digits.
    pub(in crate::simulate) fn line(&self) -> String {
        let mut tape = Bits::Written(Vec::new());
        self.clone().exchange(&mut tape);
        let Bits::Written(numbers) = tape else { return String::new() };
        numbers.iter().fold("state".to_owned(), |line, number| format!("{line} {number:x}"))
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
        let mut checkpoint = Self { run, fused: FusedArithmetic::Nowhere, place: Place::default() };
        checkpoint.exchange(&mut Bits::Read(numbers.iter()));
        // What is written of it is what was read.
        if checkpoint.line() == line { Ok(checkpoint) } else { Err(Setting::Checkpoint { model }) }
    }

    fn exchange(&mut self, tape: &mut Bits<'_>) {
        chosen(&mut self.fused, &ARITHMETIC, tape);
        let Place { from, events, cost, work, energy, integrator, outputs, met, recorded } = &mut self.place;
        listed(from, 0, tape, |bits, tape| tape.bits(bits));
        let begun = Memory { standing: Standing::Open, changes: Changes::default() };
        listed(events, begun, tape, remembered);
        cost.iter_mut().chain([work, energy]).for_each(|bits| tape.bits(bits));
        listed(integrator, 0, tape, |bits, tape| tape.bits(bits));
        tape.bits(outputs);
        let mut count = *met as u64;
        tape.bits(&mut count);
        *met = count as usize;
        tape.flag(recorded);
    }
}

/// A list, after its length.
fn listed<T: Clone>(list: &mut Vec<T>, begun: T, tape: &mut Bits<'_>, each: impl Fn(&mut T, &mut Bits<'_>)) {
    let mut len = list.len() as u64;
    tape.bits(&mut len);
    list.resize(len.min(MOST) as usize, begun);
    list.iter_mut().for_each(|entry| each(entry, tape));
}

/// One of some values, by its place.
fn chosen<T: Copy + PartialEq>(value: &mut T, of: &[T], tape: &mut Bits<'_>) {
    let mut place = of.iter().position(|own| own == value).unwrap_or_default() as u64;
    tape.bits(&mut place);
    *value = of.get(place as usize).copied().unwrap_or(*value);
}

/// What is remembered of an event: where it stands, by the kind of that, a side and a rate.
fn remembered(memory: &mut Memory, tape: &mut Bits<'_>) {
    let (mut kind, mut side, mut rate) = match memory.standing {
        Standing::Open => (0, Side::Negative, 0),
        Standing::On(side) => (1, side, 0),
        Standing::Leaving { from, changed: None } => (2, from, 0),
        Standing::Leaving { from, changed: Some(rate) } => (3, from, rate),
    };
    tape.bits(&mut kind);
    chosen(&mut side, &SIDES, tape);
    tape.bits(&mut rate);
    memory.standing = match kind {
        1 => Standing::On(side),
        2 => Standing::Leaving { from: side, changed: None },
        3 => Standing::Leaving { from: side, changed: Some(rate) },
        _ => Standing::Open,
    };
    memory.changes.exchange(tape);
}
