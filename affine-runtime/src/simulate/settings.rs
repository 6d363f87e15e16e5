//! The settings of a simulation, checked.

use super::checkpoint::Checkpoint;
use super::event::Event;
use super::output::{Output, Schedule};
use super::{DEFAULT_MAX_STEPS, DEFAULT_TOLERANCE, Method, Observe, Watch};
use crate::error::Setting;
use crate::inner::step_count;
use crate::integrate::gauss::Tableau;
use crate::integrate::rattle::Composition;
use crate::integrate::splitting::Sweeps;
use crate::integrate::taylor::{HIGHEST_ORDER, LOWEST_ORDER};
use crate::model::{Constraint, Description};

/// The finest tolerance: about four roundings.
const FINEST_TOLERANCE: f64 = 1e-15;

/// The shortest interval that is not empty: quotients by its steps are numbers.
const SHORTEST_INTERVAL: f64 = 1e-300;

/// What a simulation was told.
pub(super) struct Settings<'a, const N: usize, P> {
    pub(super) start: P,
    pub(super) plan: Plan,
    pub(super) progress: Option<Watch<'a>>,
    pub(super) observe: Option<Observe<'a, P>>,
    pub(super) events: Vec<Event<'a, N, P>>,
    pub(super) checkpoint: Option<Checkpoint>,
}

/// The part of it that phase points do not enter.
#[derive(Clone, Debug)]
pub(super) struct Plan {
    pub(super) t0: f64,
    pub(super) t_end: Option<f64>,
    pub(super) tolerance: f64,
    pub(super) output: Output,
    pub(super) method: Method,
    pub(super) max_steps: u64,
}

impl Default for Plan {
    fn default() -> Self {
        Self {
            t0: 0.0,
            t_end: None,
            tolerance: DEFAULT_TOLERANCE,
            output: Output::Steps,
            method: Method::Automatic,
            max_steps: DEFAULT_MAX_STEPS,
        }
    }
}

impl<const N: usize, P> Settings<'_, N, P> {
    pub(super) fn new(start: P) -> Self {
        let plan = Plan::default();
        Self { start, plan, progress: None, observe: None, events: Vec::new(), checkpoint: None }
    }

    /// The end and the outputs, of settings that make sense for a model.
    pub(super) fn checked(&self, model: &Description) -> Result<(f64, Schedule), Setting> {
        for event in &self.events {
            if let Some(index) = event.out_of_range {
                return Err(Setting::EventIndex { event: event.name, index });
            }
        }
        self.plan.checked(model)
    }
}

impl Plan {
    pub(super) fn checked(&self, model: &Description) -> Result<(f64, Schedule), Setting> {
        let t_end = self.t_end.ok_or(Setting::NoEnd)?;
        for (name, given) in [("the time of the start", self.t0), ("the time of the end", t_end)] {
            if !given.is_finite() {
                return Err(Setting::Time { name, given });
            }
        }
        let length = (t_end - self.t0).abs();
        if !length.is_finite() || length > 0.0 && length < SHORTEST_INTERVAL {
            return Err(Setting::Interval { t0: self.t0, t_end });
        }
        if !(FINEST_TOLERANCE..1.0).contains(&self.tolerance) {
            return Err(Setting::Tolerance { given: self.tolerance });
        }
        if self.max_steps == 0 {
            return Err(Setting::NoSteps);
        }
        match self.method {
            Method::Taylor { order: Some(given) } if !(LOWEST_ORDER..=HIGHEST_ORDER).contains(&given) => {
                return Err(Setting::Order { given });
            }
            Method::Gauss { stages, .. } => {
                Tableau::of_stages(stages).ok_or(Setting::Stages { given: stages })?;
            }
            Method::Rattle { order, .. } => {
                Composition::of_order(order).ok_or(Setting::Order { given: order })?;
                if model.constraint != Some(Constraint::Isochoric) {
                    return Err(Setting::NotIsochoric { model: model.name });
                }
            }
            Method::Splitting { order, .. } | Method::AdaptiveSplitting { order: Some(order) }
                if Sweeps::of_order(order, false).is_none() =>
            {
                return Err(Setting::Order { given: order });
            }
            _ => {}
        }
        if let Some(step) = self.method.step()
            && (!step.is_finite() || step_count(self.t0, t_end, step).is_none())
        {
            return Err(Setting::Step { given: step, t0: self.t0, t_end });
        }
        Ok((t_end, self.output.schedule(self.t0, t_end)?))
    }
}
