//! Settings of a run that make no sense.

use core::fmt;

use super::debug_as_displayed;
use super::time::Time;
use crate::divisor::{HIGHEST_ORDER, LOWEST_ORDER};
use crate::quantity::Word;

/// A setting of a simulation that makes no sense.
#[derive(Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Setting {
    /// No end time was given.
    NoEnd,
    /// A time is not finite.
    Time {
        /// Name of the time in the settings.
        #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::interned::word"))]
        name: Word,
        /// Its value.
        #[cfg_attr(feature = "serde", serde(with = "crate::interned::number"))]
        given: f64,
    },
    /// The interval is so short, or so long, that numbers in it are not: its length is 0, or at least 1e-300 and a double.
    Interval {
        /// Start of the interval.
        #[cfg_attr(feature = "serde", serde(with = "crate::interned::number"))]
        t0: f64,
        /// End of the interval.
        #[cfg_attr(feature = "serde", serde(with = "crate::interned::number"))]
        t_end: f64,
    },
    /// The tolerance is not in `1e-15 <= eps < 1`.
    Tolerance {
        /// Its value.
        #[cfg_attr(feature = "serde", serde(with = "crate::interned::number"))]
        given: f64,
    },
    /// No step is allowed.
    NoSteps,
    /// Radau collocation is available with 3, 5 and 7 stages.
    RadauStages {
        /// The number of stages asked for.
        given: usize,
    },
    /// Gauss collocation is available with 2, 3, 4 and 6 stages.
    Stages {
        /// The number of stages asked for.
        given: usize,
    },
    /// RATTLE and splitting are available with the orders 2, 4, 6 and 8, Taylor polynomials with 2 to 32.
    Order {
        /// The order asked for.
        given: usize,
    },
    /// RATTLE was asked for, and the model is not isochoric.
    NotIsochoric {
        /// Name of the model.
        #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::interned::word"))]
        model: Word,
    },
    /// RATTLE was asked for, and the energy is not that of masses, or a force depends on velocities.
    NotSeparable {
        /// Name of the model.
        #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::interned::word"))]
        model: Word,
    },
    /// The start is off its constraint; by [`Method::Rattle`](../enum.Method.html#variant.Rattle), off `det phi = 1` or
    /// `tr(phi^-1 phi_dot) = 0`.
    OffConstraint {
        /// How far it is: `|det phi - 1|`, `|phi^T phi - 1|`, or the distance of `phi^T phi` from a multiple of 1.
        #[cfg_attr(feature = "serde", serde(with = "crate::interned::number"))]
        defect: f64,
    },
    /// The method needs a capability that the model was not given.
    NotEmitted {
        /// Name of the model.
        #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::interned::word"))]
        model: Word,
        /// What `emit(...)` should list.
        #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::interned::word"))]
        key: Word,
    },
    /// An event asks for a component that vectors of this dimension do not have.
    EventIndex {
        /// Name of the event.
        #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::interned::word"))]
        event: Word,
        /// The index.
        index: usize,
    },
    /// An event waits for a level that nothing has: no finite number, or a stretch that is not positive.
    EventLevel {
        /// Name of the event.
        #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::interned::word"))]
        event: Word,
        /// The level.
        #[cfg_attr(feature = "serde", serde(with = "crate::interned::number"))]
        given: f64,
    },
    /// The checkpoint is of a run with another model, other parameters, start, method, tolerance, interval, outputs or
    /// events, or is not as it was written.
    Checkpoint {
        /// Name of the model.
        #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::interned::word"))]
        model: Word,
    },
    /// There is no such shard of an ensemble.
    Shard {
        /// Its number.
        k: u64,
        /// How many there are.
        of: u64,
    },
    /// There is no such body of a frame loop.
    Body {
        /// Its number.
        number: usize,
        /// How many there are.
        of: usize,
    },
    /// The length of a fixed step is not positive, not finite, or lost in the rounding of times.
    Step {
        /// Its value.
        #[cfg_attr(feature = "serde", serde(with = "crate::interned::number"))]
        given: f64,
        /// Start of the interval.
        #[cfg_attr(feature = "serde", serde(with = "crate::interned::number"))]
        t0: f64,
        /// End of the interval.
        #[cfg_attr(feature = "serde", serde(with = "crate::interned::number"))]
        t_end: f64,
    },
    /// The spacing of outputs is not positive, not finite, or much too fine for the interval.
    OutputSpacing {
        /// The spacing.
        #[cfg_attr(feature = "serde", serde(with = "crate::interned::number"))]
        dt: f64,
        /// Start of the interval.
        #[cfg_attr(feature = "serde", serde(with = "crate::interned::number"))]
        t0: f64,
        /// End of the interval.
        #[cfg_attr(feature = "serde", serde(with = "crate::interned::number"))]
        t_end: f64,
    },
    /// An output time lies outside the interval.
    OutputOutside {
        /// Its index in the list.
        index: usize,
        /// The time.
        #[cfg_attr(feature = "serde", serde(with = "crate::interned::number"))]
        t: f64,
        /// Start of the interval.
        #[cfg_attr(feature = "serde", serde(with = "crate::interned::number"))]
        t0: f64,
        /// End of the interval.
        #[cfg_attr(feature = "serde", serde(with = "crate::interned::number"))]
        t_end: f64,
    },
    /// Output times do not follow one another in the direction of time.
    OutputOrder {
        /// Index of the later one in the list.
        index: usize,
        /// The time.
        #[cfg_attr(feature = "serde", serde(with = "crate::interned::number"))]
        t: f64,
        /// The time listed before it.
        #[cfg_attr(feature = "serde", serde(with = "crate::interned::number"))]
        before: f64,
    },
    /// A `Flow` was asked for a time outside its last step.
    OutsideStep {
        /// The time.
        #[cfg_attr(feature = "serde", serde(with = "crate::interned::number"))]
        t: f64,
        /// Where the step began.
        #[cfg_attr(feature = "serde", serde(with = "crate::interned::number"))]
        from: f64,
        /// The time reached.
        #[cfg_attr(feature = "serde", serde(with = "crate::interned::number"))]
        to: f64,
    },
    /// A run was asked for a time, and has not kept what lies between its outputs.
    NotDense {
        /// The time.
        #[cfg_attr(feature = "serde", serde(with = "crate::interned::number"))]
        t: f64,
    },
    /// A run was asked for a time outside of it.
    OutsideRun {
        /// The time.
        #[cfg_attr(feature = "serde", serde(with = "crate::interned::number"))]
        t: f64,
        /// Where the run began.
        #[cfg_attr(feature = "serde", serde(with = "crate::interned::number"))]
        from: f64,
        /// Where it ended.
        #[cfg_attr(feature = "serde", serde(with = "crate::interned::number"))]
        to: f64,
    },
    /// A run was asked for a time at which no polynomial stands for its motion.
    NotKept {
        /// The time.
        #[cfg_attr(feature = "serde", serde(with = "crate::interned::number"))]
        t: f64,
    },
    /// `Method::ClosedForm` was asked for and there is none.
    NoClosedForm {
        /// Name of the model.
        #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::interned::word"))]
        model: Word,
    },
}

impl fmt::Display for Setting {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Setting::NoEnd => f.write_str("no end time: a run needs one; say `.until(t_end)`"),
            Setting::Time { name, given } => write!(f, "{name} is {given}: times are finite numbers"),
            Setting::Interval { t0, t_end } => write!(
                f,
                "the interval from {t0:e} to {t_end:e}: its length is 0, or at least 1e-300 and at most 1.7e308; choose \
                 another unit of time"
            ),
            Setting::Tolerance { given } => write!(
                f,
                "tolerance {given:e}: it is a relative error per step, at least 1e-15 (what rounding leaves of \
                 double precision) and below 1; 1e-6 to 1e-13 are common"
            ),
            Setting::NoSteps => f.write_str("max_steps(0) allows no step: give a positive number"),
            Setting::RadauStages { given } => {
                write!(f, "Radau collocation with {given} stages: there are 3, 5 and 7")
            }
            Setting::Stages { given } => write!(
                f,
                "Gauss collocation with {given} stages: give 2, 3, 4 or 6 stages, of orders 4, 6, 8 and 12"
            ),
            Setting::Order { given } => write!(
                f,
                "order {given}: RATTLE and splitting have the orders 2, 4, 6 and 8; Taylor series have {LOWEST_ORDER} to \
                 {HIGHEST_ORDER}, or `None` for the one that suits the tolerance"
            ),
            Setting::NotIsochoric { model } => write!(
                f,
                "{model} is not confined to det phi = 1, the constraint that RATTLE keeps: use Method::Automatic, or \
                 say `constraint = isochoric`"
            ),
            Setting::NotSeparable { model } => write!(
                f,
                "{model} is not a body of masses, `kinetic(dalembert = ..)`, under forces that depend on positions alone: use \
                 Method::Gauss or Method::Automatic, which take steps on the group"
            ),
            Setting::OffConstraint { defect } => write!(
                f,
                "the start is off its constraint by {defect:e}: det phi = 1 and tr(phi^-1 phi_dot) = 0 of an isochoric body, \
                 phi^T phi = 1 of a rigid one, a multiple of 1 of a conformal one. Scale phi by det(phi)^(-1/n), or take the \
                 rotation of its polar decomposition, and make the point by `at_velocity` or `at_momentum`"
            ),
            Setting::NotEmitted { model, key } => write!(
                f,
                "{model} was not given `{key}`: write `emit({key})` in its `#[affine_model(...)]`, which the compiler refuses where \
                 such a model cannot have it, or use Method::Automatic, which takes what there is"
            ),
            Setting::EventIndex { event, index } => {
                write!(
                    f,
                    "the event `{event}` asks for component {index}: components are counted from 1 to n"
                )
            }
            Setting::EventLevel { event, given } => write!(
                f,
                "the event `{event}` waits for {given:e}, which nothing has: levels are finite, and stretches positive"
            ),
            Setting::Checkpoint { model } => write!(
                f,
                "the checkpoint is not of this run of {model}, or not as it was written: resume with the model, its \
                 parameters, the start, method, tolerance, times, outputs and events of the run that was interrupted, and into a \
                 folder with its format, columns and rows of a file"
            ),
            Setting::Body { number, of } => write!(f, "body {number} of {of}: bodies are counted from 0"),
            Setting::Shard { k, of } => write!(f, "shard {k} of {of}: of one or more, counted from 0"),
            Setting::Step { given, t0, t_end } => write!(
                f,
                "a step of {given:e} between {t0} and {t_end}: it is a positive number, coarser than the rounding of \
                 times; twenty steps to the shortest period are a good start",
                t0 = Time(*t0),
                t_end = Time(*t_end)
            ),
            Setting::OutputSpacing { dt, t0, t_end } => write!(
                f,
                "output every {dt:e} between {t0} and {t_end}: the spacing is a positive number, coarser than the \
                 rounding of times, and gives at most 1e8 outputs",
                t0 = Time(*t0),
                t_end = Time(*t_end)
            ),
            Setting::OutputOutside { index, t, t0, t_end } => write!(
                f,
                "output time {t} (number {index} of the list, from 0) lies outside the run from {t0} to {t_end}: \
                 drop it or extend the run",
                t = Time(*t),
                t0 = Time(*t0),
                t_end = Time(*t_end)
            ),
            Setting::OutputOrder { index, t, before } => write!(
                f,
                "output time {t} (number {index} of the list, from 0) does not come after {before}: list each time \
                 once, in the direction of the run",
                t = Time(*t),
                before = Time(*before)
            ),
            Setting::OutsideStep { t, from, to } => write!(
                f,
                "time {t} lies outside the last step, from {from} to {to}: a flow knows no other; keep the points of \
                 earlier times, or run a simulation",
                t = Time(*t),
                from = Time(*from),
                to = Time(*to)
            ),
            Setting::NotDense { t } => write!(
                f,
                "the run has not kept what lies between its outputs: run it with `.dense()`, or with `.output([{t}])`",
                t = Time(*t)
            ),
            Setting::NotKept { t } => write!(
                f,
                "the motion about {t} is too fast or has a kink, and is not kept to the tolerance: ask for an output, `.output([{t}])`",
                t = Time(*t)
            ),
            Setting::OutsideRun { t, from, to } if !t.is_finite() => {
                write!(
                    f,
                    "{t} is no time of the run from {from} to {to}",
                    t = Time(*t),
                    from = Time(*from),
                    to = Time(*to)
                )
            }
            Setting::OutsideRun { t, from, to } => write!(
                f,
                "time {t} lies outside the run from {from} to {to}, {}: let it begin or end there, `.from({t})` or `.until({t})`",
                if (to - from) * (t - from) < 0.0 { "before the start" } else { "behind the end" },
                t = Time(*t),
                from = Time(*from),
                to = Time(*to)
            ),
            Setting::NoClosedForm { model } => write!(
                f,
                "{model} has no closed form from this start: use Method::Automatic, which takes one only where it \
                 exists"
            ),
        }
    }
}

debug_as_displayed!([] Setting);

impl std::error::Error for Setting {}
