//! A computed trajectory.

use core::fmt;

use super::checkpoint::Checkpoint;
use super::dense::Dense;
use super::event::{Occurrence, Word};
use super::method::Method;
use crate::error::{Setting, Stop};
use crate::integrate::{FusedArithmetic, Statistics};
use crate::metrics::Bases;
use crate::model::Description;
use crate::state::Phase;

/// Phase points over time, with how they were computed and what they should conserve.
#[derive(Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Trajectory<const N: usize, P> {
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::inner::constant"))]
    pub(super) description: &'static Description,
    #[cfg_attr(feature = "serde", serde(with = "crate::inner::number"))]
    pub(super) start: (f64, P),
    #[cfg_attr(feature = "serde", serde(with = "crate::inner::number"))]
    pub(super) end: (f64, P),
    #[cfg_attr(feature = "serde", serde(with = "crate::inner::number"))]
    pub(super) times: Vec<f64>,
    pub(super) points: Vec<P>,
    /// Energies of these points; the trajectory does not keep the model to compute them later.
    pub(super) energies: Energies,
    pub(super) statistics: Statistics,
    pub(super) computation: Computation,
    pub(super) events: Vec<Occurrence<P>>,
    /// Name of the event that ended the run.
    #[cfg_attr(feature = "serde", serde(default, deserialize_with = "crate::inner::optional_word"))]
    pub(super) stopped_by: Option<Word>,
    pub(super) checkpoint: Option<Box<Checkpoint>>,
    /// Bases in which the model's metrics are the identity.
    #[cfg_attr(feature = "serde", serde(default, with = "super::written"))]
    pub(super) bases: Option<Box<Bases<N>>>,
    /// What lies between the outputs, where that was asked for.
    #[cfg_attr(feature = "serde", serde(skip, default = "Option::default"))]
    pub(super) dense: Option<Box<Dense<N, P>>>,
}

/// How a trajectory was computed.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Computation {
    /// What was asked for.
    pub asked: Method,
    /// What ran: never [`Method::Automatic`].
    pub method: Method,
    /// Tolerance of the integration: what was asked for, or 1e-6 where that is smaller and
    /// the mass matrix may degenerate on the way.
    #[cfg_attr(feature = "serde", serde(with = "crate::inner::number"))]
    pub tolerance: f64,
    /// What was asked for.
    #[cfg_attr(feature = "serde", serde(with = "crate::inner::number"))]
    pub tolerance_asked: f64,
    /// The start has a closed form.
    pub closed_form_exists: bool,
    /// The skew factor of the closed form drops out: no vorticity (body frame) or no spin (space frame).
    pub no_whirl: bool,
    /// `p = 0` at the start.
    pub at_rest: bool,
    /// What `emit(...)` would have to list for the method that [`Method::Automatic`] would rather take.
    #[cfg_attr(feature = "serde", serde(default, deserialize_with = "crate::inner::optional_word"))]
    pub missing: Option<Word>,
    /// How many radians of the fastest motion a step by pieces can be long, where that is why [`Method::Automatic`] takes
    /// [`Method::AdaptiveSplitting`]; where pieces were not emitted and it took 512 explicit steps or more, how many it would
    /// try with them.
    #[cfg_attr(feature = "serde", serde(default, with = "crate::inner::number"))]
    pub stiffness: Option<f64>,
    /// The rate at which friction takes velocities away, or up to four percent more, where that is why [`Method::Automatic`] takes [`Method::Radau`].
    #[cfg_attr(feature = "serde", serde(default, with = "crate::inner::number"))]
    pub friction: Option<f64>,
    /// From when on, where another method took the motion there.
    #[cfg_attr(feature = "serde", serde(default, with = "crate::inner::number"))]
    pub stiff_since: Option<f64>,
    /// Where multiply-adds were fused on the machine on which the run was interrupted, if that is not as here.
    pub fused_before: Option<FusedArithmetic>,
    /// Condition number of a kinetic energy whose coefficients are fields, [`Model::condition`](crate::model::Model::condition),
    /// at the start; `None` where they are numbers, which were checked when the model was compiled.
    #[cfg_attr(feature = "serde", serde(default, with = "crate::inner::number"))]
    pub condition: Option<f64>,
    /// Largest relative residual of the equations of implicit steps; `None` where the method is explicit.
    #[cfg_attr(feature = "serde", serde(default, with = "crate::inner::number"))]
    pub residual: Option<f64>,
    /// Largest `|H(t) - H(t0) - W(t)|` over the outputs and the end, relative to the largest `|T| + |U|` met by then, where that
    /// is more than 1e4 tolerances and more than an error of ten tolerances in the placement is worth, or more than a tenth and more
    /// than a change of the placement by 1e-7 of itself is worth; 0 elsewhere, where the energy is neither conserved nor balanced by a
    /// work, and where steps are too long to follow a friction. Where the energy is balanced by a work, each step may lose that much,
    /// and what an error of the momenta is worth that moves the body by ten tolerances of its size within it. An event that
    /// changes the point starts it anew.
    #[cfg_attr(feature = "serde", serde(with = "crate::inner::number"))]
    pub energy_defect: f64,
    /// How many times the largest `|T| + |U|` met the forces that no potential has would take or give within one of the equal
    /// steps, at the output where that is most; 0 up to 10, and for methods in other steps. The stages of collocation close a
    /// balance of energy and work on a motion that is not resolved, too.
    #[cfg_attr(feature = "serde", serde(with = "crate::inner::number"))]
    pub unresolved_power: f64,
    /// The largest part of a turn that an angle of the potential, such as `w*t` in `cos(w*t)`, makes by the time alone within one
    /// step, with that part of the potential; `None` where there is no such angle, and in a run that takes no steps. A resumed run
    /// knows only the steps of its own part.
    #[cfg_attr(feature = "serde", serde(default, with = "crate::inner::number"))]
    pub turns: Option<(&'static str, f64)>,
    /// `|det phi|` at the end over the sum of the sizes of the products that it is made of: what is left of its digits.
    #[cfg_attr(feature = "serde", serde(with = "crate::inner::number"))]
    pub distinctness: f64,
}

#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Energies {
    #[cfg_attr(feature = "serde", serde(with = "crate::inner::number"))]
    pub(super) start: f64,
    #[cfg_attr(feature = "serde", serde(with = "crate::inner::number"))]
    pub(super) end: f64,
    #[cfg_attr(feature = "serde", serde(with = "crate::inner::number"))]
    pub(super) outputs: Vec<f64>,
    /// Work of the forces that no potential has, at the outputs and at the end; zero where there are none.
    #[cfg_attr(feature = "serde", serde(with = "crate::inner::number"))]
    pub(super) work: Vec<f64>,
    #[cfg_attr(feature = "serde", serde(with = "crate::inner::number"))]
    pub(super) work_at_end: f64,
    /// Largest of `|H|` and `(|Pi| |phi_dot| + |p| |x_dot|)/2`, which bounds the kinetic energy whatever its sign.
    #[cfg_attr(feature = "serde", serde(with = "crate::inner::number"))]
    pub(super) scale: f64,
}

impl<const N: usize, P: Phase<N>> Trajectory<N, P> {
    /// The output times.
    #[must_use]
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// The phase points at the output times.
    #[must_use]
    pub fn points(&self) -> &[P] {
        &self.points
    }

    /// Output times with their phase points.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = (f64, &P)> + DoubleEndedIterator {
        self.times.iter().copied().zip(&self.points)
    }

    /// Number of outputs.
    #[must_use]
    pub fn len(&self) -> usize {
        self.times.len()
    }

    /// There are no outputs.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.times.is_empty()
    }

    /// Time and phase point of the start, an output or not.
    #[must_use]
    pub fn start(&self) -> (f64, &P) {
        (self.start.0, &self.start.1)
    }

    /// Time and phase point reached last, an output or not.
    #[must_use]
    pub fn end(&self) -> (f64, &P) {
        (self.end.0, &self.end.1)
    }

    /// The phase point at any time of a run that was asked to be [`dense`](super::Simulation::dense), an output or not: within a
    /// third of the tolerance of what an output there would be, or of what some ten roundings of the time make of that, and the
    /// same where a step ends or a closed form is known. At the time of an event that changes the point, the point before.
    ///
    /// # Errors
    /// A [`Stop`] with [`Setting::NotDense`] for a run that was not asked to be, and with [`Setting::OutsideRun`] for a time
    /// before its start, or that of the part that was resumed, or behind its end, wherever that was. With [`Setting::NotKept`]
    /// for a time at which the motion could not be kept as closely.
    pub fn at(&self, t: f64) -> Result<P, Stop> {
        let refused =
            |setting: Setting| Stop { reason: setting.into(), t: self.end.0, steps: self.statistics.steps };
        let dense = self.dense.as_deref().ok_or_else(|| refused(Setting::NotDense { t }))?;
        match t == self.start.0 && t == dense.interval().0 {
            true => Ok(self.start.1),
            false => dense.at(t, self.bases.as_deref()).map_err(refused),
        }
    }

    /// Start, outputs and end, each time once, in orthonormal bases.
    #[cfg(any(feature = "gltf", feature = "report"))]
    pub(crate) fn samples(&self) -> Vec<(f64, P::InOrthonormal)> {
        let mut samples: Vec<(f64, P::InOrthonormal)> = Vec::with_capacity(self.len() + 2);
        for (t, point) in core::iter::once(self.start()).chain(self.iter()).chain([self.end()]) {
            if samples.last().is_none_or(|last| last.0 != t) {
                samples.push((t, self.orthonormal(point)));
            }
        }
        samples
    }

    /// The events in the order in which they happened.
    #[must_use]
    pub fn events(&self) -> &[Occurrence<P>] {
        &self.events
    }

    /// Name of the event that ended the run, if one did.
    #[must_use]
    pub fn stopped_by(&self) -> Option<&'static str> {
        self.stopped_by
    }

    /// Where the run can go on, with [`Simulation::resume`](super::Simulation::resume): of a run that a callback, an
    /// event or the largest number of steps has ended. None for a stiff run of Gauss collocation, whose steps depend on
    /// the factors of a Jacobian.
    #[must_use]
    pub fn checkpoint(&self) -> Option<&Checkpoint> {
        self.checkpoint.as_deref()
    }

    /// Energies `H` at the output times.
    #[must_use]
    pub fn energies(&self) -> &[f64] {
        &self.energies.outputs
    }

    /// What the computation cost; nothing is counted for a closed form.
    #[must_use]
    pub fn statistics(&self) -> Statistics {
        self.statistics
    }

    /// How the trajectory was computed; [`why`](Self::why) says it in words.
    #[must_use]
    pub fn computation(&self) -> Computation {
        self.computation
    }

    /// What was derived about the model.
    #[must_use]
    pub fn description(&self) -> &Description {
        self.description
    }
}

impl<const N: usize, P: fmt::Debug> fmt::Debug for Trajectory<N, P> {
    /// Without the outputs, of which there may be millions.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Trajectory")
            .field("model", &self.description.name)
            .field("start", &self.start)
            .field("end", &self.end)
            .field("outputs", &self.times.len())
            .field("events", &self.events.len())
            .field("statistics", &self.statistics)
            .field("method", &self.computation.method)
            .finish_non_exhaustive()
    }
}
