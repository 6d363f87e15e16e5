//! What is to be integrated, and by which method.

use super::failed::failed;
use super::method::Method;
use crate::error::Reason;
use crate::integrate::Failure;

/// What is to be integrated.
#[derive(Clone, Copy)]
pub(super) struct Course<'p, P> {
    pub(super) t0: f64,
    pub(super) start: &'p P,
    pub(super) t_end: f64,
    pub(super) method: Method,
    pub(super) tolerance: f64,
    /// Times within steps are looked at.
    pub(super) within_steps: bool,
}

impl<P> Course<'_, P> {
    /// Why a run of `model` ends where its integration fails.
    pub(super) fn reason(&self, failure: Failure, model: &'static str) -> Reason {
        failed(failure, (self.method, self.tolerance), model)
    }
}

/// The method by which a course is integrated, and why.
#[derive(Clone, Copy, Debug)]
pub(super) struct Choice {
    pub(super) method: Method,
    /// What was missing for a better one.
    pub(super) missing: Option<&'static str>,
    /// Radians of a stiff motion that a step can pass over.
    pub(super) stiffness: Option<f64>,
    /// The rate at which friction takes velocities away, where that is stiff.
    pub(super) friction: Option<f64>,
    /// The method forms `det phi`.
    pub(super) needs_determinant: bool,
    /// Evaluations that the choice and the beginning took.
    pub(super) evaluations: u64,
}

impl Default for Choice {
    fn default() -> Self {
        let method = Method::RungeKutta8;
        Self {
            method,
            missing: None,
            stiffness: None,
            friction: None,
            needs_determinant: false,
            evaluations: 0,
        }
    }
}
