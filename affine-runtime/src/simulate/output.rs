//! Output times.

use crate::error::Setting;
use crate::inner::parts;

/// More outputs than that are taken for a slip of the pen.
const MOST_OUTPUTS: f64 = 1e8;
/// Intervals of a trajectory in closed form whose output times are left open.
const CLOSED_FORM_INTERVALS: f64 = 100.0;

/// Where a trajectory is recorded, as asked for.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Output {
    /// At every step.
    Steps,
    /// At equidistant times, and at the end.
    Every(f64),
    /// Outputs at the times of a list.
    At(Vec<f64>),
}

/// Where a trajectory is recorded, checked: a queue of times in the direction of time.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Schedule {
    /// At every step.
    Steps,
    /// At `t0 + k dt` for `k = next..count`, then at `t_end`; `dt` is signed.
    Equidistant { t0: f64, dt: f64, t_end: f64, next: u64, count: u64 },
    /// At these times, from `next` on.
    Listed { times: Vec<f64>, next: usize },
}

impl Output {
    /// The schedule on the interval between two finite times.
    pub(super) fn schedule(&self, t0: f64, t_end: f64) -> Result<Schedule, Setting> {
        match self {
            Output::Steps => Ok(Schedule::Steps),
            Output::Every(dt) => equidistant(t0, t_end, *dt),
            Output::At(times) => listed(t0, t_end, times),
        }
    }
}

/// Equal intervals for a closed form, which has no steps; the interval alone where the rounding of times does not tell
/// its parts apart.
pub(super) fn without_steps(t0: f64, t_end: f64) -> Schedule {
    let dt = (t_end - t0) / CLOSED_FORM_INTERVALS;
    let is_resolved = dt.abs() > 4.0 * resolution(t0, t_end);
    let count = if t0 == t_end {
        0
    } else if is_resolved {
        CLOSED_FORM_INTERVALS as u64
    } else {
        1
    };
    let dt = if is_resolved { dt } else { t_end - t0 };
    Schedule::Equidistant { t0, dt, t_end, next: 0, count }
}

/// The rounding of times in an interval, or of the least times there are.
fn resolution(t0: f64, t_end: f64) -> f64 {
    f64::EPSILON * t0.abs().max(t_end.abs()).max(f64::MIN_POSITIVE)
}

fn equidistant(t0: f64, t_end: f64, dt: f64) -> Result<Schedule, Setting> {
    let span = (t_end - t0).abs();
    let resolution = resolution(t0, t_end);
    if !(dt.is_finite() && dt > 0.0) || (dt <= 4.0 * resolution && span > 0.0) || span / dt > MOST_OUTPUTS {
        return Err(Setting::OutputSpacing { dt, t0, t_end });
    }
    // Of an interval that rounding alone keeps from being a multiple of dt there is no output next to the end, which is an
    // output anyway.
    let count = parts(t0, t_end, dt) as u64;
    Ok(Schedule::Equidistant { t0, dt: dt.copysign(t_end - t0), t_end, next: 0, count })
}

fn listed(t0: f64, t_end: f64, times: &[f64]) -> Result<Schedule, Setting> {
    let direction = if t_end < t0 { -1.0 } else { 1.0 };
    for (index, &t) in times.iter().enumerate() {
        if !t.is_finite() {
            return Err(Setting::Time { name: "an output time", given: t });
        }
        if direction * (t - t0) < 0.0 || direction * (t_end - t) < 0.0 {
            return Err(Setting::OutputOutside { index, t, t0, t_end });
        }
        if index > 0 && direction * (t - times[index - 1]) <= 0.0 {
            return Err(Setting::OutputOrder { index, t, before: times[index - 1] });
        }
    }
    Ok(Schedule::Listed { times: times.to_vec(), next: 0 })
}

impl Schedule {
    /// The next output time, if there is one before the schedule's end.
    pub(super) fn peek(&self) -> Option<f64> {
        match self {
            Schedule::Steps => None,
            Schedule::Equidistant { t0, dt, t_end, next, count } => match next.cmp(count) {
                core::cmp::Ordering::Less => Some(t0 + *next as f64 * dt),
                core::cmp::Ordering::Equal => Some(*t_end),
                core::cmp::Ordering::Greater => None,
            },
            Schedule::Listed { times, next } => times.get(*next).copied(),
        }
    }

    /// Number of output times, those taken too; 0 where that is not known.
    pub(super) fn len(&self) -> usize {
        match self {
            Schedule::Steps => 0,
            Schedule::Equidistant { count, .. } => *count as usize + 1,
            Schedule::Listed { times, .. } => times.len(),
        }
    }

    /// Number of output times taken.
    pub(super) fn taken(&self) -> u64 {
        match self {
            Schedule::Steps => 0,
            Schedule::Equidistant { next, .. } => *next,
            Schedule::Listed { next, .. } => *next as u64,
        }
    }

    /// Goes on after so many output times.
    pub(super) fn resume(&mut self, taken: u64) {
        match self {
            Schedule::Steps => {}
            Schedule::Equidistant { next, .. } => *next = taken,
            Schedule::Listed { next, .. } => *next = taken as usize,
        }
    }

    /// The end of the run is an output.
    pub(super) fn ends_with_output(&self) -> bool {
        !matches!(self, Schedule::Listed { .. })
    }

    /// Takes the next output time out of the queue if it lies at or before `t`.
    pub(super) fn take_through(&mut self, t: f64, backward: bool) -> Option<f64> {
        let due = self.peek().filter(|due| if backward { *due >= t } else { *due <= t })?;
        match self {
            Schedule::Steps => {}
            Schedule::Equidistant { next, .. } => *next += 1,
            Schedule::Listed { next, .. } => *next += 1,
        }
        Some(due)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn times(output: &Output, t0: f64, t_end: f64) -> Vec<f64> {
        let mut schedule = output.schedule(t0, t_end).unwrap();
        core::iter::from_fn(|| schedule.take_through(t_end, t_end < t0)).collect()
    }

    #[test]
    fn equidistant_times_end_at_the_end() {
        assert_eq!(times(&Output::Every(0.25), 0.0, 1.0), [0.0, 0.25, 0.5, 0.75, 1.0]);
        assert_eq!(times(&Output::Every(0.4), 0.0, 1.0), [0.0, 0.4, 0.8, 1.0], "not a multiple");
        assert_eq!(times(&Output::Every(3.0), 0.0, 1.0), [0.0, 1.0], "longer than the interval");
        assert_eq!(times(&Output::Every(0.5), 2.0, 0.8), [2.0, 1.5, 1.0, 0.8], "backward");
        assert_eq!(times(&Output::Every(0.5), 2.0, 2.0), [2.0], "empty interval");
    }

    /// Between neighbouring numbers there is no other.
    #[test]
    fn closed_forms_have_each_time_once() {
        for (t0, t_end) in
            [(1e6_f64, 1e6_f64.next_up()), (1.0, 1.0 - 1e-15), (0.0, 5e-324), (0.0, 1e-300), (0.0, 1.0)]
        {
            let mut schedule = without_steps(t0, t_end);
            let times: Vec<f64> = core::iter::from_fn(|| schedule.take_through(t_end, t_end < t0)).collect();
            assert!(times.windows(2).all(|w| (w[1] - w[0]) * (t_end - t0).signum() > 0.0), "{times:?}");
            assert_eq!((times[0], times[times.len() - 1]), (t0, t_end));
        }
    }

    #[test]
    fn rounding_neither_doubles_nor_drops_an_output() {
        // 0.1 + 0.2 style cases: count, strict order, and both ends, for many spacings and offsets.
        for t0 in [0.0, 0.1, -7.3, 1e6 + 0.1] {
            for intervals in [1, 3, 10, 49, 1000] {
                for dt in [0.1, 0.3, 1.0 / 3.0, 0.7] {
                    let t_end = t0 + f64::from(intervals) * dt;
                    let times = times(&Output::Every(dt), t0, t_end);
                    assert_eq!(times.len(), intervals as usize + 1, "{t0} {dt} {intervals}");
                    assert!(times.windows(2).all(|w| w[1] - w[0] > 0.5 * dt));
                    assert_eq!((times[0], times[times.len() - 1]), (t0, t_end));
                }
            }
        }
    }

    #[test]
    fn bad_spacings_and_times_are_refused() {
        for dt in [0.0, -0.1, f64::NAN, f64::INFINITY, 1e-9, 1e-300] {
            assert!(matches!(
                Output::Every(dt).schedule(0.0, 1.0),
                Err(Setting::OutputSpacing { dt: given, .. }) if given.to_bits() == dt.to_bits()
            ));
        }
        let at = |times: &[f64], t0, t_end| Output::At(times.to_vec()).schedule(t0, t_end).unwrap_err();
        assert!(matches!(at(&[0.5, f64::NAN], 0.0, 1.0), Setting::Time { .. }));
        assert_eq!(
            at(&[0.5, 1.5], 0.0, 1.0),
            Setting::OutputOutside { index: 1, t: 1.5, t0: 0.0, t_end: 1.0 }
        );
        assert_eq!(at(&[-0.5], 0.0, 1.0), Setting::OutputOutside { index: 0, t: -0.5, t0: 0.0, t_end: 1.0 });
        assert_eq!(at(&[0.5, 0.5], 0.0, 1.0), Setting::OutputOrder { index: 1, t: 0.5, before: 0.5 });
        assert_eq!(at(&[0.2, 0.5], 1.0, 0.0), Setting::OutputOrder { index: 1, t: 0.5, before: 0.2 });
    }

    #[test]
    fn listed_times_are_taken_as_they_are() {
        assert_eq!(times(&Output::At(vec![0.0, 0.3, 1.0]), 0.0, 1.0), [0.0, 0.3, 1.0]);
        assert_eq!(times(&Output::At(vec![0.9, 0.3]), 1.0, 0.0), [0.9, 0.3]);
        assert_eq!(times(&Output::At(vec![]), 0.0, 1.0), [0.0; 0]);
    }
}
