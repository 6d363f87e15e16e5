//! Many bodies of one model over the same interval of time.

mod bodies;

use core::fmt;

use super::friction::{is_stiff, rate_of_friction};
use super::layout::placement_in;
use super::mechanics::Moving;
use super::method::Method;
use super::methods::automatic;
use super::motion::{Followed, WithWork};
use super::orientation::passes_through_zero;
use super::point::is_clearly_positive;
use super::settings::{DEFAULT_MAX_STEPS, DEFAULT_TOLERANCE, Plan};
use super::simulation::Simulation;
use super::witness::Witness;
use crate::capability::InLanes;
use crate::error::Setting;
use crate::error::Stop;
use crate::lanes::{Lanes, Widest};
use crate::model::Model;
use crate::state::Phase;
use bodies::{Bodies, Common, Done, begun};

/// Where each body of an ensemble is in the end, or why it did not get there.
pub type Ends<P> = Vec<core::result::Result<P, Stop>>;

/// Many bodies of one model, from their starts to the end of one interval of time.
///
/// ```text
/// let ends = Ensemble::new(&model, starts).until(10.0).tolerance(1e-9).run()?;
/// ```
///
/// Bodies are computed in lanes, [`Widest`] at once, by the Runge-Kutta method of order 8. Each is at its own time and takes
/// its own steps, and where one has come to the end, the next takes its lane: every body comes to what
/// [`Method::RungeKutta8`] gives for it alone, bit for bit in strict lanes, whatever its neighbours and their number. A body
/// that cannot go on (numbers that are not finite, a collapse, a step that underflows) leaves its lane and is integrated
/// alone: its outcome, an end or a [`Stop`], is that of a [`Simulation`]. Bodies with a closed form take that, and bodies
/// under a constraint, whose steps are taken on its group, are integrated one by one; so are bodies in a flat metric whose
/// potential does not know `q`, of which every step is looked at whether `det phi` stays positive within it, and bodies under
/// a potential that does not have a value everywhere.
///
/// With the feature `parallel` bodies are spread over the threads of the current `rayon` pool. Results are the same bits
/// for any number of threads.
pub struct Ensemble<'a, const N: usize, M: Model<N>> {
    model: &'a M,
    starts: Vec<M::Point<f64>>,
    t0: f64,
    t_end: Option<f64>,
    tolerance: f64,
    max_steps: u64,
}

impl<'a, const N: usize, M: Model<N>> Ensemble<'a, N, M> {
    /// Bodies of `model` from the phase points `starts` at time 0.
    #[must_use]
    pub fn new(model: &'a M, starts: impl IntoIterator<Item = M::Point<f64>>) -> Self {
        Self {
            model,
            starts: starts.into_iter().collect(),
            t0: 0.0,
            t_end: None,
            tolerance: DEFAULT_TOLERANCE,
            max_steps: DEFAULT_MAX_STEPS,
        }
    }

    /// Time of the start; 0 if not set.
    #[must_use]
    pub fn from(self, t0: f64) -> Self {
        Self { t0, ..self }
    }

    /// Time of the end, before or after the start. The end is hit exactly.
    #[must_use]
    pub fn until(self, t_end: f64) -> Self {
        Self { t_end: Some(t_end), ..self }
    }

    /// Relative error allowed in each step of each body, as [`Simulation::tolerance`].
    #[must_use]
    pub fn tolerance(self, eps: f64) -> Self {
        Self { tolerance: eps, ..self }
    }

    /// Largest number of accepted steps of a body.
    #[must_use]
    pub fn max_steps(self, max_steps: u64) -> Self {
        Self { max_steps, ..self }
    }

    fn simulation(&self, start: M::Point<f64>) -> Simulation<'a, N, M> {
        let simulation = Simulation::new(self.model, start).from(self.t0);
        let simulation = simulation.tolerance(self.tolerance).max_steps(self.max_steps).output([]);
        match self.t_end {
            Some(t_end) => simulation.until(t_end),
            None => simulation,
        }
    }

    /// One body by itself.
    fn alone(&self, start: M::Point<f64>, method: Method) -> core::result::Result<M::Point<f64>, Stop> {
        match self.simulation(start).by_default(method).run() {
            Ok(run) => Ok(*run.end().1),
            Err(halt) => Err(halt.stop),
        }
    }
}

// The bounds stand on the methods, where the message of a missing `emit(lanes)` is read.
impl<const N: usize, M: Model<N>> Ensemble<'_, N, M> {
    /// Runs the ensemble: one outcome for each start, in their order.
    ///
    /// # Errors
    /// A [`Setting`] that makes no sense, also of an ensemble without bodies.
    pub fn run(self) -> core::result::Result<Ends<M::Point<f64>>, Setting>
    where
        M: InLanes<N> + Sync,
        M::Point<f64>: Send + Sync,
    {
        self.run_in::<Widest>()
    }

    /// The same in lanes of another number, a multiple of eight, or of another kind: in strict lanes the same bits, in
    /// [fast](crate::lanes::FastF64x8) ones results that agree within the tolerance.
    ///
    /// # Errors
    /// As [`run`](Self::run).
    pub fn run_in<T: Lanes>(self) -> core::result::Result<Ends<M::Point<f64>>, Setting>
    where
        M: InLanes<N> + Sync,
        M::Point<f64>: Send + Sync,
    {
        let Self { model, t0, t_end, tolerance, max_steps, .. } = self;
        let plan = Plan { t0, t_end, tolerance, max_steps, ..Plan::default() };
        let (t_end, _) = plan.checked(&M::DESCRIPTION)?;
        if self.starts.is_empty() {
            return Ok(Vec::new());
        }
        let may_be_stiff = self.starts.first().is_some_and(|first| {
            let time = PART_OF_STIFF * (t_end - t0);
            rate_of_friction(model, (t0, first)).rate.is_some_and(|rate| is_stiff(rate, time))
        });
        Ok(in_parts(&self.starts, T::LANES, |starts| self.ends::<T>(starts, t_end, may_be_stiff)))
    }
}

impl<const N: usize, M: InLanes<N>> Ensemble<'_, N, M> {
    /// Bodies one after the other through the same lanes, but for those that are apart. Where a body that cannot go on in
    /// lanes comes to, and why it stops, is found alone.
    fn ends<T: Lanes>(
        &self,
        starts: &[M::Point<f64>],
        t_end: f64,
        may_be_stiff: bool,
    ) -> Ends<M::Point<f64>> {
        let apart = |start| self.stiff(start, t_end, may_be_stiff).or_else(|| self.apart(start, t_end));
        let apart: Vec<Option<Method>> = starts.iter().map(apart).collect();
        let together = starts.iter().enumerate().filter(|(body, _)| apart[*body].is_none());
        let together: Vec<_> = together.collect();
        let &Self { model, t0, tolerance, max_steps, .. } = self;
        let common = Common { model, t0, t_end, tolerance, max_steps };
        let mut begun = together.chunks(T::LANES).flat_map(|points| begun::<N, T, M>(common, points));
        let mut ends = vec![None; starts.len()];
        if let Some(first) = begun.next() {
            let mut bodies = Bodies::<N, T, M>::filled(common, first, &mut begun);
            while bodies.are_moving() {
                for Done { lane, body, end } in bodies.advance() {
                    ends[body] =
                        end.filter(|end| self.keeps(&starts[body], (t_end, end))).map(|(end, _)| end);
                    match begun.next() {
                        Some(next) => bodies.put(lane, &next),
                        None => bodies.rest(lane),
                    }
                }
            }
        }
        let alone = |body: usize| self.alone(starts[body], apart[body].unwrap_or(Method::RungeKutta8));
        ends.into_iter().enumerate().map(|(body, end)| end.map_or_else(|| alone(body), Ok)).collect()
    }

    /// The method of a body whose friction is stiff.
    fn stiff(&self, start: &M::Point<f64>, t_end: f64, may_be_stiff: bool) -> Option<Method> {
        if !may_be_stiff {
            return None;
        }
        let rate = rate_of_friction(self.model, (self.t0, start)).rate?;
        is_stiff(rate, t_end - self.t0).then_some(Method::Radau { stages: None })
    }

    /// The method of a body that is not taken into lanes: with a closed form, or with steps that have to be looked at.
    fn apart(&self, start: &M::Point<f64>, t_end: f64) -> Option<Method> {
        if self.model.geodesic(self.t0, start).is_some() {
            return Some(Method::ClosedForm);
        }
        let is_placed = const { placement_in(M::DESCRIPTION.reduced, N).is_some() };
        // The signature of a mass matrix that depends on the placement is looked after step by step, as the domain of a
        // potential is, and the orientation of a body that nothing keeps from losing it within them.
        let is_special = M::DESCRIPTION.constraint.is_some()
            || !M::DESCRIPTION.domain.is_empty()
            || self.model.regularity(start.phi()).is_some()
            || passes_through_zero(&M::DESCRIPTION);
        let alone = !is_placed || is_special || t_end == self.t0 || !self.is_sound(self.t0, start);
        alone.then_some(Method::RungeKutta8)
    }

    /// A phase point needs no second look.
    fn is_sound(&self, t: f64, point: &M::Point<f64>) -> bool {
        let stands = point.is_finite() && is_clearly_positive(point.phi());
        stands && self.model.hamiltonian(t, point).is_finite()
    }

    /// Nor does the energy of a motion that ends at one.
    fn keeps(&self, start: &M::Point<f64>, (t_end, (end, work)): (f64, &WithWork<M::Point<f64>>)) -> bool {
        let model = &Moving { handle: Followed(self.model), begin: automatic };
        let energy = |t: f64, point| self.model.hamiltonian(t, point);
        let mut witness =
            Witness::begin(model, (energy(self.t0, start), 0.0), (start, 0.0), Some(self.tolerance));
        self.is_sound(t_end, end) && witness.look(model, (t_end, end), (energy(t_end, end), *work)).is_ok()
    }
}

/// Friction is looked at body by body where that of the first one is stiff in a hundred times the time: what it does to a
/// body depends on its placement, but not that much.
const PART_OF_STIFF: f64 = 100.0;

/// One part after the other: there is one.
#[cfg(not(feature = "parallel"))]
fn in_parts<P: Send + Sync>(
    starts: &[P],
    _lanes: usize,
    ends: impl Fn(&[P]) -> Ends<P> + Send + Sync,
) -> Ends<P> {
    ends(starts)
}

/// Parts of each thread of the pool, of which one may take longer than another.
#[cfg(feature = "parallel")]
const PARTS: usize = 4;

/// Parts on all threads of the pool, each of whole lanes.
#[cfg(feature = "parallel")]
fn in_parts<P: Send + Sync>(
    starts: &[P],
    lanes: usize,
    ends: impl Fn(&[P]) -> Ends<P> + Send + Sync,
) -> Ends<P> {
    use rayon::prelude::*;
    let threads = rayon::current_num_threads();
    let parts = if threads == 1 { 1 } else { PARTS * threads };
    let size = starts.len().div_ceil(parts).next_multiple_of(lanes);
    starts.par_chunks(size).flat_map_iter(ends).collect()
}

impl<const N: usize, M: Model<N>> fmt::Debug for Ensemble<'_, N, M> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Ensemble")
            .field("model", &M::DESCRIPTION.name)
            .field("bodies", &self.starts.len())
            .field("t0", &self.t0)
            .field("t_end", &self.t_end)
            .field("tolerance", &self.tolerance)
            .field("max_steps", &self.max_steps)
            .finish()
    }
}
