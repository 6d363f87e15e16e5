//! Bodies of an ensemble one after the other through the same lanes.

use super::asked::{Asked, Member, Start};
use super::bodies::{Waiting, Watched};
use super::recording::{Next, Recording};
use crate::capability::InLanes;
use crate::inner::Fate;
use crate::integrate::FusedArithmetic;
use crate::lanes::Lanes;
use crate::model::{Handle, Model};
use crate::simulate::energy::Energy;
use crate::simulate::friction::{is_stiff, rate_of_friction};
use crate::simulate::in_lanes::{Bodies, EIGHT, has_fused_lanes, moving};
use crate::simulate::layout::is_looked_after;
use crate::simulate::method::Method;
use crate::simulate::motion::PointOf;
use crate::simulate::point::is_clearly_positive;
use crate::simulate::run::empty_trajectory;
use crate::simulate::settings::Plan;
use crate::simulate::simulation::Simulation;
use crate::state::Phase;

impl<const N: usize, H: Handle<N>, A> Asked<'_, '_, N, H, A>
where
    H::Model: InLanes<N>,
{
    /// What becomes of bodies, in their order. They go in lanes that are fused as their steps would be alone.
    pub(super) fn of<T: Lanes>(&self, starts: &[Start<N, H>]) -> Vec<Member<PointOf<N, H>, A>> {
        let fuses = starts.first().is_some_and(|start| has_fused_lanes(start.handle.model()));
        match FusedArithmetic::here() {
            FusedArithmetic::InVectors if fuses => self.all_of::<T::Fused>(starts),
            _ => self.all_of::<T>(starts),
        }
    }

    /// The same in lanes of this kind. Those that cannot go on in lanes go alone from their start.
    fn all_of<T: Lanes>(&self, starts: &[Start<N, H>]) -> Vec<Member<PointOf<N, H>, A>> {
        let apart: Vec<Option<Method>> = starts.iter().map(|start| self.apart(start)).collect();
        let mut done: Vec<Option<Member<_, A>>> = starts.iter().map(|_| None).collect();
        self.in_lanes::<T>(starts, &apart, &mut |body, end| {
            (self.tell)();
            done[body] = Some(end);
        });
        let alone = |(start, apart): (&Start<N, H>, Option<Method>)| {
            let body = self.alone(start, apart.unwrap_or(Method::RungeKutta8));
            (self.tell)();
            body
        };
        let done = done.into_iter().zip(starts.iter().zip(apart));
        done.map(|(done, start)| done.unwrap_or_else(|| alone(start))).collect()
    }

    /// Bodies that are not apart, as far as they go in lanes.
    fn in_lanes<T: Lanes>(
        &self,
        starts: &[Start<N, H>],
        apart: &[Option<Method>],
        done: &mut dyn FnMut(usize, Member<PointOf<N, H>, A>),
    ) {
        let models: Vec<_> = starts.iter().map(|start| moving(start.handle.model())).collect();
        let together = starts.iter().enumerate().filter(|(body, _)| apart[*body].is_none());
        let together: Vec<_> =
            together.map(|(body, start)| (body, start.handle.model(), &start.point)).collect();
        let course = (self.plan, self.t_end);
        let mut waiting = Waiting::<N, T, H::Model>::new(course, &together);
        let asked = (self.within_steps, self.has_events);
        let Some((mut watched, bodies)) = Watched::filled(course, asked, &mut waiting) else { return };
        let Some(first) = bodies.iter().flatten().next() else { return };
        let (model, start) = (&models[*first], &starts[*first].point);
        let energy = Energy::at(model, self.plan.t0, start);
        let mut trajectories = vec![empty_trajectory(model, self.plan, start, &energy); EIGHT];
        let recordings =
            trajectories.iter_mut().map(|trajectory| Recording::of_none(self, model, trajectory));
        let mut recordings: Vec<_> = recordings.collect();
        for (recording, body) in recordings.iter_mut().zip(bodies) {
            body.iter().for_each(|body| recording.begin(self, (*body, &starts[*body]), &models[*body]));
        }
        let mut moving = bodies.iter().flatten().count();
        let every_step = self.within_steps || const { Bodies::<N, T, &H::Model>::are_looked_after() };
        while moving > 0 {
            let (mut fates, mut looked_at) = ([Next::Step; EIGHT], [every_step; EIGHT]);
            for (lane, fate) in watched.advance() {
                fates[lane] = if fate == Fate::Arrived { Next::End } else { Next::Alone };
                looked_at[lane] = true;
            }
            if looked_at == [false; EIGHT] {
                continue;
            }
            for lane in 0..EIGHT {
                let recording = &mut recordings[lane];
                if !looked_at[lane] || !recording.has_body() {
                    continue;
                }
                let next = self.next(&mut watched, lane, fates[lane], recording);
                if next == Next::Step {
                    continue;
                }
                let Some((body, folded, trajectory)) = recording.done() else { continue };
                if next == Next::End {
                    let ((t, end), events) = (trajectory.end, core::mem::take(&mut trajectory.events));
                    done(body, Member { number: starts[body].number, end: Ok(end), t, events, folded });
                }
                match waiting.next() {
                    Some(next) => {
                        watched.put(lane, &next);
                        recording.begin(self, (next.body, &starts[next.body]), &models[next.body]);
                    }
                    None => {
                        moving -= 1;
                        watched.bodies.rest(lane);
                    }
                }
            }
        }
    }

    /// How the body in a lane goes on after an attempt of a step.
    fn next<T: Lanes>(
        &self,
        watched: &mut Watched<'_, N, T, H::Model>,
        lane: usize,
        fate: Next,
        recording: &mut Recording<'_, '_, N, PointOf<N, H>, A>,
    ) -> Next {
        let has_stepped = watched.bodies.has_stepped(lane);
        if fate == Next::Alone || (has_stepped && !watched.bodies.stands(lane)) {
            return Next::Alone;
        }
        let t = watched.bodies.t(lane);
        if self.within_steps && has_stepped {
            let events = watched.ends(lane, |ends, turning| recording.look_at(ends, turning));
            let next = recording.step(t, events, &mut watched.bodies.within(lane), self.add);
            if next != Next::Step {
                return next;
            }
        }
        match fate == Next::End && !recording.arrive(t, watched.bodies.reached(lane)) {
            true => Next::Alone,
            false => fate,
        }
    }

    /// The method of a body that is not taken into lanes: with friction that is stiff, with a closed form, or with steps that
    /// have to be looked at.
    fn apart(&self, Start { handle, point, .. }: &Start<N, H>) -> Option<Method> {
        let (model, t0) = (handle.model(), self.plan.t0);
        let rate = rate_of_friction(model, (t0, point)).rate;
        if rate.is_some_and(|rate| is_stiff(rate, self.t_end - t0)) {
            return Some(Method::Radau { stages: None });
        }
        if model.geodesic(t0, point).is_some() {
            return Some(Method::ClosedForm);
        }
        let stands = point.is_finite() && is_clearly_positive(point.phi());
        (is_looked_after(model, point) || self.t_end == t0 || !stands).then_some(Method::RungeKutta8)
    }

    /// One body by itself.
    fn alone(&self, start: &Start<N, H>, method: Method) -> Member<PointOf<N, H>, A> {
        let mut simulation = Simulation::new(start.handle.model(), start.point).by_default(method);
        simulation.settings.plan = Plan { method, ..self.plan.clone() };
        simulation.settings.events = (self.events)();
        let (end, run) = match simulation.run() {
            Ok(run) => (Ok(*run.end().1), run),
            Err(halt) => (Err(halt.stop), *halt.trajectory),
        };
        let mut folded = (self.begin)(start.number, &start.handle);
        run.iter().for_each(|(t, point)| (self.add)(&mut folded, t, point));
        Member { number: start.number, end, t: run.end().0, events: run.events, folded }
    }
}
