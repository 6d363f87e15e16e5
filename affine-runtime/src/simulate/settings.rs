//! The settings of a simulation, checked.

use super::halt::Setting;
use super::output::Schedule;
use super::{Method, Simulation};
use crate::integrate::gauss::Tableau;
use crate::integrate::rattle::Composition;
use crate::integrate::splitting::Sweeps;
use crate::integrate::step_count;
use crate::integrate::taylor::{HIGHEST_ORDER, LOWEST_ORDER};
use crate::model::{Constraint, Model};

/// The finest tolerance: about four roundings.
const FINEST_TOLERANCE: f64 = 1e-15;

impl<const N: usize, M: Model<N>> Simulation<'_, N, M> {
    pub(super) fn checked_settings(&self) -> Result<(f64, Schedule), Setting> {
        let t_end = self.t_end.ok_or(Setting::NoEnd)?;
        for (name, given) in [("the time of the start", self.t0), ("the time of the end", t_end)] {
            if !given.is_finite() {
                return Err(Setting::Time { name, given });
            }
        }
        if !(FINEST_TOLERANCE..1.0).contains(&self.tolerance) {
            return Err(Setting::Tolerance { given: self.tolerance });
        }
        if self.max_steps == 0 {
            return Err(Setting::NoSteps);
        }
        for event in &self.events {
            if let Some(index) = event.out_of_range {
                return Err(Setting::EventIndex { event: event.name, index });
            }
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
                if M::DESCRIPTION.constraint != Some(Constraint::Isochoric) {
                    return Err(Setting::NotIsochoric { model: M::DESCRIPTION.name });
                }
            }
            Method::Splitting { order, .. } if Sweeps::of_order(order, false).is_none() => {
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
