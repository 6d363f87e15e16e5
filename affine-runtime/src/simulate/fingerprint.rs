//! By what a checkpoint knows the run that it is of.

use super::digest::Digest;
use super::mechanics::Mechanics;
use super::output::Output;
use super::settings::Settings;
use crate::state::Phase;

/// Where between start and end of a run the equations are looked at: an arbitrary part, at which no usual function of time
/// vanishes.
const BETWEEN: f64 = 0.37;

/// Model with the values of its parameters, start, method, tolerance, interval, outputs and events: runs that take the same
/// steps from the same place, and record them alike. The largest number of steps is free, and so are callbacks.
///
/// Parameters and forces are known by what they do, energy and time derivative at one phase point: another value that gives
/// the same numbers there, as does a force of the time that is not yet on, is not told apart.
pub(super) fn fingerprint<const N: usize, P: Phase<N>>(
    model: &dyn Mechanics<N, P>,
    settings: &Settings<'_, N, P>,
    events: &[&'static str],
) -> String {
    let Settings { start, plan, .. } = settings;
    let t_end = plan.t_end.unwrap_or(f64::NAN);
    let mut digest = Digest::new();
    start.entries(&mut |entry| digest.number(entry));
    match &plan.output {
        Output::Steps => digest.word(0),
        Output::Every(dt) => {
            digest.word(1);
            digest.number(*dt);
        }
        Output::At(times) => {
            digest.word(2);
            times.iter().for_each(|t| digest.number(*t));
        }
    }
    let point = elsewhere(start);
    model.witness(plan.t0 + BETWEEN * (t_end - plan.t0), &point, &mut |number| digest.number(number));
    let [t0, t_end, tolerance] = [plan.t0, t_end, plan.tolerance].map(f64::to_bits);
    let (name, method, digest) = (model.description().name, plan.method, digest.0);
    format!("{name} {method:?} {tolerance:x} {t0:x} {t_end:x} {events:?} {digest:x}")
}

/// A phase point near the start of which no component is zero: where all that a model has makes itself felt.
fn elsewhere<const N: usize, P: Phase<N>>(start: &P) -> P {
    let mut size: f64 = 0.0;
    start.entries(&mut |entry| size = if entry.abs() > size { entry.abs() } else { size });
    let mut entries = Vec::new();
    start.entries(&mut |entry| entries.push(entry));
    let mut entries = entries.into_iter().enumerate();
    start.with_entries(&mut || {
        entries.next().map_or(0.0, |(k, entry)| entry + size * SHIFTS[k % SHIFTS.len()])
    })
}

/// In parts of the largest entry, too small to turn a placement inside out that is not thin.
const SHIFTS: [f64; 7] = [0.031, -0.013, 0.021, 0.017, 0.043, -0.011, 0.027];
