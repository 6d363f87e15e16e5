//! What is told of functions by their values within a step.

/// Part of what a function changes by in a step: a cubic tells that it is further than that from zero.
const NEAR_ZERO: f64 = 0.125;

/// What the ends of a step tell of it.
pub(in super::super) enum Step<P> {
    /// Nothing happens within it.
    Quiet,
    /// Functions go through zero, each of them once; the point at the end.
    Crossed(P),
    /// Samples have to be looked at; the point at the end, where it is known.
    Open(Option<P>),
}

/// The values of a function along a step, at its ends and after each quarter of it.
#[derive(Clone, Copy)]
pub(super) struct Along(pub(super) [f64; PARTS + 1]);

/// The quarters.
pub(super) const PARTS: usize = 4;

impl Along {
    pub(super) const NONE: Self = Self([f64::NAN; PARTS + 1]);

    /// All values are numbers, and the function does not come near zero, or goes through it without turning.
    #[inline]
    pub(super) fn is_plain(&self) -> bool {
        let [begin, .., end] = self.0;
        let (mut least, mut most, mut sum) = (begin, begin, begin);
        for value in &self.0[1..] {
            // One instruction each, where NaN is looked for besides.
            least = if *value < least { *value } else { least };
            most = if *value > most { *value } else { most };
            sum += value;
        }
        let near = NEAR_ZERO * (most - least);
        let is_far = if begin > 0.0 && end > 0.0 {
            least > near
        } else if begin < 0.0 && end < 0.0 {
            -most > near
        } else {
            self.0.is_sorted_by(|from, to| (to - from) * end.signum() > near)
        };
        !sum.is_nan() && is_far
    }

    /// The part of the step after which the function comes to zero, about.
    pub(super) fn zero(&self) -> f64 {
        let side = self.0[PARTS].signum();
        let before = (0..PARTS).rfind(|k| self.0[*k] * side < 0.0).unwrap_or(0);
        let [from, to] = [self.0[before], self.0[before + 1]];
        (before as f64 + from / (from - to)) / PARTS as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn is_told(values: [f64; 5]) -> bool {
        Along(values).is_plain()
    }

    #[test]
    fn what_stays_away_from_zero_is_told() {
        for side in [1.0, -1.0] {
            let is_told = |values: [f64; 5]| is_told(values.map(|value| side * value));
            assert!(is_told([1.0; 5]) && is_told([1.0, 0.5, 0.3, 0.6, 2.0]));
            assert!(!is_told([1.0, 0.5, 0.1, 0.6, 2.0]), "near zero for how it moves");
            assert!(!is_told([1.0, 0.5, -0.3, 0.6, 2.0]), "there and back");
            assert!(!is_told([1.0, f64::NAN, 1.0, 1.0, 1.0]) && !is_told([1.0, 1.0, 1.0, 1.0, f64::NAN]));
        }
    }

    #[test]
    fn what_goes_through_zero_is_told_if_it_does_not_turn() {
        for side in [1.0, -1.0] {
            let is_told = |values: [f64; 5]| is_told(values.map(|value| side * value));
            assert!(is_told([-1.0, -0.5, 0.1, 0.5, 1.0]) && is_told([-1.0, -0.7, -0.4, 0.0, 0.5]));
            assert!(!is_told([-1.0, -0.5, 0.2, 0.1, 1.0]) && !is_told([-1.0, -1.1, -0.4, 0.0, 0.5]));
            assert!(!is_told([-1.0, 0.5, 0.6, 0.7, 1.0]), "hardly rises");
        }
    }
}
