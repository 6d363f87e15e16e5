//! Events: what a run looks for on its way, and what it does where it finds it.

use core::fmt;

use super::distortion::tells;
use crate::decompose::LinearMap;
use crate::error::{Result, Setting};
use crate::frames::Matrix;
use crate::inner::LogDeterminant;
use crate::metrics::Bases;
use crate::state::Phase;

/// Of time and point; what is looked at in orthonormal bases asks for those of the model.
type Function<'a, const N: usize, P> = Box<dyn Fn(f64, &P, Option<&Bases<N>>) -> f64 + 'a>;
type Change<'a, P> = Box<dyn Fn(f64, &P) -> Result<P> + 'a>;

/// Something that happens where a function of time and phase point, continuous along the motion, changes its sign.
///
/// ```
/// use affine_runtime::prelude::*;
///
/// #[affine_model(dim = 2, kinetic(dalembert = 1, space_translation = 1), potential = x[2] + (tr(G) - 2)^2)]
/// struct Ball;
/// // Closures are read before the simulation tells them what a point is.
/// type Point = <Ball as Model<2>>::Point<f64>;
///
/// let (up, rest) = (Vector::<2>::new(0.0, 1.0), Vector::<2>::zeros());
/// let start = Ball.at_velocity(up, Matrix::<2>::identity(), rest, Matrix::<2>::zeros())?;
/// let bounced = |_: f64, point: &Point| {
///     let p = Vector::<2>::new(point.p()[0], -point.p()[1]);
///     Ball.at_momentum(point.x(), *point.phi(), p, point.pi())
/// };
/// let run = Simulation::new(&Ball, start)
///     .until(5.0)
///     .event(Event::position(2, 0.0).falling().change(bounced))
///     .event(Event::new("top", |_, point: &Point| point.p()[1]).falling())
///     .run()?;
/// let events: Vec<_> = run.events().iter().map(|event| (event.name, (event.t / 2.0f64.sqrt()).round())).collect();
/// assert_eq!(events, [("top", 0.0), ("x", 1.0), ("top", 2.0), ("x", 3.0)]);
/// # Ok::<(), affine_runtime::Error>(())
/// ```
///
/// # What is found
///
/// Changes of sign between samples of the function. Samples are taken at the ends of every step, at three times within it
/// where steps follow the error, and so close together that `|phi_dot| dt <= |phi|/2`, for the velocity at a sample or three
/// quarters of what counted at the one before; with a closed form at outputs, at 400 times in all at least, and so that
/// [`rate`](crate::geodesic::Geodesic::rate)` dt <= 1/2`, whatever the outputs: the body turns by half a radian at most, and its
/// log-stretches change by a half, from one sample to the next. Of a level of `phi` or of its stretches all crossings are found
/// that are further apart than that, by every method, in both directions of time, and in their order. Not guaranteed: an even
/// number of roots closer together, two crossings of a level that is only just reached among them; a function of the time, or of
/// the centre, that changes faster than the placement and the steps; fast oscillations of a stiff dilatation, which adaptive
/// splitting passes over, or which moves in closed form beside steps that are long for it, where its logarithm changes by less
/// than a half. A run in closed form costs two samples or more for each radian, of one evaluation of the motion each; they
/// take no memory, and [`progress`](super::Simulation::progress) is called after every few of them.
///
/// Where steps follow the error, samples within a step are first taken on the cubic through the numbers of the phase points at
/// its ends, with Hamilton's equations there: that asks neither dense output nor a closed form. What it tells counts if the step is
/// short for the motion, that is, if placement, momentum, `x` and `p` each rise by what the trapezoidal rule makes of their rates,
/// up to 1/32 of themselves, and `|phi_dot| dt <= |phi|`; and if each function stays away from zero by 1/8 of what it changes by,
/// or goes through it and does not turn, an event where that direction counts. All other steps are looked at on the dense output,
/// where events are located.
///
/// The time is located on the dense output of the step to the rounding of times: it has the error of the dense output over the
/// rate of the function. The event is at the first floating-point time found at which the sign has changed.
///
/// # Zero
///
/// A function that is zero where the run starts, or where a change has put the point, is decided by where it goes: an event in
/// one direction happens there if the function goes to the other side in that direction, be it at rest or not; in either
/// direction, if it has come from one side and goes to the other, of which at the start of a run nothing is known. Of several
/// events at one time the first that changes the point is followed by the others that still happen from the changed point.
/// A change that makes a function jump over zero is no event.
///
/// An event that [changes](Self::change) the point does not meet itself: its function turns back, or goes on through zero as
/// the change lets it. If the change takes its rate away and the function would go through zero nonetheless, as that of a
/// ball which stays on a floor, or if it happens ever faster, as bounces with a part of the velocity do, the run ends there,
/// [`Reason::Accumulation`](super::Reason::Accumulation). What leaves zero by no more than some roundings of the function, or for
/// no longer than some roundings of the time, has not left it.
///
/// A function that is not a number at the start is looked at from the next sample on; one that is not a number later, at a
/// phase point that is one, ends the run, [`Reason::Event`](super::Reason::Event).
pub struct Event<'a, const N: usize, P> {
    pub(super) name: &'static str,
    pub(super) function: Function<'a, N, P>,
    pub(super) direction: Direction,
    pub(super) action: Action<'a, P>,
    /// An index that no phase point of this dimension has.
    out_of_range: Option<usize>,
    /// A level that is no number, or none of a stretch.
    no_level: Option<f64>,
}

/// Changes of sign that count, as a run meets them: a run backward in time meets a rising function falling.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Direction {
    /// From negative to positive.
    Rising,
    /// From positive to negative.
    Falling,
    /// From either sign to the other.
    #[default]
    Any,
}

/// What a run does at an event, after it has recorded it.
pub(super) enum Action<'a, P> {
    Record,
    Stop,
    Change(Change<'a, P>),
}

/// The name of an event, and other texts of runs that are constants of the program.
pub(super) type Word = &'static str;

/// An event as it happened.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Occurrence<P> {
    /// Name of the event.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::inner::word"))]
    pub name: Word,
    /// Its time.
    #[cfg_attr(feature = "serde", serde(with = "crate::inner::number"))]
    pub t: f64,
    /// The phase point there, before any change.
    pub point: P,
    /// The function rose.
    pub rising: bool,
}

impl<'a, const N: usize, P: Phase<N>> Event<'a, N, P> {
    /// The event that `function` changes its sign in either direction, to be recorded.
    #[must_use]
    pub fn new(name: &'static str, function: impl Fn(f64, &P) -> f64 + 'a) -> Self {
        Self::of(name, move |t, point, _| function(t, point))
    }

    fn of(name: &'static str, function: impl Fn(f64, &P, Option<&Bases<N>>) -> f64 + 'a) -> Self {
        Self {
            name,
            function: Box::new(function),
            direction: Direction::Any,
            action: Action::Record,
            out_of_range: None,
            no_level: None,
        }
    }

    fn at_level(self, value: f64, least: f64) -> Self {
        let is_level = value.is_finite() && value > least;
        Self { no_level: Some(value).filter(|_| !is_level), ..self }
    }

    /// A function of the placement in orthonormal bases.
    fn of_placement(name: &'static str, function: impl Fn(&Matrix<N>) -> f64 + 'a) -> Self {
        Self::of(name, move |_, point, bases| function(point.in_orthonormal(bases).phi()))
    }

    /// `det phi = value`, in orthonormal bases of the model's metrics. With the value 0 the collapse of a body that no potential protects: a run that stops there ends
    /// at a phase point without inverse. Where rounding may make a tenth of the value of `det phi`, the run ends,
    /// [`Reason::Distortion`](super::Reason::Distortion).
    #[must_use]
    pub fn determinant(value: f64) -> Self {
        Self::of_placement("det phi", move |phi| {
            if tells(phi, value) { LogDeterminant::of(phi).to_f64() - value } else { f64::NAN }
        })
        .at_level(value, f64::NEG_INFINITY)
    }

    /// `max_a Q_a = value`, by logarithms, with the model's metrics.
    #[must_use]
    pub fn largest_stretch(value: f64) -> Self {
        Self::stretch("largest stretch", value, |a, b| if a >= b { a } else { b })
    }

    /// `min_a Q_a = value`, by logarithms, with the model's metrics.
    #[must_use]
    pub fn smallest_stretch(value: f64) -> Self {
        Self::stretch("smallest stretch", value, |a, b| if a <= b { a } else { b })
    }

    fn stretch(name: &'static str, value: f64, choice: fn(f64, f64) -> f64) -> Self {
        let logarithm = libm::log(value);
        Self::of_placement(name, move |phi| {
            phi.log_stretches().into_iter().reduce(choice).unwrap_or(f64::NAN) - logarithm
        })
        .at_level(value, 0.0)
    }

    /// `x[i] = value`, `i` from 1.
    #[must_use]
    pub fn position(i: usize, value: f64) -> Self {
        let component = move |point: &P| point.x().iter().nth(i.wrapping_sub(1)).copied();
        let event =
            Self::new("x", move |_, point| component(point).map_or(f64::NAN, |component| component - value));
        let out_of_range = Some(i).filter(|i| !(1..=N).contains(i));
        Self { out_of_range, ..event.at_level(value, f64::NEG_INFINITY) }
    }

    /// The same event with another name.
    #[must_use]
    pub fn named(self, name: &'static str) -> Self {
        Self { name, ..self }
    }

    /// Changes from negative to positive alone, as the run meets them.
    #[must_use]
    pub fn rising(self) -> Self {
        Self { direction: Direction::Rising, ..self }
    }

    /// Changes from positive to negative alone, as the run meets them.
    #[must_use]
    pub fn falling(self) -> Self {
        Self { direction: Direction::Falling, ..self }
    }

    /// The run ends there, and is no failure: [`Trajectory::stopped_by`](super::Trajectory::stopped_by) says so.
    #[must_use]
    pub fn stop(self) -> Self {
        Self { action: Action::Stop, ..self }
    }

    /// The motion goes on from another point: that is reduced anew, and the integration starts again, or the closed form
    /// where the new point has one. An error of `change`, and a point that is none, end the run,
    /// [`Reason::Change`](super::Reason::Change). At a wall `change` turns the rate of the function round;
    /// one that leaves it at rest there ends the run, [`Reason::Accumulation`](super::Reason::Accumulation).
    #[must_use]
    pub fn change(self, change: impl Fn(f64, &P) -> Result<P> + 'a) -> Self {
        Self { action: Action::Change(Box::new(change)), ..self }
    }
}

impl<const N: usize, P> Event<'_, N, P> {
    /// Its function can be what it is held against.
    ///
    /// # Errors
    /// [`Setting::EventIndex`], [`Setting::EventLevel`].
    pub(super) fn checked(&self) -> core::result::Result<(), Setting> {
        let event = self.name;
        match (self.out_of_range, self.no_level) {
            (Some(index), _) => Err(Setting::EventIndex { event, index }),
            (None, Some(given)) => Err(Setting::EventLevel { event, given }),
            (None, None) => Ok(()),
        }
    }
}

impl<const N: usize, P> fmt::Debug for Event<'_, N, P> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let action = match self.action {
            Action::Record => "record",
            Action::Stop => "stop",
            Action::Change(_) => "change",
        };
        f.debug_struct("Event")
            .field("name", &self.name)
            .field("direction", &self.direction)
            .field("action", &action)
            .finish_non_exhaustive()
    }
}
