//! The settings of a simulation, checked.

use super::by_radau::tableau;
use super::checkpoint::Checkpoint;
use super::dense::Keep;
use super::event::Event;
use super::mechanics::Mechanics;
use super::method::Method;
use super::output::{Output, Schedule};
use super::progress::{Observe, Watch};
use crate::error::Setting;
use crate::inner::{DEFAULT_MAX_STEPS, HIGHEST_ORDER, LOWEST_ORDER, Sweeps, step_count};
use crate::integrate::gauss::Tableau;
use crate::integrate::rattle::Composition;
use crate::model::{Constraint, Description};
use crate::state::Phase;

/// Tolerance of a simulation that names none.
pub(crate) const DEFAULT_TOLERANCE: f64 = 1e-10;
/// The largest tolerance of bodies whose mass matrix may degenerate at some placements, sums of energies of different frames: a
/// larger error leads motions onto such a placement that only pass near it. `cargo test --test sums near_degenerate` holds random
/// bodies picked for that: with steps of this tolerance all go through, but one that passes a pivot below ten tolerances.
pub(super) const NEAR_DEGENERATE: f64 = 1e-6;

/// The finest tolerance: about four roundings.
const FINEST_TOLERANCE: f64 = 1e-15;

/// The shortest interval that is not empty: quotients by its steps are numbers.
const SHORTEST_INTERVAL: f64 = 1e-300;

/// Refuses an interval that is neither empty nor of a length that is a number.
pub(super) fn long_enough(t0: f64, t_end: f64) -> Result<(), Setting> {
    let length = (t_end - t0).abs();
    match length.is_finite() && (length == 0.0 || length >= SHORTEST_INTERVAL) {
        true => Ok(()),
        false => Err(Setting::Interval { t0, t_end }),
    }
}

/// What a simulation was told.
pub(super) struct Settings<'a, const N: usize, P> {
    pub(super) start: P,
    pub(super) plan: Plan,
    pub(super) progress: Option<Watch<'a>>,
    pub(super) observe: Option<Observe<'a, P>>,
    pub(super) events: Vec<Event<'a, N, P>>,
    pub(super) checkpoint: Option<Checkpoint>,
    /// How what lies between the outputs is kept, where it is.
    pub(super) dense: Option<Keep<N, P>>,
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
        Self { start, plan, progress: None, observe: None, events: Vec::new(), checkpoint: None, dense: None }
    }

    /// The end and the outputs, of settings that make sense for a model.
    pub(super) fn checked(&self, model: &Description) -> Result<(f64, Schedule), Setting> {
        self.events.iter().try_for_each(Event::checked)?;
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
        long_enough(self.t0, t_end)?;
        self.checked_method(model)?;
        self.checked_step(self.t0, t_end)?;
        Ok((t_end, self.output.schedule(self.t0, t_end)?))
    }

    /// Method, tolerance and number of steps make sense for a model.
    pub(super) fn checked_method(&self, model: &Description) -> Result<(), Setting> {
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
            Method::Radau { stages } => {
                tableau(stages, self.tolerance)?;
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
        Ok(())
    }

    /// The length of equal steps makes sense on the way from a time to another.
    pub(super) fn checked_step(&self, t0: f64, t_end: f64) -> Result<(), Setting> {
        match self.method.step() {
            Some(given) if !given.is_finite() || step_count(t0, t_end, given).is_none() => {
                Err(Setting::Step { given, t0, t_end })
            }
            _ => Ok(()),
        }
    }

    /// The tolerance of the integration from a point on. An error of the placement decides whether a motion that passes near
    /// a degenerate mass matrix meets it.
    pub(super) fn tolerance_at<const N: usize, P: Phase<N>>(
        &self,
        model: &dyn Mechanics<N, P>,
        start: &P,
    ) -> f64 {
        let may_degenerate = self.tolerance > NEAR_DEGENERATE && model.regularity(start.phi()).is_some();
        if may_degenerate { NEAR_DEGENERATE } else { self.tolerance }
    }
}
