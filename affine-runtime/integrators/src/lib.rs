//! Integrators of `y' = f(t, y)` for fixed-size state vectors. They do not allocate. `affine_runtime` runs
//! models by them.
#![cfg_attr(not(any(feature = "std", test)), no_std)]

mod composition;
mod drive;
mod equal_steps;
mod error_norm;
mod finite;
pub mod gauss;
pub mod lanes;
pub mod lie;
mod newton;
pub mod nystrom;
mod packed;
mod published;
pub mod radau;
pub mod rattle;
mod roughly;
pub mod runge_kutta;
pub mod splitting;
mod stages;
mod step_size;
mod tape;
pub mod taylor;
mod vectors;
mod widest;

pub use drive::{Adaptive, Equal};
pub use error_norm::ErrorNorm;
pub use gauss::Gauss;
pub use nystrom::RungeKuttaNystrom;
pub use radau::Radau;
pub use rattle::Rattle;
pub use runge_kutta::{RungeKutta5, RungeKutta8};
pub use splitting::{AdaptiveSplitting, Splitting};
pub use taylor::Taylor;
pub use widest::FusedArithmetic;

use core::fmt;

use affine_core::__private::numerics::Time;

/// What emitted code and runs use besides. No stable interface.
#[doc(hidden)]
pub mod __private {
    pub use crate::splitting::dilated::dilated;
    pub use crate::splitting::fading::fading;
    pub use crate::splitting::growth::{
        accumulate, conjugated, elongation, growth, left_product, right_product, turning,
    };
    pub use crate::taylor::lanes::{
        add_pair, add_products, between, divided, doubled, halved, halves, lanes, set_lanes, subtract_pair,
        subtract_products,
    };

    /// What runs use.
    pub mod runs {
        pub use crate::drive::{AdaptiveMethod, Control, DEFAULT_MAX_STEPS, EqualStepMethod};
        pub use crate::equal_steps::{parts, step_count};
        #[cfg(feature = "std")]
        pub use crate::lanes::equations::Equations;
        pub use crate::runge_kutta::field::{Field, InVectors};
        #[cfg(feature = "std")]
        pub use crate::runge_kutta::in_lanes::{Fate, RungeKutta8InLanes};
        pub use crate::runge_kutta::start::Start;
        #[cfg(feature = "std")]
        pub use crate::runge_kutta::start::starts_in_lanes;
        pub use crate::sound;
        pub use crate::splitting::adaptive::{EVALUATIONS as EVALUATIONS_OF_FASTEST, ORDER, fastest};
        pub use crate::splitting::coefficients::Sweeps;
        #[cfg(feature = "std")]
        pub use crate::splitting::in_lanes::{PiecesInLanes, SplittingInLanes};
        pub use crate::tape::Tape;
        pub use crate::widest::vectorized;
        pub use affine_core::__private::numerics::IS_FUSED;
    }
}

/// Why an integrator cannot go on. Its last accepted state stands.
#[derive(Clone, Copy, PartialEq)]
pub enum Failure {
    /// The right-hand side, or a step however short, gives numbers that are not finite.
    NotFinite,
    /// The error stays above the tolerance, or the equations of an implicit step without solution, however short the step: a
    /// singularity, or a tolerance that rounding does not allow.
    StepUnderflow,
    /// The equations of one of equal steps have no solution, or none that the iteration finds: the step is too long.
    NoSolution {
        /// The defect with which the iteration ended, relative to the largest component of the state and its increments.
        residual: f64,
    },
    /// The velocities are not linear in the momenta, or depend on the placement, or the state is not canonical: the
    /// method is for `H = T(Pi) + U(phi)`.
    NotSeparable,
    /// The start is off the constraint `det phi = 1`, or its velocity off `tr(phi^-1 phi_dot) = 0`.
    OffConstraint {
        /// The larger of the two relative defects.
        defect: f64,
    },
    /// A time of the interval is not finite.
    Time {
        /// Its value.
        given: f64,
    },
    /// The tolerance is not a positive number.
    Tolerance {
        /// Its value.
        given: f64,
    },
    /// The length of equal steps is not positive, not finite, or lost in the rounding of times.
    Step {
        /// Its value.
        given: f64,
        /// Start of the interval.
        t0: f64,
        /// End of the interval.
        t_end: f64,
    },
    /// The end of the interval is not reached within a number of steps: rounding keeps the error above the tolerance, or the
    /// interval is long.
    StepLimit {
        /// The largest number of steps.
        limit: u64,
    },
}

/// An interval that steps come to the end of, and a tolerance that they can be held against.
pub fn sound(t0: f64, t_end: f64, tolerance: f64) -> Result<(), Failure> {
    if let Some(given) = [t0, t_end].into_iter().find(|t| !t.is_finite()) {
        return Err(Failure::Time { given });
    }
    let is_positive = tolerance > 0.0 && tolerance.is_finite();
    if is_positive { Ok(()) } else { Err(Failure::Tolerance { given: tolerance }) }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Failure::NotFinite => f.write_str("the equations of motion give numbers that are not finite"),
            Failure::StepUnderflow => {
                f.write_str("the step size fell below the spacing of floating-point times")
            }
            Failure::NoSolution { residual } => write!(
                f,
                "the equations of an implicit step have no solution that the iteration finds: the residual stays \
                 at {residual:e}"
            ),
            Failure::NotSeparable => f.write_str(
                "the Hamiltonian is not T(Pi) + U(phi) in the variables phi and Pi, with T quadratic",
            ),
            Failure::OffConstraint { defect } => write!(
                f,
                "the start is off det phi = 1, or its velocity off tr(phi^-1 phi_dot) = 0, by {defect:e}"
            ),
            Failure::Time { given } => {
                write!(f, "an end of the interval is {given}: times are finite numbers")
            }
            Failure::Tolerance { given } => write!(
                f,
                "tolerance {given:e}: it is a relative error per step, a positive number; 1e-6 to 1e-13 are common"
            ),
            Failure::Step { given, t0, t_end } => write!(
                f,
                "a step of {given:e} between {t0} and {t_end}: it is a positive number, coarser than the rounding of times",
                t0 = Time(*t0),
                t_end = Time(*t_end)
            ),
            Failure::StepLimit { limit } => {
                write!(f, "the end of the interval is not reached in {limit} steps")
            }
        }
    }
}

/// As it is displayed: a `main` that returns an error prints that.
impl fmt::Debug for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl core::error::Error for Failure {}

/// What an integration cost. All that it asked of the equations is counted: for accepted and rejected steps, for outputs
/// and events between them, at the start, and for the trial of a method that the automatic choice takes or not.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Statistics {
    /// Accepted steps.
    pub steps: u64,
    /// Rejected steps.
    pub rejected: u64,
    /// Evaluations of the right-hand side; of the force alone by [`RungeKuttaNystrom`], and flows of the last piece, which
    /// is that of the potential, by [`Splitting`] and [`AdaptiveSplitting`].
    pub evaluations: u64,
    /// Taylor series, by [`Taylor`]: sets of as many coefficients as the order.
    pub series: u64,
    /// Evaluations that these are worth, `p (p + 1)/2` for each series of order `p`. Not counted but derived from counts of
    /// operations, and an upper bound: so many products of coefficients make up a series of a product, where an evaluation
    /// takes one; a sum, and a multiple, takes `p`. By run time a series is worth less, for its products are taken several at
    /// once.
    pub series_worth: u64,
}

impl Statistics {
    /// Evaluations, and those that Taylor series are [worth](Self::series_worth): what methods can be compared by that take
    /// both.
    #[must_use]
    pub fn equivalent_evaluations(&self) -> u64 {
        self.evaluations + self.series_worth
    }

    /// Taylor series of an order, beside what was counted.
    fn with_series(self, order: usize) -> Self {
        let order = order as u64;
        Self { series: self.series + 1, series_worth: self.series_worth + order * (order + 1) / 2, ..self }
    }

    /// Costs one after the other.
    #[doc(hidden)]
    #[must_use]
    pub fn and(self, after: Self) -> Self {
        Self {
            steps: self.steps + after.steps,
            rejected: self.rejected + after.rejected,
            evaluations: self.evaluations + after.evaluations,
            series: self.series + after.series,
            series_worth: self.series_worth + after.series_worth,
        }
    }
}
