//! What a checkpoint holds as numbers, one after the other: handed over, taken back, or summed up.

use super::Place;
use crate::inner::Tape;
use crate::simulate::accumulation::Changes;
use crate::simulate::digest::Digest;
use crate::simulate::standing::{Left, Memory, Side, Standing};

/// More numbers than any state has: a length above is none.
const MOST: u64 = 1 << 16;
const SIDES: [Side; 2] = [Side::Negative, Side::Positive];

impl Place {
    pub(super) fn exchange(&mut self, tape: &mut impl Tape) {
        let Self { from, events, cost, work, energy, integrator, outputs, met, recorded, moved, stiff_since } =
            self;
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
        tape.flag(moved);
        tape.bits(stiff_since);
    }

    /// A number by which it is known that none of it was changed.
    pub(super) fn digest(&self) -> u64 {
        let mut digest = Digest::new();
        self.clone().exchange(&mut digest);
        digest.0
    }
}

/// A list, after its length.
fn listed<T: Clone, K: Tape>(list: &mut Vec<T>, begun: T, tape: &mut K, each: impl Fn(&mut T, &mut K)) {
    let mut len = list.len() as u64;
    tape.bits(&mut len);
    list.resize(len.min(MOST) as usize, begun);
    list.iter_mut().for_each(|entry| each(entry, tape));
}

/// One of some values, by its place.
pub(super) fn chosen<T: Copy + PartialEq>(value: &mut T, of: &[T], tape: &mut impl Tape) {
    let mut place = of.iter().position(|own| own == value).unwrap_or_default() as u64;
    tape.bits(&mut place);
    *value = of.get(place as usize).copied().unwrap_or(*value);
}

/// What is remembered of an event: where it stands, by the kind of that, a side and how it was left, and its changes.
fn remembered<K: Tape>(memory: &mut Memory, tape: &mut K) {
    let (mut kind, mut side, mut left) = match memory.standing {
        Standing::Open => (0, Side::Negative, Left::default()),
        Standing::On(side) => (1, side, Left::default()),
        Standing::Leaving { from, left: None } => (2, from, Left::default()),
        Standing::Leaving { from, left: Some(left) } => (3, from, left),
    };
    tape.bits(&mut kind);
    chosen(&mut side, &SIDES, tape);
    left.exchange(tape);
    memory.standing = match kind {
        1 => Standing::On(side),
        2 => Standing::Leaving { from: side, left: None },
        3 => Standing::Leaving { from: side, left: Some(left) },
        _ => Standing::Open,
    };
    memory.changes.exchange(tape);
}
