//! What cannot happen: a fault of the macro, which must not become a wrong number or name in its output.
//!
//! A derivation goes on with a stand-in and hands over what it makes; the first fault is written down here, and an
//! expansion during which one was is not given out.

use std::cell::Cell;
use std::panic::Location;

/// Something that was thought impossible.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fault {
    /// What was thought to hold.
    pub belief: &'static str,
    at: &'static Location<'static>,
}

impl Fault {
    /// File and line of the generator; of the file what does not depend on where it was built.
    pub fn place(&self) -> String {
        let file = self.at.file().replace('\\', "/");
        let within = file.rsplit_once("/src/").map_or(file.as_str(), |(_, within)| within);
        format!("{within}:{}", self.at.line())
    }
}

thread_local! {
    static FIRST: Cell<Option<Fault>> = const { Cell::new(None) };
}

/// The value that is always there, for the reason that `belief` states. Where it is not, that is a fault, and `stand_in`
/// keeps the derivation going until the fault is told.
#[track_caller]
pub fn never_missing<T>(value: Option<T>, belief: &'static str, stand_in: T) -> T {
    // No closure: it would be the caller that is written down.
    match value {
        Some(value) => value,
        None => {
            record(belief);
            stand_in
        }
    }
}

/// A fault, where a branch is reached that no value leads to.
#[track_caller]
pub fn record(belief: &'static str) {
    let at = Location::caller();
    FIRST.set(FIRST.get().or(Some(Fault { belief, at })));
}

/// What `work` gives, and the first fault on its way.
pub fn watch<T>(work: impl FnOnce() -> T) -> (T, Option<Fault>) {
    let outside = FIRST.take();
    let value = work();
    (value, FIRST.replace(outside))
}
