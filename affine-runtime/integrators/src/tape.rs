//! The state of an integration as a row of numbers, from which it goes on with the same bits.

use super::Statistics;
use super::lie::Sum;
use affine_core::model::StateVector;

/// What is written and read alike: an integrator hands over all that its next steps depend on, one after the other.
pub trait Tape {
    /// Keeps 64 bits, or replaces them by those that were kept.
    fn bits(&mut self, bits: &mut u64);

    /// Keeps a number by its bits, or replaces it.
    fn number(&mut self, number: &mut f64) {
        let mut bits = number.to_bits();
        self.bits(&mut bits);
        *number = f64::from_bits(bits);
    }

    /// Keeps a choice as a number, or replaces it.
    fn flag(&mut self, flag: &mut bool) {
        let mut bits = u64::from(*flag);
        self.bits(&mut bits);
        *flag = bits == 1;
    }

    /// All components of a state.
    fn state<S: StateVector<f64>>(&mut self, state: &mut S) {
        state.as_mut().iter_mut().for_each(|number| self.number(number));
    }

    /// A state with what rounding left out of it.
    fn sum<S: StateVector<f64>>(&mut self, sum: &mut Sum<S>) {
        self.state(&mut sum.value);
        self.state(&mut sum.carry);
    }

    /// The counts of steps and evaluations.
    fn statistics(&mut self, statistics: &mut Statistics) {
        self.bits(&mut statistics.steps);
        self.bits(&mut statistics.rejected);
        self.bits(&mut statistics.evaluations);
        self.bits(&mut statistics.series);
        self.bits(&mut statistics.series_worth);
    }
}
