//! What stops a run.

use core::fmt;

use super::debug_as_displayed;
use super::setting::Setting;
use super::time::Time;
use crate::description::{Bound, Guard};
use crate::quantity::Word;

/// Why, when and at which step a run stopped.
#[derive(Clone, Copy, PartialEq)]
pub struct Stop {
    /// The reason.
    pub reason: Reason,
    /// Time of the last good phase point.
    pub t: f64,
    /// Accepted steps up to there.
    pub steps: u64,
}

/// Why a run stopped.
#[derive(Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Reason {
    /// A setting is wrong; the run did not begin.
    Setting(Setting),
    /// The equations of motion, a state or a phase point are not finite.
    NotFinite,
    /// The placement lost its orientation or degenerated.
    Placement {
        /// `det phi` of the first bad phase point met; of the last good one where no step leads on from it, or where the next double
        /// of the time may lie beyond a zero; 0 where a closed form turns inside out and back on the way to the time asked for.
        #[cfg_attr(feature = "serde", serde(with = "crate::interned::number"))]
        determinant: f64,
        /// The rate of `det phi` along the motion at the last good phase point; `None` for a start.
        #[cfg_attr(feature = "serde", serde(default, with = "crate::interned::number"))]
        rate: Option<f64>,
        /// The time at which `det phi` fell to zero: the zero itself of the closed form, else, to the rounding of times,
        /// that of the dense output of the step in which it lies; the time of a start that is bad.
        #[cfg_attr(feature = "serde", serde(with = "crate::interned::number"))]
        t: f64,
    },
    /// The body has not collapsed, but its stretches differ so much that what is made of `phi` is lost in rounding: `det phi`, in the
    /// plane by a factor of some 1e15; a mass matrix that depends on the placement, by one of some 1e7; or velocities as steps
    /// need them, which then become so short that those left do not lead to the end. So may end a body that is stretched without
    /// bound in a finite time, and one whose collapse is hidden by rounding before it is at hand.
    Distortion {
        /// What comes out for `det phi`.
        #[cfg_attr(feature = "serde", serde(with = "crate::interned::number"))]
        determinant: f64,
        /// The time.
        #[cfg_attr(feature = "serde", serde(with = "crate::interned::number"))]
        t: f64,
    },
    /// The motion leaves the states at which the potential has a value, or starts at one where it has none.
    Domain {
        /// The part of the potential, and the function that loses its sign.
        guard: Guard,
        /// The value of that function: the first of another sign, or the last before steps end.
        #[cfg_attr(feature = "serde", serde(with = "crate::interned::number"))]
        value: f64,
        /// The time: to the rounding of times that of the dense output of the step in which the sign is lost.
        #[cfg_attr(feature = "serde", serde(with = "crate::interned::number"))]
        t: f64,
    },
    /// The energy is not finite: a sum, a power or an exponential function in it has left the range of numbers.
    Energy {
        /// `H`.
        #[cfg_attr(feature = "serde", serde(with = "crate::interned::number"))]
        energy: f64,
        /// The time.
        #[cfg_attr(feature = "serde", serde(with = "crate::interned::number"))]
        t: f64,
    },
    /// The energy, less the work of the forces that no potential has, is no longer what it was at the start: the steps have
    /// lost the motion, as they do where they pass over a singularity. Explicit steps that are too long for a stiff vibration damp
    /// it, and its energy is lost with it: at a looser tolerance that is within what is allowed, and only said by `why()`; at a
    /// tighter one steps follow the vibration; in between the run ends here.
    EnergyLost {
        /// `|H(t) - H(t0) - W(t)|`.
        #[cfg_attr(feature = "serde", serde(with = "crate::interned::number"))]
        defect: f64,
        /// The largest `|T| + |U|` met; a tenth of it is allowed, and of a motion that conserves energy half of what it is and was at
        /// the start, or what an error of ten tolerances in the placement is worth.
        #[cfg_attr(feature = "serde", serde(with = "crate::interned::number"))]
        scale: f64,
        /// The time.
        #[cfg_attr(feature = "serde", serde(with = "crate::interned::number"))]
        t: f64,
    },
    /// The mass matrix, which depends on the placement, became degenerate or changed its signature: the momentum no
    /// longer determines the velocity.
    Degenerate {
        /// The weakest pivot of its factorisation, relative to what it is a difference of, at the first bad placement,
        /// or at the last good one where no step leads on from it; see [`Regularity`](crate::model::Regularity).
        #[cfg_attr(feature = "serde", serde(with = "crate::interned::number"))]
        weakest: f64,
        /// The time of that placement.
        #[cfg_attr(feature = "serde", serde(with = "crate::interned::number"))]
        t: f64,
    },
    /// Friction takes velocities away so fast that steps by splitting of an order above 2, some of whose pieces go back in time,
    /// amplify what it has taken.
    Friction {
        /// The order.
        order: usize,
        /// The rate at which velocities are taken away, or up to four percent more.
        #[cfg_attr(feature = "serde", serde(with = "crate::interned::number"))]
        rate: f64,
        /// The longest step of this order under such friction.
        #[cfg_attr(feature = "serde", serde(with = "crate::interned::number"))]
        longest: f64,
    },
    /// A method that forms `det phi`, Runge-Kutta-Nystrom or splitting under a potential in `q` or `D`, where it or its
    /// inverse is no normal number.
    Range {
        /// The mean log-stretch of the first such placement.
        #[cfg_attr(feature = "serde", serde(with = "crate::interned::number"))]
        q: f64,
        /// The time of that placement.
        #[cfg_attr(feature = "serde", serde(with = "crate::interned::number"))]
        t: f64,
    },
    /// The closed form at a time so late that rounding alone turns the body by a radian, or stretches it by a factor of
    /// `e`: `eps rate (t - t0) >= 1`.
    Unresolved {
        /// What angles and log-stretches grow by in a unit of time, at most: [`Geodesic::rate`](crate::geodesic::Geodesic::rate).
        #[cfg_attr(feature = "serde", serde(with = "crate::interned::number"))]
        rate: f64,
        /// The time.
        #[cfg_attr(feature = "serde", serde(with = "crate::interned::number"))]
        t: f64,
    },
    /// The error stays above the tolerance however short the step.
    StepUnderflow {
        /// The tolerance.
        #[cfg_attr(feature = "serde", serde(with = "crate::interned::number"))]
        tolerance: f64,
    },
    /// The equations of an implicit step have no solution, or none that the iteration finds.
    NoSolution {
        /// The defect with which the iteration ended, relative to the largest component of the reduced state and its increments.
        #[cfg_attr(feature = "serde", serde(with = "crate::interned::number"))]
        residual: f64,
        /// The longest step allowed.
        #[cfg_attr(feature = "serde", serde(with = "crate::interned::number"))]
        step: f64,
    },
    /// The largest number of steps is used up.
    StepLimit {
        /// The largest number of steps.
        limit: u64,
    },
    /// The function of an event is not a number, so that nothing is known of its sign.
    Event {
        /// Name of the event.
        #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::interned::word"))]
        event: Word,
        /// The time.
        #[cfg_attr(feature = "serde", serde(with = "crate::interned::number"))]
        t: f64,
    },
    /// The changes of an event accumulate, and no motion leads beyond that time: they follow one another in intervals that
    /// shrink to nothing, as the bounces of a ball do that keeps a part of its velocity, or a change takes the rate of the
    /// function away at zero, through which it would go at once, as that of a ball at rest on a floor.
    Accumulation {
        /// Name of the event.
        #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::interned::word"))]
        event: Word,
        /// The time at which they accumulate. The run ends with the last change before, when what is left is less than 6e-8 of
        /// the time since the intervals began to shrink, or bounces are lost in the rounding of the function.
        #[cfg_attr(feature = "serde", serde(with = "crate::interned::number"))]
        t: f64,
        /// How often the event has changed the point.
        count: u64,
    },
    /// The phase point to which an event should have changed the body is none: the function gave an error, numbers that are not
    /// finite, or a placement that does not keep orientation.
    Change {
        /// Name of the event.
        #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::interned::word"))]
        event: Word,
    },
    /// A callback said `Break`.
    Interrupted(Callback),
}

/// The callback that ended a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Callback {
    /// `Simulation::progress`.
    Progress,
    /// `Simulation::observe`.
    Observer,
}

impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Reason::Setting(setting) => setting.fmt(f),
            Reason::NotFinite => f.write_str(
                "the equations of motion or the phase point are not finite any more: the motion has left the range \
                 of numbers, met a singularity of the model or a root without a slope, as `norm(x)` at x = 0, or took equal \
                 steps that are too long for it; shorten these, end the run before, or change the potential",
            ),
            Reason::Placement { determinant, rate, t } => {
                let t = Time(*t);
                match determinant {
                    0.0 => write!(f, "det phi = 0 at t = {t}, not positive")?,
                    // What of it is known next to there is the rate.
                    d if *d > 0.0 => write!(f, "det phi = {d:e} at t = {t}, and may vanish next to it")?,
                    d => write!(f, "det phi = {d:e}, and not positive from t = {t} on")?,
                }
                if let Some(rate) = rate {
                    write!(f, ", with the rate {rate:.3e} before")?;
                }
                f.write_str(
                    ": the body collapses or turns inside out, and leaves the configuration space GL+(n); a potential that \
                     grows without bound as det phi -> 0 prevents it",
                )
            }
            Reason::Distortion { determinant, t } => write!(
                f,
                "det phi comes out as {determinant:e} at t = {t}: the body has not collapsed, but its stretches differ so much \
                 that sixteen digits do not tell det phi, or what steps need of the inverse of phi, any more; end the run \
                 before, or add a potential that keeps the stretches together",
                t = Time(*t)
            ),
            Reason::Domain { guard: Guard { part, argument, bound }, value, t } => write!(
                f,
                "{argument} is {value:e} at t = {t}, and {}: `{part}` of the potential has no value there; end the run before, \
                 start elsewhere, or choose a potential that keeps the motion away from there",
                match bound {
                    Bound::Positive => "is not positive, or about to vanish",
                    Bound::NotNegative => "is negative, or about to be",
                    Bound::NotZero => "changes its sign",
                },
                t = Time(*t)
            ),
            Reason::Energy { energy, t } => write!(
                f,
                "the energy is {energy} at t = {t}: a function in it has left the range of numbers or of its own values; end \
                 the run before, start elsewhere, or choose other units",
                t = Time(*t)
            ),
            Reason::EnergyLost { defect, scale, t } => write!(
                f,
                "the energy is off by {defect:.2e} at t = {t}, where kinetic and potential energy were {scale:.2e} at the most: \
                 the steps have lost the motion, or have passed over a singularity; ask for a smaller tolerance, or end the run \
                 before",
                t = Time(*t)
            ),
            Reason::Degenerate { weakest, t } => write!(
                f,
                "the mass matrix degenerates at t = {t}, its weakest pivot is {weakest:e} of what it is a difference of: \
                 the momentum does not determine the velocity there; end the run before, start elsewhere, or choose \
                 coefficients whose sum is definite at every placement",
                t = Time(*t)
            ),
            Reason::Friction { order, rate, longest } => write!(
                f,
                "friction takes velocities away at a rate of about {rate:.1e}: splitting of order {order}, like all above 2, goes \
                 back in time on its way, where friction gives back what it has taken, and more the longer the step; take order \
                 2, steps of at most {:.1e}, or Method::Radau {{ stages: None }}",
                two_digits_of(*longest)
            ),
            Reason::Range { q, t } => write!(
                f,
                "q = {q} at t = {t}: Runge-Kutta-Nystrom steps and splitting compute det phi, which with its inverse is in \
                 the range of numbers for |q| below 354, n = 2, and 236, n = 3; the other methods carry q or 1/D \
                 along and hold beyond it, or choose a unit of length in which the body is nearer to its size",
                t = Time(*t)
            ),
            Reason::Unresolved { rate, t } => write!(
                f,
                "at t = {t:e} angles of the closed form, which grow by {rate:e} in a unit of time, have no digit left: \
                 a double has sixteen; end the run before, or start it anew from a later point"
            ),
            Reason::StepUnderflow { tolerance } => write!(
                f,
                "the error stays above the tolerance {tolerance:e} however short the step: the motion runs into a singularity, \
                 the tolerance is finer than rounding allows, the interval is longer than 1e30 steps, or doubles near these \
                 times are further apart than steps; end the run before, or loosen the tolerance"
            ),
            Reason::NoSolution { residual, step } => write!(
                f,
                "the equations of a step have no solution that the iteration finds, their residual stays at \
                 {residual:e}: the step {step:e} is too long for the motion, or the motion runs into a singularity; \
                 shorten the step or end the run before"
            ),
            Reason::StepLimit { limit } => write!(
                f,
                "the largest number of steps, {limit}, is used up: raise it by `.max_steps(n)`, that of a flow by \
                 `.set_max_steps(n)`, loosen the tolerance, or take another method: an implicit one where the model is stiff, \
                 Method::Rattle where the model has it and the body is stretched far; one that is stretched without bound, or \
                 of which det phi falls to zero, takes ever more of them: end such a run before"
            ),
            Reason::Event { event, t } => write!(
                f,
                "the function of the event `{event}` is NaN at t = {t}: it has a sign at every phase point of the run; \
                 give it a number where it is undefined, a constant where the event cannot happen",
                t = Time(*t)
            ),
            Reason::Accumulation { event, t, count } => write!(
                f,
                "the changes of the event `{event}`, {count} of them, accumulate at t = {t}: they follow one another ever \
                 faster, or the last one left the motion at rest where the event happens; let the event stop the run, or \
                 go on from its end with a model of the motion in contact",
                t = Time(*t)
            ),
            Reason::Change { event } => write!(
                f,
                "the event `{event}` should change the phase point, and what its function gave is none: an error, numbers that \
                 are not finite, or det phi <= 0; give a phase point of the model, or let the event stop the run"
            ),
            Reason::Interrupted(Callback::Progress) => f.write_str("the progress callback ended the run"),
            Reason::Interrupted(Callback::Observer) => f.write_str("the observer ended the run"),
        }
    }
}

/// Two digits of a positive number that are not above it: what is said to be allowed is.
fn two_digits_of(number: f64) -> f64 {
    let unit = libm::pow(10.0, libm::floor(libm::log10(number)) - 1.0);
    if unit.is_normal() { libm::floor(number / unit) * unit } else { number }
}

impl fmt::Display for Stop {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.reason {
            Reason::Setting(setting) => setting.fmt(f),
            reason => write!(f, "stopped at t = {} after {} steps: {reason}", Time(self.t), self.steps),
        }
    }
}

debug_as_displayed!([] Stop, [] Reason);

impl std::error::Error for Stop {}

/// The reason in words, for who reads it, and as it is, for programs; with time and steps.
#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
struct Written {
    reason: String,
    cause: Reason,
    #[serde(with = "crate::interned::number")]
    t: f64,
    steps: u64,
}

#[cfg(feature = "serde")]
impl serde::Serialize for Stop {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let Self { reason, t, steps } = *self;
        Written { reason: format!("{reason}"), cause: reason, t, steps }.serialize(serializer)
    }
}

#[cfg(feature = "serde")]
impl<'de> serde::Deserialize<'de> for Stop {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let Written { cause: reason, t, steps, .. } = Written::deserialize(deserializer)?;
        Ok(Self { reason, t, steps })
    }
}

impl From<Setting> for Reason {
    fn from(setting: Setting) -> Self {
        Reason::Setting(setting)
    }
}
