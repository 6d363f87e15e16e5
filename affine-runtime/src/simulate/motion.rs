//! A motion of phase points, step by step, whatever is integrated and how.

use super::checkpoint::Bits;
use super::course::{Choice, Course};
use super::layout::Layout;
use super::stepper::Stepper;
use crate::error::Reason;
use crate::integrate::{Failure, Statistics};
use crate::model::{Handle, Model, StateVector};

/// A phase point with the work done since the integration started.
pub(super) type WithWork<P> = (P, f64);

/// What is stepped. It is called a few times for each step, which takes many evaluations of the equations: behind
/// `dyn` that costs nothing that can be measured, and a run is not compiled anew for each integrator.
pub(super) trait Motion<P> {
    /// Takes one step.
    fn advance(&mut self) -> Result<(), Failure>;
    /// At a time within the last step.
    fn between(&mut self, t: f64) -> Result<WithWork<P>, Failure>;
    /// At the time reached.
    fn reached(&self) -> WithWork<P>;
    /// Notes that the state reached is good, without expanding it.
    fn keep(&mut self);
    /// The time of the last good state.
    fn kept_at(&self) -> Option<f64>;
    /// The last good state.
    fn kept(&self) -> Option<(f64, WithWork<P>)>;
    /// Time reached.
    fn t(&self) -> f64;
    /// The placement in the state reached, up to a factor of positive determinant; `None` where the state does not hold
    /// it.
    fn placement(&self) -> Option<&[f64]>;
    /// The end is reached.
    fn is_finished(&self) -> bool;
    /// Cost so far.
    fn statistics(&self) -> Statistics;
    /// Largest residual of implicit steps so far.
    fn residual(&self) -> Option<f64>;
    /// Hands over, or takes back, everything that the next steps depend on.
    fn exchange(&mut self, tape: &mut Bits<'_>);
    /// That is all that they depend on.
    fn is_exchanged(&self) -> bool;
}

/// A motion that goes on after its end, and can begin anew where it is stored, from another point or by other fields of
/// the model.
pub(super) trait Engine<const N: usize, H: Handle<N>>: Motion<PointOf<N, H>> {
    /// Goes on to another end.
    fn aim(&mut self, t_end: f64) -> Result<(), Failure>;
    /// Begins a course.
    fn restart(&mut self, model: &H, course: &Course<'_, PointOf<N, H>>) -> Result<(), Reason>;
}

/// A model with what its motion is begun for: what is not asked of the motion is not compiled.
pub(super) trait Purpose<'a, const N: usize>: Handle<N> + 'a {
    /// What is done with a motion that has begun.
    type Then<'t>
    where
        'a: 't;
    /// What becomes of it.
    type Launched;
    /// Hands over a motion by an integrator that only its beginning knows.
    fn launched(
        motion: impl Engine<N, Self> + 'a,
        goal: Goal<'_, 'a, N, Self>,
    ) -> Result<Self::Launched, Reason>;
}

/// What a motion is begun for, and what is known of its choice.
pub(super) struct Goal<'g, 'a: 'g, const N: usize, H: Purpose<'a, N>> {
    pub(super) choice: &'g mut Choice,
    pub(super) then: H::Then<'g>,
}

/// Follows a motion that was chosen.
pub(super) type Follow<'f, P> = dyn FnMut(&mut dyn Motion<P>, &Choice) -> Result<(), Reason> + 'f;

/// Begins to integrate a model, by integrators that are compiled for it.
pub(super) type Begin<'a, const N: usize, H> =
    fn(&H, &Course<'_, PointOf<N, H>>, Goal<'_, 'a, N, H>) -> Result<Launched<'a, N, H>, Reason>;

/// A model whose motion is followed to one end.
pub(super) struct Followed<'a, M>(pub(super) &'a M);

impl<M> Clone for Followed<'_, M> {
    fn clone(&self) -> Self {
        Self(self.0)
    }
}

impl<const N: usize, M: Model<N>> Handle<N> for Followed<'_, M> {
    type Model = M;
    #[inline(always)]
    fn model(&self) -> &M {
        self.0
    }
}

/// It is followed where it is: a box takes one of seventeen instructions of a run of one step.
impl<'a, const N: usize, M: Model<N>> Purpose<'a, N> for Followed<'a, M> {
    type Then<'t>
        = &'t mut Follow<'t, M::Point<f64>>
    where
        'a: 't;
    type Launched = ();
    fn launched(mut motion: impl Engine<N, Self> + 'a, goal: Goal<'_, 'a, N, Self>) -> Result<(), Reason> {
        (goal.then)(&mut motion, goal.choice)
    }
}

/// A model whose motion goes on from end to end.
#[derive(Clone)]
pub(super) struct Stepping<H>(pub(super) H);

impl<const N: usize, H: Handle<N>> Handle<N> for Stepping<H> {
    type Model = H::Model;
    #[inline(always)]
    fn model(&self) -> &H::Model {
        self.0.model()
    }
}

impl<'a, const N: usize, H: Handle<N> + 'a> Purpose<'a, N> for Stepping<H> {
    type Then<'t>
        = ()
    where
        'a: 't;
    type Launched = Box<dyn Engine<N, Self> + 'a>;
    fn launched(
        motion: impl Engine<N, Self> + 'a,
        _: Goal<'_, 'a, N, Self>,
    ) -> Result<Self::Launched, Reason> {
        Ok(Box::new(motion))
    }
}

/// The phase points of the model that a handle leads to.
pub(super) type PointOf<const N: usize, H> = <<H as Handle<N>>::Model as Model<N>>::Point<f64>;

/// A motion of a model.
pub(super) type Launched<'a, const N: usize, H> = <H as Purpose<'a, N>>::Launched;

/// An integration that has begun.
pub(super) struct Begun<I, E> {
    pub(super) integration: I,
    /// The phase point of a state at a time.
    pub(super) expand: E,
    /// Evaluations spent beside those of the integration.
    pub(super) evaluations: u64,
}

/// A model with the course that it is to take.
pub(super) type At<'c, const N: usize, M, H> = (&'c H, &'c Course<'c, <M as Model<N>>::Point<f64>>);

/// The phase points of a reduced state.
pub(super) fn expansion<const N: usize, M: Model<N>, H: Handle<N, Model = M>>(
    model: &H,
    constants: M::Constants<f64>,
) -> impl Fn(f64, &M::Reduced<f64>) -> M::Point<f64> + use<N, M, H> {
    let model = model.clone();
    move |t, reduced| model.model().expand(t, &constants, reduced)
}

/// An integration at its start, unless that is none.
pub(super) fn begun<const N: usize, M: Model<N>, I, E>(
    course: &Course<'_, M::Point<f64>>,
    integration: Result<I, Failure>,
    expand: E,
) -> Result<Begun<I, E>, Reason> {
    let integration = integration.map_err(|failure| course.reason(failure, M::DESCRIPTION.name))?;
    Ok(Begun { integration, expand, evaluations: 0 })
}

/// An integration of states whose phase points are those of an expansion, with what begins it anew.
struct Running<I, E, B, S> {
    integration: I,
    expand: E,
    begin: B,
    layout: Layout,
    kept: Option<(f64, S)>,
}

/// Begins a course, and hands it over; what was spent besides is added to the evaluations.
pub(super) fn launched<'a, const N: usize, H, S, I, E, B>(
    (model, course): (&H, &Course<'_, PointOf<N, H>>),
    layout: Layout,
    goal: Goal<'_, 'a, N, H>,
    begin: B,
) -> Result<Launched<'a, N, H>, Reason>
where
    H: Purpose<'a, N>,
    S: StateVector<f64> + 'a,
    I: Stepper<S> + 'a,
    E: Fn(f64, &S) -> PointOf<N, H> + 'a,
    B: Fn(&H, &Course<'_, PointOf<N, H>>) -> Result<Begun<I, E>, Reason> + 'a,
{
    let Begun { integration, expand, evaluations } = begin(model, course)?;
    goal.choice.evaluations += evaluations;
    H::launched(Running { integration, expand, begin, layout, kept: None }, goal)
}

impl<const N: usize, H, S, I, E, B> Engine<N, H> for Running<I, E, B, S>
where
    H: Handle<N>,
    S: StateVector<f64>,
    I: Stepper<S>,
    E: Fn(f64, &S) -> PointOf<N, H>,
    B: Fn(&H, &Course<'_, PointOf<N, H>>) -> Result<Begun<I, E>, Reason>,
{
    fn aim(&mut self, t_end: f64) -> Result<(), Failure> {
        self.integration.aim(t_end)
    }
    fn restart(&mut self, model: &H, course: &Course<'_, PointOf<N, H>>) -> Result<(), Reason> {
        let Begun { integration, expand, .. } = (self.begin)(model, course)?;
        (self.integration, self.expand) = (integration, expand);
        self.kept = None;
        Ok(())
    }
}

impl<I, E, B, S> Running<I, E, B, S> {
    fn expanded<P>(&self, t: f64, state: &S) -> WithWork<P>
    where
        S: StateVector<f64>,
        E: Fn(f64, &S) -> P,
    {
        ((self.expand)(t, state), self.layout.work.map_or(0.0, |work| state.as_ref()[work]))
    }
}

impl<I: Stepper<S>, S: StateVector<f64>, E: Fn(f64, &S) -> P, B, P> Motion<P> for Running<I, E, B, S> {
    fn advance(&mut self) -> Result<(), Failure> {
        self.integration.advance()
    }
    fn between(&mut self, t: f64) -> Result<WithWork<P>, Failure> {
        let state = self.integration.between(t)?;
        Ok(self.expanded(t, &state))
    }
    fn reached(&self) -> WithWork<P> {
        self.expanded(self.integration.t(), self.integration.y())
    }
    fn keep(&mut self) {
        self.kept = Some((self.integration.t(), *self.integration.y()));
    }
    fn kept_at(&self) -> Option<f64> {
        self.kept.as_ref().map(|(t, _)| *t)
    }
    fn kept(&self) -> Option<(f64, WithWork<P>)> {
        self.kept.as_ref().map(|(t, state)| (*t, self.expanded(*t, state)))
    }
    fn t(&self) -> f64 {
        self.integration.t()
    }
    fn placement(&self) -> Option<&[f64]> {
        self.layout.placement.clone().map(|range| &self.integration.y().as_ref()[range])
    }
    fn is_finished(&self) -> bool {
        self.integration.is_finished()
    }
    fn statistics(&self) -> Statistics {
        self.integration.statistics()
    }
    fn residual(&self) -> Option<f64> {
        self.integration.residual()
    }
    fn exchange(&mut self, tape: &mut Bits<'_>) {
        self.integration.exchange(tape);
    }
    fn is_exchanged(&self) -> bool {
        self.integration.is_exchanged()
    }
}
