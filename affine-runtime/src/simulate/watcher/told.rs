//! What is told of functions by their values within a step.

/// Part of what a function changes by in a step: a cubic tells that it is further than that from zero.
const NEAR_ZERO: f64 = 0.125;

/// The way of a function through a step, by its distances beyond zero: positive on the side of the end.
#[derive(Clone, Copy)]
pub(super) struct Told {
    side: f64,
    begin: f64,
    last: f64,
    least: f64,
    most: f64,
    /// The least rise from one sample to the next.
    rise: f64,
}

impl Told {
    /// From its value at the begin of the step, on the way to that at the end.
    pub(super) fn between(begin: f64, end: f64) -> Self {
        let side = end.signum();
        let begin = begin * side;
        Self { side, begin, last: begin, least: begin, most: begin, rise: f64::INFINITY }
    }

    /// To its next value, if that is a number.
    pub(super) fn goes(&mut self, value: f64) -> bool {
        let distance = value * self.side;
        let rise = distance - self.last;
        self.rise = if rise < self.rise { rise } else { self.rise };
        self.least = if distance < self.least { distance } else { self.least };
        self.most = if distance > self.most { distance } else { self.most };
        self.last = distance;
        !distance.is_nan()
    }

    /// It does not come near zero, or goes through it without turning.
    pub(super) fn ends_plainly(&mut self, value: f64) -> bool {
        let near = |told: &Self| NEAR_ZERO * (told.most - told.least);
        self.goes(value) && if self.begin > 0.0 { self.least > near(self) } else { self.rise > near(self) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn is_told(values: [f64; 5]) -> bool {
        let [begin, within @ .., end] = values;
        let mut told = Told::between(begin, end);
        within.into_iter().all(|value| told.goes(value)) && told.ends_plainly(end)
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
