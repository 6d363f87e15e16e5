//! Why a run ends where its integration fails.

use super::method::Method;
use crate::error::{Reason, Setting};
use crate::integrate::Failure;

/// Why an integration of `model` that failed by the method and the tolerance that it was given goes no further.
pub(super) fn failed(failure: Failure, (method, tolerance): (Method, f64), model: &'static str) -> Reason {
    match failure {
        Failure::NotFinite => Reason::NotFinite,
        Failure::StepUnderflow => Reason::StepUnderflow { tolerance },
        Failure::NoSolution { residual } => {
            Reason::NoSolution { residual, step: method.step().unwrap_or(f64::NAN) }
        }
        Failure::NotSeparable => Setting::NotSeparable { model }.into(),
        Failure::OffConstraint { defect } => Setting::OffConstraint { defect }.into(),
        Failure::Time { given } => Setting::Time { name: "an end of the interval", given }.into(),
        Failure::Tolerance { given } => Setting::Tolerance { given }.into(),
        Failure::Step { given, t0, t_end } => Setting::Step { given, t0, t_end }.into(),
        Failure::StepLimit { limit } => Reason::StepLimit { limit },
    }
}
