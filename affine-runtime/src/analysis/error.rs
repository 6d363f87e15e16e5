//! What can come of an analysis instead of an answer.

use core::fmt;

use crate::error::Error;
use crate::integrate::Failure;

/// Why there is no answer.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum AnalysisError {
    /// Newton's iteration finds no solution near the guess.
    NoConvergence {
        /// Norm of the equations where it ended.
        residual: f64,
        /// Steps taken.
        steps: usize,
    },
    /// A generator is none of a symmetry that the model is proved to have.
    NotASymmetry {
        /// How far the generator is from those of symmetries, relative to its size.
        defect: f64,
    },
    /// A condition asks for a generator that is not among those that are free, or for a value that is no number.
    Condition {
        /// The place of the generator, from 0.
        generator: usize,
        /// How many there are.
        generators: usize,
        /// The value.
        value: f64,
    },
    /// The equations contain the time, by the potential or a force: what rests and is stable at one time is not at another.
    DependsOnTime,
    /// The equations are not those of small vibrations about rest: something moves, a force has no potential, or the mass
    /// matrix is not positive.
    NoVibrations,
    /// Solutions go on in more directions than they should, or in none: a bifurcation point, or one of a family. Orbits of
    /// symmetries are not counted.
    Degenerate {
        /// Directions in which the linearised equations have solutions.
        kernel: usize,
        /// As many as velocities are left open by the conditions, and one along a branch.
        expected: usize,
    },
    /// A branch is followed in steps of positive length, from a parameter within its range.
    Range {
        /// The longest step along the branch, in all unknowns together.
        step: f64,
        /// The least parameter.
        low: f64,
        /// The largest parameter.
        high: f64,
        /// The parameter at the start.
        start: f64,
    },
    /// A Lyapunov spectrum is that of a time, forward or backward, which is a number and not zero.
    Time(f64),
    /// Steps along a branch have become too short.
    StepUnderflow {
        /// Length of the last one.
        step: f64,
    },
    /// Eigenvalues or singular values were not found.
    NoDecomposition,
    /// The model, at some value of its parameter.
    Model(Error),
    /// The integration of a motion.
    Integration(Failure),
}

impl fmt::Display for AnalysisError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoConvergence { residual, .. } if !residual.is_finite() => {
                write!(f, "no solution near the guess: the equations have no value there")
            }
            Self::NoConvergence { residual, steps } => {
                write!(f, "no solution near the guess: residual {residual:e} after {steps} steps")
            }
            Self::NotASymmetry { defect } => write!(f, "no symmetry of the energy: defect {defect:e}"),
            Self::Condition { generator, generators, value } => write!(
                f,
                "a condition asks generator {generator} for {value}: there are {generators}, counted from 0, and values are finite"
            ),
            Self::DependsOnTime => write!(
                f,
                "the equations contain the time: what rests and is stable at one time is not at another"
            ),
            Self::NoVibrations => write!(f, "something moves or is damped, or masses are not positive"),
            Self::Degenerate { kernel, expected } => {
                write!(f, "solutions go on in {kernel} directions where {expected} are expected")
            }
            Self::Range { step, low, high, start } => write!(
                f,
                "steps of {step:e} from {start} within {low} to {high}: give a step that is a positive number, and a start within \
                 the range"
            ),
            Self::Time(time) => write!(f, "a time of {time:e}: give a number that is not zero"),
            Self::StepUnderflow { step } => write!(f, "steps along the branch are too short: {step:e}"),
            Self::NoDecomposition => write!(f, "eigenvalues were not found"),
            Self::Model(error) => error.fmt(f),
            Self::Integration(failure) => failure.fmt(f),
        }
    }
}

impl std::error::Error for AnalysisError {}

impl From<Error> for AnalysisError {
    fn from(error: Error) -> Self {
        Self::Model(error)
    }
}

impl From<Failure> for AnalysisError {
    fn from(failure: Failure) -> Self {
        Self::Integration(failure)
    }
}
