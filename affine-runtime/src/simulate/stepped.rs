//! The steps of a body: what integrates it, where it stands, and from where it begins anew.

use super::closed_form::ClosedForm;
use super::course::{Choice, Course};
use super::domain::has_value;
use super::failed::failed;
use super::guard::{Guard, explained};
use super::mechanics::{Mechanics, Moving};
use super::method::Method;
use super::motion::{Goal, Launched, Motion, PointOf, Stepping};
use super::point::{check, check_constraint, is_clearly_positive};
use super::range::in_range;
use super::settings::{Plan, long_enough};
use crate::error::{Reason, Setting};
use crate::frames::Matrix;
use crate::integrate::{Failure, Statistics};
use crate::model::{Constraint, Handle, Model};
use crate::state::Phase;

/// A body that is moved step by step.
pub(super) struct Stepped<'a, const N: usize, H: Handle<N> + 'a> {
    moving: Moving<'a, N, Stepping<H>>,
    plan: Plan,
    way: Way<'a, N, H>,
    guard: Option<Guard<N>>,
    /// The method forms `det phi`.
    needs_determinant: bool,
    /// Where the motion begins anew with the next step: at the start, and where point, model or method were replaced or the
    /// last step failed.
    anew: Option<(f64, PointOf<N, H>)>,
    /// Where the last step began.
    begin: f64,
    /// Cost before the motion last began anew.
    cost: Statistics,
}

/// How it moves.
enum Way<'a, const N: usize, H: Handle<N> + 'a> {
    Steps(Launched<'a, N, Stepping<H>>),
    /// A closed form with the time reached.
    ClosedForm(ClosedForm<N, PointOf<N, H>>, f64),
}

impl<'a, const N: usize, H: Handle<N> + 'a> Stepped<'a, N, H> {
    /// At a start.
    ///
    /// # Errors
    /// Why there is no motion.
    pub(super) fn begin(
        moving: Moving<'a, N, Stepping<H>>,
        plan: Plan,
        start: (f64, PointOf<N, H>),
    ) -> Result<Self, Reason> {
        let mut cost = Statistics::default();
        let (way, needs_determinant) = begun(&moving, &plan, start, &mut cost)?;
        let (guard, anew) = (None, Some(start));
        Ok(Self { moving, plan, way, guard, needs_determinant, anew, begin: start.0, cost })
    }

    /// Moves to a time.
    ///
    /// # Errors
    /// Why it does not get there; it stays at the last good point.
    pub(super) fn move_to(&mut self, t_end: f64) -> Result<(), Reason> {
        let t = self.t();
        if !t_end.is_finite() {
            return Err(Setting::Time { name: "the time to move to", given: t_end }.into());
        }
        long_enough(t, t_end)?;
        if t == t_end {
            return Ok(());
        }
        self.aim(t_end)?;
        let mut left = self.plan.max_steps;
        while self.t() != t_end {
            if left == 0 {
                return Err(Reason::StepLimit { limit: self.plan.max_steps });
            }
            left -= 1;
            self.step(t_end, left)?;
        }
        Ok(())
    }

    /// Turns to an end, from where it is or anew.
    fn aim(&mut self, t_end: f64) -> Result<(), Reason> {
        if let Some(start) = self.anew {
            self.restart(start, t_end)?;
            (self.begin, self.anew) = (start.0, None);
            return Ok(());
        }
        match &mut self.way {
            Way::ClosedForm(motion, _) => {
                *motion = motion.aimed(&self.moving, t_end);
                Ok(())
            }
            Way::Steps(engine) => match engine.aim(t_end) {
                Ok(()) => Ok(()),
                Err(failure) => {
                    let t = engine.t();
                    self.plan.checked_step(t, t_end)?;
                    Err(self.reason(failure))
                }
            },
        }
    }

    /// Begins anew on the way to an end, where it is stored.
    fn restart(&mut self, start: (f64, PointOf<N, H>), t_end: f64) -> Result<(), Reason> {
        self.plan.checked_step(start.0, t_end)?;
        if let Way::ClosedForm(..) = &self.way {
            // From another point there may be none.
            (self.way, self.needs_determinant) = begun(&self.moving, &self.plan, start, &mut self.cost)?;
        }
        let cost = self.statistics();
        let Self { moving, plan, .. } = self;
        match &mut self.way {
            Way::ClosedForm(motion, _) => *motion = motion.aimed(&*moving, t_end),
            Way::Steps(engine) => {
                let (t, point) = (start.0, &start.1);
                if self.needs_determinant {
                    in_range(t, moving.handle.model().orthonormal(point).phi())?;
                }
                let course = course(moving, plan, (t, point), t_end);
                engine.restart(&moving.handle, &course)?;
                self.cost = cost;
                engine.keep();
                let asked = (course.method, course.tolerance);
                let guard = Guard::begin(moving, &**engine, (t, point), t_end, asked);
                self.guard = Some(guard?);
            }
        }
        Ok(())
    }

    /// Takes a step on the way to an end, with so many steps left after it.
    fn step(&mut self, t_end: f64, left: u64) -> Result<(), Reason> {
        let model = &self.moving;
        match (&mut self.way, &mut self.guard) {
            (Way::Steps(engine), Some(guard)) => {
                let motion: &mut dyn Motion<_> = &mut **engine;
                let begin = motion.t();
                let determined = self.needs_determinant.then_some(model.handle.model());
                let stepped = guard
                    .advance(model, motion)
                    .and_then(|()| guard.stands(model, motion, (t_end, left)))
                    .and_then(|is_known| placed::<N, H>(motion, is_known, determined));
                if let Err(reason) = stepped {
                    let (t, (point, _)) = motion.kept().unwrap_or_else(|| (begin, motion.reached()));
                    let reason = explained(
                        model,
                        motion,
                        (t, &point),
                        reason,
                        (self.plan.method, self.plan.tolerance),
                    );
                    self.anew = Some((t, point));
                    return Err(reason);
                }
                motion.keep();
                self.begin = begin;
                Ok(())
            }
            (Way::ClosedForm(motion, t), _) => {
                motion.resolved(t_end)?;
                motion.reached(model, *t, t_end)?;
                (self.begin, *t) = (*t, t_end);
                Ok(())
            }
            (Way::Steps(_), None) => Ok(()),
        }
    }

    /// The phase point at a time within the last step.
    ///
    /// # Errors
    /// [`Setting::OutsideStep`]; the reasons of a step.
    pub(super) fn between(&mut self, t: f64) -> Result<PointOf<N, H>, Reason> {
        let (from, to) = (if self.anew.is_some() { self.t() } else { self.begin }, self.t());
        match &mut self.way {
            _ if t == to => Ok(self.point()),
            _ if !((from <= t && t <= to) || (to <= t && t <= from)) => {
                Err(Setting::OutsideStep { t, from, to }.into())
            }
            Way::ClosedForm(motion, _) => Ok(motion.at(&self.moving, t)),
            Way::Steps(engine) => {
                let between = engine.between(t);
                between.map(|(point, _)| point).map_err(|failure| self.reason(failure))
            }
        }
    }

    /// Puts it elsewhere.
    ///
    /// # Errors
    /// Those of a point that is none, or of a time that is none.
    pub(super) fn put(&mut self, start: (f64, PointOf<N, H>)) -> Result<(), Reason> {
        placed_at(H::Model::DESCRIPTION.constraint, &start)?;
        self.anew = Some(start);
        Ok(())
    }

    /// Replaces the model.
    pub(super) fn replace(&mut self, model: H) {
        self.anew = Some((self.t(), self.point()));
        self.moving.handle = Stepping(model);
    }

    fn reason(&self, failure: Failure) -> Reason {
        failed(failure, (self.plan.method, self.plan.tolerance), self.moving.description().name)
    }

    pub(super) fn t(&self) -> f64 {
        match (&self.anew, &self.way) {
            (Some((t, _)), _) | (None, Way::ClosedForm(_, t)) => *t,
            (None, Way::Steps(engine)) => engine.t(),
        }
    }

    pub(super) fn point(&self) -> PointOf<N, H> {
        match (&self.anew, &self.way) {
            (Some((_, point)), _) => *point,
            (None, Way::ClosedForm(motion, t)) => motion.at(&self.moving, *t),
            (None, Way::Steps(engine)) => engine.reached().0,
        }
    }

    pub(super) fn moving(&self) -> &Moving<'a, N, Stepping<H>> {
        &self.moving
    }

    pub(super) fn plan(&self) -> &Plan {
        &self.plan
    }

    /// Sets the largest number of steps to one time.
    pub(super) fn limit(&mut self, max_steps: u64) {
        self.plan.max_steps = max_steps;
    }

    /// Counts a cost that came before.
    pub(super) fn has_cost(&mut self, cost: Statistics) {
        self.cost = self.cost.and(cost);
    }

    pub(super) fn statistics(&self) -> Statistics {
        match &self.way {
            Way::Steps(engine) if self.guard.is_some() => self.cost.and(engine.statistics()),
            _ => self.cost,
        }
    }
}

/// Refuses a start that is no point, or at no time.
pub(super) fn placed_at<const N: usize, P: Phase<N>>(
    constraint: Option<Constraint>,
    (t, point): &(f64, P),
) -> Result<(), Reason> {
    match t.is_finite() {
        true => check(*t, point).and_then(|()| check_constraint(constraint, point)),
        false => Err(Setting::Time { name: "the time of the start", given: *t }.into()),
    }
}

/// What moves from a start, and whether it forms `det phi`.
fn begun<'a, const N: usize, H: Handle<N> + 'a>(
    moving: &Moving<'a, N, Stepping<H>>,
    plan: &Plan,
    start: (f64, PointOf<N, H>),
    cost: &mut Statistics,
) -> Result<(Way<'a, N, H>, bool), Reason> {
    let (t, point) = start;
    plan.checked_method(moving.description())?;
    placed_at(H::Model::DESCRIPTION.constraint, &start)?;
    has_value(moving, (t, &point))?;
    plan.checked_step(t, t)?;
    match (plan.method, moving.geodesic(t, &point)) {
        (Method::ClosedForm, None) => Err(Setting::NoClosedForm { model: moving.description().name }.into()),
        (Method::Automatic | Method::ClosedForm, Some(geodesic)) => {
            Ok((Way::ClosedForm(ClosedForm::begin(moving, geodesic, start, t), t), false))
        }
        _ => {
            let mut choice = Choice::default();
            let course = course(moving, plan, (t, &point), t);
            let goal = Goal { choice: &mut choice, then: () };
            let engine = (moving.begin)(&moving.handle, &course, goal)?;
            cost.evaluations += choice.evaluations;
            Ok((Way::Steps(engine), choice.needs_determinant))
        }
    }
}

/// What is to be integrated.
fn course<'a, 'p, const N: usize, H: Handle<N> + 'a>(
    moving: &Moving<'a, N, Stepping<H>>,
    plan: &Plan,
    (t0, start): (f64, &'p PointOf<N, H>),
    t_end: f64,
) -> Course<'p, PointOf<N, H>> {
    let tolerance = plan.tolerance_at(moving, start);
    Course { t0, start, t_end, method: plan.method, tolerance, within_steps: false }
}

/// Refuses a placement that does not keep orientation, unless it is known to, or that a method which forms `det phi` cannot.
fn placed<const N: usize, H: Handle<N>>(
    motion: &dyn Motion<PointOf<N, H>>,
    is_known: bool,
    determined: Option<&H::Model>,
) -> Result<(), Reason> {
    let is_good = |phi: &[f64]| is_clearly_positive(&Matrix::<N>::from_row_slice(phi));
    if determined.is_none() && (is_known || motion.placement().is_some_and(is_good)) {
        return Ok(());
    }
    let (t, (point, _)) = (motion.t(), motion.reached());
    check(t, &point)?;
    determined.map_or(Ok(()), |model| in_range(t, model.orthonormal(&point).phi()))
}
