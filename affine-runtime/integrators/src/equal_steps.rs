//! Equal steps: the times of a method whose accuracy is its step, and what all such methods do alike.

use super::Failure;
use super::tape::Tape;

/// Parts are equal and none is longer than asked for; a length that divides the interval up to this many roundings
/// of its ends, of itself and of the quotient is taken as it is.
const ROUNDINGS: f64 = 4.0;
/// More steps than numbers that a double counts exactly.
const MOST_STEPS: f64 = 9_007_199_254_740_992.0;

/// The times `t0 + k h` from `t0` to `t_end`, `h = (t_end - t0)/n`, `n = ceil(|t_end - t0|/step)`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Times {
    t0: f64,
    t_end: f64,
    /// The longest step.
    step: f64,
    h: f64,
    count: u64,
}

impl Times {
    /// # Errors
    /// [`Failure::Time`] where one of the times is not finite; [`Failure::Step`] where `step` is not positive or not finite, or
    /// gives more steps than there are floating-point times.
    pub(super) fn new(t0: f64, t_end: f64, step: f64) -> Result<Self, Failure> {
        if let Some(given) = [t0, t_end].into_iter().find(|t| !t.is_finite()) {
            return Err(Failure::Time { given });
        }
        let count = step_count(t0, t_end, step).filter(|_| step.is_finite());
        let count = count.ok_or(Failure::Step { given: step, t0, t_end })?;
        let h = if count == 0 { 0.0 } else { (t_end - t0) / count as f64 };
        Ok(Self { t0, t_end, step, h, count })
    }

    /// Length of the steps, negative backward in time.
    pub(super) fn length(&self) -> f64 {
        self.h
    }

    fn at(&self, taken: u64) -> f64 {
        if taken == self.count { self.t_end } else { self.t0 + taken as f64 * self.h }
    }
}

/// A place among three, after each other in a circle.
#[derive(Clone, Copy, Debug)]
enum Place {
    First,
    Second,
    Third,
}

impl Place {
    fn next(self) -> Self {
        match self {
            Self::First => Self::Second,
            Self::Second => Self::Third,
            Self::Third => Self::First,
        }
    }
}

/// The steps taken, with the points where the last one began and ended.
#[derive(Clone, Copy, Debug)]
pub(super) struct EqualSteps<P> {
    times: Times,
    taken: u64,
    /// Steps to the times before these.
    before: u64,
    /// Length of the last step.
    last: f64,
    /// Where the last step began, where it ended, and room for the next one, in a circle: points are not moved, and where a
    /// step fails the one before it is still known.
    points: [P; 3],
    /// The place of the point reached.
    end: Place,
    failure: Option<Failure>,
}

impl<P: Copy> EqualSteps<P> {
    /// Before the first step.
    pub(super) fn at(times: Times, start: P) -> Self {
        Self {
            times,
            taken: 0,
            before: 0,
            last: times.h,
            points: [start; 3],
            end: Place::First,
            failure: None,
        }
    }

    /// Takes a step; does nothing at `t_end`. What moves the point is given the time, the point, room for the next one, the length
    /// of the step, and that of the step before if there is one. Where it fails the point reached stays, now and ever after.
    ///
    /// # Errors
    /// Those of the step.
    #[inline(always)]
    pub(super) fn take(
        &mut self,
        step: impl FnOnce((f64, &P), &mut P, f64, Option<f64>) -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        if let Some(failure) = self.failure {
            return Err(failure);
        }
        if self.is_finished() {
            return Ok(());
        }
        let (t, last) = (self.t(), (self.taken() > 0).then_some(self.last));
        let [first, second, third] = &mut self.points;
        let (end, next) = match self.end {
            Place::First => (first, second),
            Place::Second => (second, third),
            Place::Third => (third, first),
        };
        if let Err(failure) = step((t, end), next, self.times.h, last) {
            self.failure = Some(failure);
            return Err(failure);
        }
        (self.end, self.last) = (self.end.next(), self.times.h);
        self.taken += 1;
        Ok(())
    }

    /// Goes on to another end, in steps that are not longer than before.
    ///
    /// # Errors
    /// Those of [`Times::new`]; the steps stay as they are.
    pub(super) fn aim(&mut self, t_end: f64) -> Result<(), Failure> {
        self.times = Times::new(self.t(), t_end, self.times.step)?;
        (self.before, self.taken) = (self.taken(), 0);
        Ok(())
    }

    /// Passes over the steps to the end, where the point is what it was.
    #[cfg(feature = "std")]
    pub(super) fn pass_over(&mut self) {
        self.taken = self.times.count;
    }

    /// Length of the last step; of the first one before it is taken.
    pub(super) fn last_length(&self) -> f64 {
        self.last
    }

    /// Where the last step began, for a shorter one to the time `t`: point, time and length; `None` where the point
    /// reached is the one at `t`, or the only one.
    pub(super) fn again_to(&self, t: f64) -> Option<(f64, P, f64)> {
        if t == self.t() {
            return None;
        }
        self.begin().map(|(begin, point)| (begin, *point, t - begin))
    }

    /// Time and point where the last step began; `None` where none was taken to this end.
    pub(super) fn begin(&self) -> Option<(f64, &P)> {
        let before = self.taken.checked_sub(1)?;
        // The place before is the one after the next.
        Some((self.times.at(before), self.point(self.end.next().next())))
    }

    /// Time reached.
    pub(super) fn t(&self) -> f64 {
        self.times.at(self.taken)
    }

    /// Point reached.
    pub(super) fn end(&self) -> &P {
        self.point(self.end)
    }

    /// The same, to be changed between steps.
    #[cfg(feature = "std")]
    pub(super) fn end_mut(&mut self) -> &mut P {
        let [first, second, third] = &mut self.points;
        match self.end {
            Place::First => first,
            Place::Second => second,
            Place::Third => third,
        }
    }

    fn point(&self, place: Place) -> &P {
        let [first, second, third] = &self.points;
        match place {
            Place::First => first,
            Place::Second => second,
            Place::Third => third,
        }
    }

    /// `t_end` is reached.
    pub(super) fn is_finished(&self) -> bool {
        self.taken == self.times.count
    }

    /// Steps taken.
    pub(super) fn taken(&self) -> u64 {
        self.before + self.taken
    }

    /// The times.
    pub(super) fn times(&self) -> &Times {
        &self.times
    }

    /// Everything that the next steps depend on; `point` hands over a point.
    pub(super) fn exchange<T: Tape>(&mut self, tape: &mut T, point: impl FnOnce(&mut T, &mut P)) {
        tape.bits(&mut self.taken);
        let mut end = *self.end();
        point(tape, &mut end);
        self.points = [end; 3];
    }
}

/// `ceil(|t_end - t0|/step)`; `None` where the step is not positive or is lost in the rounding of times.
pub fn step_count(t0: f64, t_end: f64, step: f64) -> Option<u64> {
    let span = (t_end - t0).abs();
    let latest = if t0.abs() > t_end.abs() { t0.abs() } else { t_end.abs() };
    if span == 0.0 && step > 0.0 {
        return Some(0);
    }
    if !(step > 0.0 && span / step < MOST_STEPS && step > 4.0 * f64::EPSILON * latest) {
        return None;
    }
    let count = parts(t0, t_end, step);
    // One step where it is longer than the interval, infinite steps included.
    Some(if count > 1.0 { count as u64 } else { 1 })
}

/// `ceil(|t_end - t0|/part)`, and the nearest whole number where rounding alone may have made it another.
///
/// Times are numbers: of `from(k dt)` and `until((k + 1) dt)` each is rounded, by as much more than `dt` itself as it is
/// larger.
pub fn parts(t0: f64, t_end: f64, part: f64) -> f64 {
    let span = (t_end - t0).abs();
    let exact = span / part;
    let whole = libm::round(exact);
    let roundings = ROUNDINGS * f64::EPSILON * ((t0.abs() + t_end.abs()) / part + exact);
    if (exact - whole).abs() <= roundings { whole } else { libm::ceil(exact) }
}

#[cfg(test)]
#[allow(clippy::expect_used)]
mod tests {
    use super::{EqualSteps, Failure, Times, step_count};

    #[test]
    fn a_step_that_fails_leaves_the_one_before() {
        let times = Times::new(0.0, 5.0, 1.0).expect("times");
        let mut steps = EqualSteps::at(times, 10.0_f64);
        for taken in 0..4 {
            let last = steps.again_to(0.25);
            let before = if taken == 0 { None } else { Some((f64::from(taken - 1), 9.0 + f64::from(taken))) };
            assert_eq!(last.map(|(t, point, _)| (t, point)), before);
            let step = |(t, point): (f64, &f64), next: &mut f64, h: f64, last: Option<f64>| {
                assert_eq!((t, *point, h), (f64::from(taken), 10.0 + f64::from(taken), 1.0));
                assert_eq!(last, (taken > 0).then_some(1.0));
                *next = *point + h;
                if taken < 3 { Ok(()) } else { Err(Failure::NotFinite) }
            };
            assert_eq!(steps.take(step).is_ok(), taken < 3);
        }
        assert_eq!((steps.t(), *steps.end(), steps.taken()), (3.0, 13.0, 3));
        assert_eq!(steps.again_to(2.5), Some((2.0, 12.0, 0.5)));
        assert_eq!(steps.take(|_, _, _, _| Ok(())), Err(Failure::NotFinite));
    }

    #[test]
    fn frames_have_the_steps_that_they_are_divided_into() {
        for frames_a_second in [24.0, 30.0, 60.0, 144.0, 1000.0] {
            for offset in [0.0, 0.1, -5e3, 1e4 + 0.7] {
                for steps in 1..=9_u32 {
                    let dt = 1.0 / frames_a_second;
                    let step = dt / f64::from(steps);
                    for frame in 0..2000 {
                        let [begin, end] = [0, 1].map(|k| offset + f64::from(frame + k) * dt);
                        assert_eq!(
                            step_count(begin, end, step),
                            Some(u64::from(steps)),
                            "{begin} {end} {step}"
                        );
                        assert_eq!(step_count(end, begin, step), Some(u64::from(steps)), "backward");
                    }
                }
            }
        }
        // Times that are summed.
        let (dt, mut t) = (1.0 / 60.0, 0.0);
        for _ in 0..10_000 {
            let next = t + dt;
            assert_eq!(step_count(t, next, 0.25 * dt), Some(4), "{t}");
            t = next;
        }
    }

    #[test]
    fn no_step_is_longer_than_asked_for() {
        assert_eq!(step_count(0.0, 1.0, 0.3), Some(4));
        assert_eq!(
            step_count(0.0, 1.0, 1.0 / (4.0 + 1e-12)),
            Some(5),
            "a difference that is none of rounding"
        );
        assert_eq!(step_count(1e4, 1e4 + 1.0, 1.0 / (4.0 + 1e-9)), Some(5));
        assert_eq!(step_count(0.0, 1.0, f64::INFINITY), Some(1));
        assert_eq!(step_count(2.0, 2.0, 0.1), Some(0));
        for step in [0.0, -1.0, f64::NAN, 1e-17] {
            assert_eq!(step_count(0.0, 1.0, step), None, "{step}");
        }
    }
}
