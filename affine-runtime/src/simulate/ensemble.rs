//! Many bodies of one model over the same interval of time.

use core::fmt;

use super::halt::{Setting, Stop};
use super::layout::placement_in;
use super::point::{check, is_clearly_positive};
use super::{DEFAULT_MAX_STEPS, DEFAULT_TOLERANCE, Method, Simulation};
use crate::capability::InLanes;
use crate::frames::Matrix;
use crate::integrate::in_lanes::{Equations, Failing, RungeKutta8InLanes};
use crate::lanes::{Lanes, Widest};
use crate::model::{Model, StateVector};
use crate::state::Phase;

/// Where each body of an ensemble is in the end, or why it did not get there.
pub type Ends<P> = Vec<core::result::Result<P, Stop>>;

/// Many bodies of one model, from their starts to the end of one interval of time.
///
/// ```text
/// let ends = Ensemble::new(&model, starts).until(10.0).tolerance(1e-9).run()?;
/// ```
///
/// Bodies are computed in lanes, [`Widest`] next to one another in the order of the starts, by the Runge-Kutta method of
/// order 8. The bodies of a group share their steps: each has an error of its own in each step, and the worst decides. A
/// body that cannot go on (numbers that are not finite, a collapse, a step that underflows) leaves its group, which starts
/// again with another body in its lane, and is integrated alone: its outcome, an end or a [`Stop`], is that of a
/// [`Simulation`], and the others come to what they would have come to without it. Bodies with a closed form take that,
/// and bodies under a constraint, whose steps are taken on its group, are integrated one by one.
///
/// With the feature `parallel` groups are spread over the threads of the current `rayon` pool. Results are the same bits
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

    /// Largest number of accepted steps of a group or a body.
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
        match self.simulation(start).method(method).run() {
            Ok(run) => Ok(*run.end().1),
            Err(halt) => Err(halt.stop),
        }
    }
}

impl<const N: usize, M: InLanes<N> + Sync> Ensemble<'_, N, M>
where
    M::Point<f64>: Send + Sync,
{
    /// Runs the ensemble: one outcome for each start, in their order.
    ///
    /// # Errors
    /// A [`Setting`] that makes no sense.
    pub fn run(self) -> core::result::Result<Ends<M::Point<f64>>, Setting> {
        self.run_in::<Widest>()
    }

    /// The same in lanes of another number: results agree within the tolerance.
    ///
    /// # Errors
    /// As [`run`](Self::run).
    pub fn run_in<T: Lanes>(self) -> core::result::Result<Ends<M::Point<f64>>, Setting> {
        let Some(first) = self.starts.first() else { return Ok(Vec::new()) };
        let (t_end, _) = self.simulation(*first).settings.checked(&M::DESCRIPTION)?;
        let group = |starts: &[M::Point<f64>]| self.group::<T>(starts, t_end);
        Ok(over_groups(&self.starts, T::LANES, group))
    }

    /// As many bodies as there are lanes, or fewer.
    fn group<T: Lanes>(&self, starts: &[M::Point<f64>], t_end: f64) -> Ends<M::Point<f64>> {
        let apart = |start: &M::Point<f64>| self.apart(start, t_end);
        let mut methods: Vec<Option<Method>> = starts.iter().map(apart).collect();
        loop {
            let members: Vec<usize> = (0..starts.len()).filter(|k| methods[*k].is_none()).collect();
            let together: Vec<M::Point<f64>> = members.iter().map(|k| starts[*k]).collect();
            match self.together::<T>(&together, t_end) {
                Ok(ends) => {
                    let mut ends = ends.into_iter();
                    let outcome = |(start, method): (&M::Point<f64>, &Option<Method>)| match method {
                        // As many ends as there are members.
                        None => ends.next().map_or_else(|| self.alone(*start, Method::RungeKutta8), Ok),
                        Some(method) => self.alone(*start, *method),
                    };
                    return starts.iter().zip(&methods).map(outcome).collect();
                }
                Err(failing) => {
                    // Lanes beyond the members repeat the last of them.
                    for lane in failing {
                        if let Some(member) = members.get(lane).or(members.last()) {
                            methods[*member] = Some(Method::RungeKutta8);
                        }
                    }
                }
            }
        }
    }

    /// The method of a body that is better off alone.
    fn apart(&self, start: &M::Point<f64>, t_end: f64) -> Option<Method> {
        if self.model.geodesic(self.t0, start).is_some() {
            return Some(Method::ClosedForm);
        }
        // The signature of a mass matrix that depends on the placement is looked after step by step.
        let is_special = M::DESCRIPTION.constraint.is_some() || self.model.regularity(start.phi()).is_some();
        let alone = is_special || t_end == self.t0 || check(self.t0, start).is_err();
        alone.then_some(Method::RungeKutta8)
    }

    /// Bodies with the same steps.
    fn together<T: Lanes>(
        &self,
        starts: &[M::Point<f64>],
        t_end: f64,
    ) -> core::result::Result<Vec<M::Point<f64>>, Failing> {
        if starts.is_empty() {
            return Ok(Vec::new());
        }
        let (mut states, mut constants) = (Vec::new(), Vec::new());
        for start in starts {
            let (state, of_trajectory) = self.model.reduce(self.t0, start);
            states.push(state);
            constants.push(of_trajectory);
        }
        let in_lanes = M::constants_in_lanes::<T>(&constants);
        let equations = Reduced { model: self.model, constants: in_lanes };
        let mut state = M::Reduced::<T>::zeros();
        for (k, component) in state.as_mut().iter_mut().enumerate() {
            *component = crate::lanes::gathered(&states, |state| state.as_ref()[k]);
        }
        let groups = M::DESCRIPTION.reduced;
        let mut integration =
            RungeKutta8InLanes::new(equations, groups, (self.t0, state), t_end, self.tolerance)?;
        let placement = placement_in(groups, N);
        while integration.t() != t_end {
            if integration.steps() == self.max_steps {
                return Err((0..starts.len()).collect());
            }
            integration.advance()?;
            if let Some(range) = &placement {
                let entries = &integration.y().as_ref()[range.clone()];
                failing(starts.len(), |lane| {
                    is_clearly_positive(&Matrix::<N>::from_fn(|i, k| entries[N * i + k].lane(lane)))
                })?;
            }
        }
        let ends: Vec<M::Point<f64>> = constants
            .iter()
            .enumerate()
            .map(|(lane, constants)| {
                let mut state = M::Reduced::<f64>::zeros();
                for (component, of_lanes) in state.as_mut().iter_mut().zip(integration.y().as_ref()) {
                    *component = of_lanes.lane(lane);
                }
                self.model.expand(t_end, constants, &state)
            })
            .collect();
        failing(ends.len(), |lane| check(t_end, &ends[lane]).is_ok())?;
        Ok(ends)
    }
}

/// The reduced equations of a group.
struct Reduced<'a, const N: usize, M: InLanes<N>, T: Lanes> {
    model: &'a M,
    constants: M::Constants<T>,
}

impl<const N: usize, M: InLanes<N>, T: Lanes> Equations<T, M::Reduced<T>> for Reduced<'_, N, M, T> {
    #[inline(always)]
    fn slope(&self, t: T, y: &M::Reduced<T>, slope: &mut M::Reduced<T>) {
        self.model.equations_in_lanes(t, &self.constants, y, slope);
    }
}

/// The lanes that are not as they should be, as an error.
fn failing(lanes: usize, is_good: impl Fn(usize) -> bool) -> core::result::Result<(), Failing> {
    let failing: Failing = (0..lanes).filter(|lane| !is_good(*lane)).collect();
    if failing.is_empty() { Ok(()) } else { Err(failing) }
}

/// Group after group.
#[cfg(not(feature = "parallel"))]
fn over_groups<P: Send + Sync>(
    starts: &[P],
    lanes: usize,
    group: impl Fn(&[P]) -> Ends<P> + Send + Sync,
) -> Ends<P> {
    starts.chunks(lanes).flat_map(group).collect()
}

/// Groups on all threads of the pool.
#[cfg(feature = "parallel")]
fn over_groups<P: Send + Sync>(
    starts: &[P],
    lanes: usize,
    group: impl Fn(&[P]) -> Ends<P> + Send + Sync,
) -> Ends<P> {
    use rayon::prelude::*;
    starts.par_chunks(lanes).flat_map_iter(group).collect()
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
