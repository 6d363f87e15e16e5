//! What a step is held against before it counts: the body keeps its orientation, the mass matrix its signature, and the
//! potential a value.

use super::collapse::{change_of_determinant, failing, first_failure, rate_of_determinant};
use super::distortion::{far_apart, is_nearly_lost, told};
use super::domain::{Domain, has_value};
use super::failed::failed;
use super::friction::is_followed;
use super::mechanics::Mechanics;
use super::method::Method;
use super::motion::Motion;
use super::orientation::{Moment, keeps_orientation, steps_through_zero};
use super::pace::{Pace, likeness};
use super::point::check;
use super::signature::Signature;
use crate::error::Reason;
use crate::integrate::Failure;
use crate::state::Phase;

/// A mass matrix that is made of two entries of `phi^-1` has no digit left in its weakest direction where stretches differ so much
/// that the square of the smallest one is this part of that of the largest: what is no pivot any more,
/// [`Regularity`](crate::model::Regularity).
const HIDDEN: f64 = 64.0 * f64::EPSILON;

/// What is known of a motion where its last step ended.
pub(super) struct Guard<const N: usize> {
    signature: Signature,
    moment: Option<Moment<N>>,
    domain: Option<Domain>,
    pace: Pace,
    /// Where the motion began.
    since: f64,
    /// Method and tolerance that were asked for.
    asked: (Method, f64),
}

impl<const N: usize> Guard<N> {
    /// At the beginning of a motion from the placement of a point to an end.
    ///
    /// # Errors
    /// [`Reason::Domain`] or [`Reason::Energy`] where the potential has no value; [`Reason::Friction`].
    pub(super) fn begin<P: Phase<N>>(
        model: &dyn Mechanics<N, P>,
        motion: &dyn Motion<P>,
        (since, start): (f64, &P),
        t_end: f64,
        asked: (Method, f64),
    ) -> Result<Self, Reason> {
        if t_end > since {
            is_followed(asked.0, || model.rate_of_friction(since, start))?;
        }
        let signature = Signature::of(model.regularity(start.phi()));
        let (passes, description) = (steps_through_zero(model.description(), asked.0), model.description());
        has_value(model, (since, start))?;
        // The state is not expanded for a body that is asked for neither.
        let at = (passes || !description.domain.is_empty()).then(|| (motion.t(), motion.reached().0));
        let moment = at.as_ref().filter(|_| passes).map(|(t, point)| Moment::of(model, (*t, point)));
        let domain = at.as_ref().map(|(t, point)| Domain::at(model, (*t, point))).transpose()?.flatten();
        Ok(Self { signature, moment, domain, pace: Pace::default(), since, asked })
    }

    /// Takes a step.
    ///
    /// # Errors
    /// Why no step leads on, or that the mass matrix has degenerated.
    pub(super) fn advance<P: Phase<N>>(
        &self,
        model: &dyn Mechanics<N, P>,
        motion: &mut dyn Motion<P>,
    ) -> Result<(), Reason> {
        let regularity = |motion: &dyn Motion<P>| model.regularity(motion.reached().0.phi());
        if let Err(failure) = motion.advance() {
            let (t, (point, _)) = (motion.t(), motion.reached());
            let degenerate = self.signature.failing(regularity(motion), t);
            let is_lost = is_nearly_lost(point.phi());
            let degenerate = degenerate.map(|reason| self.by_stretches(model, (t, &point), reason, is_lost));
            let singular = || self.domain.as_ref().and_then(|domain| domain.failing(self.since));
            let collapsing = || self.collapsing(model, (t, &point));
            let other = || self.reason(model, failure);
            return Err(degenerate.or_else(singular).or_else(collapsing).unwrap_or_else(other));
        }
        if !self.signature.may_change() {
            return Ok(());
        }
        self.signature.kept(regularity(motion), motion.t()).map_err(|reason| {
            let (t, (point, _)) = motion.kept().unwrap_or_else(|| (motion.t(), motion.reached()));
            self.by_stretches(model, (t, &point), reason, likeness(model, &point) <= HIDDEN)
        })
    }

    /// What a mass matrix that degenerates after a good point tells: nothing of its coefficients where its pivots are as small as the
    /// stretches there differ and these go on doing so, in a collapse or beyond what doubles hold: where their digits are lost.
    fn by_stretches<P: Phase<N>>(
        &self,
        model: &dyn Mechanics<N, P>,
        (t, point): (f64, &P),
        degenerate: Reason,
        is_lost: bool,
    ) -> Reason {
        let likeness = likeness(model, point);
        let is_flat = matches!(degenerate, Reason::Degenerate { weakest, .. } if likeness <= weakest);
        if !is_flat && !is_lost {
            return degenerate;
        }
        let otherwise = if is_lost { far_apart(point.phi(), t) } else { degenerate };
        self.collapsing(model, (t, point)).unwrap_or(otherwise)
    }

    fn collapsing<P: Phase<N>>(&self, model: &dyn Mechanics<N, P>, at: (f64, &P)) -> Option<Reason> {
        failing(model, at, self.since, self.asked.0.step())
    }

    /// Holds the whole of a step that was taken against what was known before, and goes there, with an end and so many steps
    /// before it. Is the point reached known to be finite and to keep its orientation?
    ///
    /// # Errors
    /// [`Reason::Placement`] where the orientation is lost within it, found again or not; [`Reason::Domain`] or
    /// [`Reason::Energy`] where the potential has no value; [`Reason::Friction`] where that has grown; [`Reason::Placement`] or
    /// [`Reason::Distortion`] where steps are lost in rounding.
    pub(super) fn stands<P: Phase<N>>(
        &mut self,
        model: &dyn Mechanics<N, P>,
        motion: &mut dyn Motion<P>,
        ahead: (f64, u64),
    ) -> Result<bool, Reason> {
        let asked = self.asked;
        let reason = |failure| failed(failure, asked, model.description().name);
        if let Some(begin) = &mut self.moment {
            let (point, _) = motion.reached();
            let end = Moment::of(model, (motion.t(), &point));
            if !begin.clearly_reaches(&end) {
                if !point.is_finite() {
                    return Err(Reason::NotFinite);
                }
                keeps_orientation(model, &mut |t| motion.between(t).map_err(reason), (begin, &end))?;
            }
            *begin = end;
        }
        if let Some(domain) = &mut self.domain {
            domain.keep(model, motion, &reason)?;
        }
        if model.description().custom_potential {
            has_value(model, (motion.t(), &motion.reached().0))?;
        }
        let (t, steps) = (motion.t(), motion.statistics().steps);
        // Each look costs the evaluations of some steps.
        if t > self.since && steps.is_power_of_two() {
            is_followed(asked.0, || model.rate_of_friction(t, &motion.reached().0))?;
        }
        if asked.0.step().is_none() && Pace::is_looked_at(steps) {
            let (point, _) = motion.reached();
            if self.pace.is_lost(model, (t, &point, steps), ahead, asked.1) {
                return Err(self.collapsing(model, (t, &point)).unwrap_or_else(|| far_apart(point.phi(), t)));
            }
        }
        Ok(self.moment.is_some())
    }

    fn reason<P: Phase<N>>(&self, model: &dyn Mechanics<N, P>, failure: Failure) -> Reason {
        failed(failure, self.asked, model.description().name)
    }
}

/// When a body collapses that has collapsed at a time within a step from a good one on.
pub(super) fn collapse<const N: usize, P: Phase<N>>(motion: &mut dyn Motion<P>, good: f64, t: f64) -> f64 {
    first_failure(good, t, |t| motion.between(t).is_ok_and(|(point, _)| check(t, &point).is_ok()))
}

/// The reason with what is known of a collapse after the last good point, or of placements that doubles do not tell. A step in the
/// middle of which there is no time, and over which `det phi` grows, is too long for the motion and the shortest there is.
pub(super) fn explained<const N: usize, P: Phase<N>>(
    model: &dyn Mechanics<N, P>,
    motion: &mut dyn Motion<P>,
    (good, point): (f64, &P),
    reason: Reason,
    asked: (Method, f64),
) -> Reason {
    let rate = rate_of_determinant(model, point);
    let ahead = if motion.t() < good { -1.0 } else { 1.0 };
    let fall = -ahead * change_of_determinant(model, point, rate);
    match told(reason, point.phi(), fall) {
        Reason::Placement { determinant, rate: None, .. }
            if determinant > 0.0 && fall < 0.0 && asked.0.step().is_none() =>
        {
            failed(Failure::StepUnderflow, asked, model.description().name)
        }
        Reason::Placement { determinant, rate: None, t } => {
            Reason::Placement { determinant, rate: Some(rate), t: collapse(motion, good, t) }
        }
        other => other,
    }
}
