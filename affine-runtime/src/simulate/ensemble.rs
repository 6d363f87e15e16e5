//! Many bodies over the same interval of time.

mod asked;
mod bodies;
mod chosen;
mod ends;
mod part;
mod recording;
mod saved;

use core::fmt;
use core::ops::Range;
use core::sync::atomic::{AtomicU64, Ordering};

use super::event::Event;
use super::motion::PointOf;
use super::output::{Output, Schedule};
use super::settings::Plan;
use crate::capability::InLanes;
use crate::error::{Setting, Stop};
use crate::lanes::{F64x8, Lanes};
use crate::model::{Handle, Model};
use asked::{Asked, Events, Start};
use chosen::Chosen;

pub use asked::Member;

/// Where each body of an ensemble is in the end, or why it did not get there.
pub type Ends<P> = Vec<core::result::Result<P, Stop>>;

/// Many bodies, from their starts to the end of one interval of time: of one model, or each of a model of its own.
///
/// ```
/// use affine_runtime::model::Owned;
/// use affine_runtime::prelude::*;
///
/// #[affine_model(
///     dim = 2,
///     kinetic(casimir2 = 0.2, body_inertia = 1),
///     potential = neo_hookean(c) + hyperbolic_dilatation(10),
///     emit(lanes),
/// )]
/// #[derive(Clone)]
/// struct Disc { c: f64 }
///
/// let disc = Disc { c: 1.0 }.prepare()?;
/// let start = disc.at_velocity(Matrix::<2>::identity(), Matrix::<2>::new(0.1, 0.5, 0.0, -0.1))?;
///
/// // Ends of ten starts, and the largest stretch on the way for ten values of a field.
/// let starts = (1..=10).map(|k| disc.unflatten(&disc.flatten(&start).map(|y| y * (1.0 + 0.01 * f64::from(k)))));
/// let ends = Ensemble::new(&disc, starts).until(3.0).run()?;
/// assert!(ends.iter().all(Result::is_ok));
///
/// let discs = (1..=10).map(|k| Disc { c: f64::from(k) }.prepare()).collect::<Result<Vec<_>, _>>()?;
/// let mut largest = Vec::new();
/// Ensemble::of(discs.into_iter().map(|disc| (Owned(disc), start)))
///     .until(3.0)
///     .every(0.1)
///     .fold(|_, _| 0.0, |most: &mut f64, _, point| *most = most.max(point.phi().norm()), |body| largest.push(body.folded))?;
/// assert!(largest[0] > largest[9], "the stiffer the smaller");
/// # Ok::<(), affine_runtime::Error>(())
/// ```
///
/// Bodies are computed in lanes, [`F64x8`] at once, by the Runge-Kutta method of order 8. Each is at its own time and takes
/// its own steps, and where one has come to the end, the next takes its lane: every body comes to what
/// [`Method::RungeKutta8`](super::Method::RungeKutta8) gives for it alone, its outputs and events too, bit for bit in strict lanes, whatever its
/// neighbours, lanes, threads and shard. A body that cannot go on (numbers that are not finite, a collapse, a step that
/// underflows, an event that changes the point) leaves its lane and is integrated alone: its outcome, an end or a [`Stop`],
/// is that of a [`Simulation`](super::Simulation). Bodies with a closed form take that, bodies with stiff friction the Radau method, and bodies
/// under a constraint, whose steps are taken on its group, are integrated one by one; so are bodies under a potential that does
/// not have a value everywhere.
///
/// Starts are taken from their iterator as they are needed, some thousand at a time, and are not kept: memory does not grow
/// with their number, but for what a program keeps. An ensemble may be built in one thread and run in another: iterator, events and
/// callbacks are `Send`. With the feature `parallel` bodies are spread over the threads of the
/// current `rayon` pool.
pub struct Ensemble<'a, const N: usize, H: Handle<N>> {
    starts: Box<dyn Iterator<Item = Start<N, H>> + Send + 'a>,
    plan: Plan,
    events: Box<Events<'a, N, PointOf<N, H>>>,
    progress: Box<dyn Fn(u64) + Send + Sync + 'a>,
    chosen: Vec<Chosen>,
}

impl<'a, const N: usize, M: Model<N> + Sync> Ensemble<'a, N, &'a M> {
    /// Bodies of `model` from the phase points `starts` at time 0.
    #[must_use]
    pub fn new<S>(model: &'a M, starts: S) -> Self
    where
        S: IntoIterator<Item = M::Point<f64>>,
        S::IntoIter: Send + 'a,
    {
        Self::of(starts.into_iter().map(move |point| (model, point)))
    }
}

impl<'a, const N: usize, H: Handle<N> + 'a> Ensemble<'a, N, H> {
    /// Bodies, each of a model of its own: lent, `&model`, shared, `Arc`, or kept, [`Owned`](crate::model::Owned).
    ///
    /// A sweep over fields takes the time of as many starts of one model: what equations read of fields stands beside the
    /// constants of each trajectory, in its lane.
    #[must_use]
    pub fn of<S>(bodies: S) -> Self
    where
        S: IntoIterator<Item = (H, PointOf<N, H>)>,
        S::IntoIter: Send + 'a,
    {
        let starts = (0..).zip(bodies).map(|(number, (handle, point))| Start { number, handle, point });
        Self {
            starts: Box::new(starts),
            plan: Plan { output: Output::At(Vec::new()), ..Plan::default() },
            events: Box::new(Vec::new),
            progress: Box::new(|_| {}),
            chosen: Vec::new(),
        }
    }

    /// Time of the start; 0 if not set.
    #[must_use]
    pub fn from(mut self, t0: f64) -> Self {
        self.plan.t0 = t0;
        self
    }

    /// Time of the end, before or after the start. The end is hit exactly.
    #[must_use]
    pub fn until(mut self, t_end: f64) -> Self {
        self.plan.t_end = Some(t_end);
        self
    }

    /// Relative error allowed in each step of each body, as [`Simulation::tolerance`](super::Simulation::tolerance).
    #[must_use]
    pub fn tolerance(mut self, eps: f64) -> Self {
        self.plan.tolerance = eps;
        self
    }

    /// Largest number of accepted steps of a body.
    #[must_use]
    pub fn max_steps(mut self, max_steps: u64) -> Self {
        self.plan.max_steps = max_steps;
        self
    }

    /// Output of every body at exactly these times, as [`Simulation::output`](super::Simulation::output); none if not set.
    #[must_use]
    pub fn output(mut self, times: impl IntoIterator<Item = f64>) -> Self {
        self.plan.output = Output::At(times.into_iter().collect());
        self
    }

    /// Output of every body at the start, then at every `dt > 0`, and at the end.
    #[must_use]
    pub fn every(mut self, dt: f64) -> Self {
        self.plan.output = Output::Every(dt);
        self
    }

    /// The [`Event`]s that every body looks for, made anew for each: sections, first passages. A body whose event changes the
    /// point goes alone.
    #[must_use]
    pub fn events(
        mut self,
        events: impl Fn() -> Vec<Event<'a, N, PointOf<N, H>>> + Send + Sync + 'a,
    ) -> Self {
        self.events = Box::new(events);
        self
    }

    /// Called whenever a body is done, in the thread where it is, with the number of those done so far.
    #[must_use]
    pub fn progress(mut self, callback: impl Fn(u64) + Send + Sync + 'a) -> Self {
        self.progress = Box::new(callback);
        self
    }

    /// A bar on the terminal that shows how many bodies are done, and of how many where the iterator of starts knows.
    #[cfg(feature = "progress")]
    #[must_use]
    pub fn progress_bar(self) -> Self {
        let left = |count: usize| self.chosen.iter().fold(count as u64, |count, chosen| chosen.left(count));
        let count = self.starts.size_hint().1.map(left);
        let bar = count.map_or_else(indicatif::ProgressBar::no_length, indicatif::ProgressBar::new);
        self.progress(move |done| bar.set_position(done))
    }

    /// Every `of`th body, from number `k < of` on: a part for one process of several, or one job of an array. A body keeps
    /// its number and its bits; the bodies of all shards, put in the order of their numbers, are those of the ensemble.
    #[must_use]
    pub fn shard(mut self, k: u64, of: u64) -> Self {
        self.chosen.push(Chosen::Shard { k, of });
        self
    }

    /// The bodies of these numbers alone: one that is to be looked at again, or those that are not done yet. Starts of the
    /// others are passed over, not run; those behind the last number are not asked for, so that starts may be endless.
    #[must_use]
    pub fn numbers(mut self, numbers: Range<u64>) -> Self {
        self.starts = Box::new(self.starts.take(usize::try_from(numbers.end).unwrap_or(usize::MAX)));
        self.chosen.push(Chosen::Numbers(numbers));
        self
    }
}

// The bounds stand on the methods, where the message of a missing `emit(lanes)` is read.
impl<'a, const N: usize, H: Handle<N> + 'a> Ensemble<'a, N, H> {
    /// Runs the ensemble: one outcome for each start, in their order.
    ///
    /// # Errors
    /// A [`Setting`] that makes no sense, also of an ensemble without bodies.
    pub fn run(self) -> core::result::Result<Ends<PointOf<N, H>>, Setting>
    where
        H: Sync,
        H::Model: InLanes<N>,
        PointOf<N, H>: Send + Sync,
    {
        self.run_in::<F64x8>()
    }

    /// The same in lanes of another kind: in [fast](crate::lanes::FastF64x8) ones results that agree within the tolerance.
    ///
    /// # Errors
    /// As [`run`](Self::run).
    pub fn run_in<T: Lanes>(mut self) -> core::result::Result<Ends<PointOf<N, H>>, Setting>
    where
        H: Sync,
        H::Model: InLanes<N>,
        PointOf<N, H>: Send + Sync,
    {
        self.checked()?;
        self.plan.output = Output::At(Vec::new());
        let mut ends = Vec::new();
        let chunk = AT_ONCE * threads();
        self.chunks::<T, (), Setting>(chunk, &|_, _| (), &|(), _, _| (), |parts| {
            ends.reserve(parts.iter().map(Vec::len).sum());
            ends.extend(parts.into_iter().flatten().map(|body| body.end));
            Ok(())
        })?;
        Ok(ends)
    }

    /// Runs the ensemble and hands over each [`Member`] with its outputs, in the order of their numbers.
    ///
    /// # Errors
    /// As [`run`](Self::run).
    pub fn each(
        self,
        each: impl FnMut(Member<PointOf<N, H>, Vec<(f64, PointOf<N, H>)>>),
    ) -> core::result::Result<(), Setting>
    where
        H: Sync,
        H::Model: InLanes<N>,
        PointOf<N, H>: Send + Sync,
    {
        let expected = self.expected_outputs();
        self.fold(|_, _| Vec::with_capacity(expected), |outputs, t, point| outputs.push((t, *point)), each)
    }

    /// The end and the outputs, of settings that make sense.
    fn checked(&self) -> core::result::Result<(f64, Schedule), Setting> {
        self.chosen.iter().try_for_each(Chosen::checked)?;
        (self.events)().iter().try_for_each(Event::checked)?;
        self.plan.checked(&H::Model::DESCRIPTION)
    }

    /// Outputs of a body that comes to the end, as far as it is worth to have room for them at once.
    fn expected_outputs(&self) -> usize {
        let checked = self.checked();
        checked.map_or(0, |(_, schedule)| schedule.len().min(MOST_EXPECTED))
    }

    /// Runs the ensemble and makes something of the outputs of each body as they come, a mean, an extreme, a histogram:
    /// `begin` with number and model, `add` time and point of each output to it. Nothing else is kept of them. `each` is called
    /// with one [`Member`] after the other, in the order of their numbers, from one thread, so that sums over bodies have the
    /// same bits always.
    ///
    /// # Errors
    /// As [`run`](Self::run).
    pub fn fold<A: Send>(
        self,
        begin: impl Fn(u64, &H) -> A + Sync,
        add: impl Fn(&mut A, f64, &PointOf<N, H>) + Sync,
        mut each: impl FnMut(Member<PointOf<N, H>, A>),
    ) -> core::result::Result<(), Setting>
    where
        H: Sync,
        H::Model: InLanes<N>,
        PointOf<N, H>: Send + Sync,
    {
        let chunk = AT_ONCE * threads();
        self.chunks::<F64x8, A, Setting>(chunk, &begin, &add, |parts| {
            parts.into_iter().flatten().for_each(&mut each);
            Ok(())
        })
    }

    /// Runs so many bodies after the other; each time with all of them, in parts.
    fn chunks<T: Lanes, A: Send, E: From<Setting>>(
        self,
        chunk: usize,
        begin: &(dyn Fn(u64, &H) -> A + Sync),
        add: &(dyn Fn(&mut A, f64, &PointOf<N, H>) + Sync),
        mut each: impl FnMut(Vec<Vec<Member<PointOf<N, H>, A>>>) -> core::result::Result<(), E>,
    ) -> core::result::Result<(), E>
    where
        H: Sync,
        H::Model: InLanes<N>,
        PointOf<N, H>: Send + Sync,
    {
        let (t_end, schedule) = self.checked()?;
        let Self { starts, plan, events, progress, chosen } = self;
        let mut starts = starts.filter(|start| chosen.iter().all(|chosen| chosen.has(start.number)));
        let done = AtomicU64::new(0);
        let has_events = !events().is_empty();
        let asked = Asked {
            plan: &plan,
            t_end,
            has_events,
            within_steps: schedule.peek().is_some() || has_events,
            schedule,
            events: &*events,
            begin,
            add,
            tell: &|| progress(done.fetch_add(1, Ordering::Relaxed) + 1),
        };
        let mut bodies = Vec::new();
        loop {
            bodies.clear();
            bodies.extend(starts.by_ref().take(chunk));
            if bodies.is_empty() {
                return Ok(());
            }
            each(in_parts(&bodies, T::LANES, |part| asked.of::<T>(part)))?;
        }
    }
}

/// Bodies that are computed before the next ones are asked for, of each thread: so many that lanes without a body, where a
/// part comes to its end, do not count.
const AT_ONCE: usize = 4096;

/// Outputs of a body for which there is room from the start: bodies may stop early.
const MOST_EXPECTED: usize = 256;

/// There is one.
#[cfg(not(feature = "parallel"))]
fn threads() -> usize {
    1
}

/// Those of the pool.
#[cfg(feature = "parallel")]
fn threads() -> usize {
    rayon::current_num_threads()
}

/// One part after the other: there is one.
#[cfg(not(feature = "parallel"))]
fn in_parts<S: Sync, B: Send>(starts: &[S], _lanes: usize, run: impl Fn(&[S]) -> B + Sync) -> Vec<B> {
    vec![run(starts)]
}

/// Parts of each thread of the pool, of which one may take longer than another.
#[cfg(feature = "parallel")]
const PARTS: usize = 4;

/// Parts on all threads of the pool, each of whole lanes.
#[cfg(feature = "parallel")]
fn in_parts<S: Sync, B: Send>(starts: &[S], lanes: usize, run: impl Fn(&[S]) -> B + Sync) -> Vec<B> {
    use rayon::prelude::*;
    let parts = if threads() == 1 { 1 } else { PARTS * threads() };
    let size = starts.len().div_ceil(parts).next_multiple_of(lanes);
    starts.par_chunks(size).map(&run).collect()
}

impl<const N: usize, H: Handle<N>> fmt::Debug for Ensemble<'_, N, H> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Ensemble")
            .field("model", &H::Model::DESCRIPTION.name)
            .field("plan", &self.plan)
            .finish_non_exhaustive()
    }
}
