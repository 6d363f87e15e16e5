//! Splitting with steps as long as a tolerance allows.

use super::{Pieces, Sweeps, composed, of_order};
use crate::drive::{Adaptive, AdaptiveMethod, Attempt, Control};
use crate::error_norm::ErrorNorm;
use crate::finite::is_finite;
use crate::lie::Sum;
use crate::step_size::Controller;
use crate::tape::Tape;
use crate::vectors::Baseline;
use crate::{Failure, sound};
use affine_core::__private::numerics::{Vectors, norm};
use affine_core::model::{Group, StateVector};

/// The order of steps where none is given: on problem P7 with stiffnesses from 1e4 to 1e8 the least work of orders 2, 4 and 6
/// at nearly all errors from 1e-3 to 1e-9.
pub const ORDER: usize = 4;
/// The error of two halves is their difference to the whole over `2^p - 1`, where steps resolve the motion. Steps that pass
/// over many turns of a stiff dilatation do not, and what is gained by halving them is that of order 2 at best.
const GAIN_BY_HALVING: f64 = 3.0;
/// Differences up to this part of the state may be what the flows of a whole step and of two halves round differently: they
/// are some dozens, of a few roundings each.
const ROUNDING: f64 = 256.0 * f64::EPSILON;
/// A first step tries so many times what the fastest motion takes to turn by a radian.
const FIRST: f64 = 1e3;

/// Splitting from `t0` to `t_end`, in either direction of time, in steps by their error: the difference between one step
/// and two halves of it, which are what is kept. Relative to the tolerance in the [`ErrorNorm`] it is at most 3.
///
/// Every flow is a symplectic (Poisson) map, and so is each step, but not the motion as a whole: a step depends on the state
/// from which it starts, and the energy error may drift as that of other adaptive methods does. What each piece conserves
/// is conserved up to rounding, as by [`Splitting`](super::Splitting): momenta of symmetries that all pieces share, and
/// Casimirs.
///
/// It is for pieces of which one has a stiff motion in closed form: its steps need not resolve that. The error that is left
/// by not resolving it is part of the estimate, and is no power of the step: steps whose halves fall upon the same phase of a
/// fast motion err more than longer ones do, and changes of their lengths get by these.
///
/// Flows round the state, by the more the larger the momenta are that cancel in them, and shorter steps do not round less.
/// Where a shorter step has a difference of a few roundings that is not smaller in proportion, it is accepted, and from then
/// on twice that difference is: a tolerance next to rounding is met as far as rounding allows, and changes nothing from
/// 2e-14 on.
///
/// A force that sets in behind the last kick of a step and of its halves, as a contact may, would be felt by neither. Whole steps
/// begin and end with the piece that is within their halves, so that one of the two looks at the ends. With
/// `[B, [B, [B, A]]] = 0`, where all forces are those of a potential of the placement, whole steps of orders 4 and 6 are
/// like their halves: by order 6, and by order 4 beside a stiff dilatation, such a force may be missed.
///
/// Cost: three steps of the composition for a step, of which [`Statistics`](crate::Statistics) count the flows of the last piece; at the start
/// one evaluation for each component of a momentum, and a few more.
pub type AdaptiveSplitting<S, C, P> = Adaptive<HalvedSteps<S, C, P>>;

/// Steps of a composition with two halves of each.
#[derive(Clone)]
pub struct HalvedSteps<S, C, P> {
    pieces: P,
    constants: C,
    sweeps: Sweeps,
    /// That of whole steps.
    whole: Sweeps,
    error_norm: ErrorNorm,
    /// The difference that steps may have by rounding alone, as far as it has been seen.
    rounding: f64,
    /// Length and difference of the last attempt of the step.
    longer: (f64, f64),
    begin: (f64, Sum<S>),
    end: (f64, Sum<S>),
}

impl<S: StateVector<f64>, C, P: Pieces<S, C>> Adaptive<HalvedSteps<S, C, P>> {
    /// The integration at its start, of order 2, 4, 6 or 8, [`ORDER`] where none is given; `None` for other orders.
    /// `f` are the equations of the whole motion, which are looked at here alone; `groups` lay out the state vector for the
    /// [`ErrorNorm`].
    ///
    /// # Errors
    /// [`Failure::NotFinite`] where `y0` or `f(t0, y0)` is not finite; [`Failure::Time`] for an interval and
    /// [`Failure::Tolerance`] for a tolerance that make no sense.
    pub fn new(
        (pieces, constants): (P, C),
        order: Option<usize>,
        (f, groups): (&impl Fn(f64, &S) -> S, &'static [Group]),
        (t0, y0): (f64, S),
        t_end: f64,
        tolerance: f64,
    ) -> Option<Result<Self, Failure>> {
        let sweeps = of_order(order.unwrap_or(ORDER), (P::NYSTROM, P::DILATES))?;
        let slope = f(t0, &y0);
        let is_sound = sound(t0, t_end, tolerance).and_then(|()| match is_finite(&y0) && is_finite(&slope) {
            true => Ok(()),
            false => Err(Failure::NotFinite),
        });
        if let Err(failure) = is_sound {
            return Some(Err(failure));
        }
        let (error_norm, probes) = ErrorNorm::probed(groups, f, (t0, &y0, &slope));
        let span = (t_end - t0).abs();
        let first = FIRST / fastest(f, (t0, &y0));
        let start = (t0, Sum::of(y0));
        let length = if first < span { first } else { span };
        let controller = Controller::of(sweeps.order() as f64 + 1.0, 1.0);
        let method = HalvedSteps {
            pieces,
            constants,
            sweeps,
            whole: sweeps.from_the_other_end(),
            error_norm,
            rounding: 0.0,
            longer: (f64::INFINITY, 0.0),
            begin: start,
            end: start,
        };
        let evaluations = 1 + probes + EVALUATIONS;
        Some(Ok(Self { method, control: Control::new((t_end, tolerance), controller, length, evaluations) }))
    }

    /// A first step of a length is within the tolerance; it is counted, and not taken.
    #[doc(hidden)]
    pub fn allows(&mut self, length: f64) -> bool {
        let (method, control) = (&mut self.method, &mut self.control);
        let (t, _) = method.end;
        let (_, difference) = method.halved(t + length.copysign(control.t_end - t), control);
        method.error(difference, control.tolerance) <= 1.0
    }

    /// Order of the composition.
    #[must_use]
    pub fn order(&self) -> usize {
        self.method.sweeps.order()
    }
}

impl<S: StateVector<f64>, C, P: Pieces<S, C>> AdaptiveMethod for HalvedSteps<S, C, P> {
    type State = S;
    const NAME: &'static str = "AdaptiveSplitting";

    fn t(&self) -> f64 {
        self.end.0
    }

    fn y(&self) -> &S {
        &self.end.1.value
    }

    fn step(&mut self, control: &mut Control) -> Result<(), Failure> {
        control.by_error(self, Baseline)
    }

    /// By two shorter halves from the beginning of the last step, which leave the steps as they are.
    fn at(&mut self, t: f64, control: &mut Control) -> Result<S, Failure> {
        let (from, begin) = self.begin;
        if t == self.t() || from == self.t() {
            return Ok(*self.y());
        }
        let between = self.in_halves(from, begin, t - from, control).value;
        if is_finite(&between) { Ok(between) } else { Err(Failure::NotFinite) }
    }

    fn exchange(&mut self, tape: &mut impl Tape) {
        tape.number(&mut self.end.0);
        tape.sum(&mut self.end.1);
        tape.number(&mut self.rounding);
        self.begin = self.end;
    }
}

impl<S: StateVector<f64>, C, P: Pieces<S, C>> Attempt for HalvedSteps<S, C, P> {
    type Trial = Sum<S>;

    fn begin(&mut self, _control: &mut Control) {
        self.longer = (f64::INFINITY, 0.0);
    }

    fn attempt(&mut self, _vectors: impl Vectors, end: f64, control: &mut Control) -> Option<(Sum<S>, f64)> {
        let (reached, difference) = self.halved(end, control);
        let tried = ((end - self.end.0).abs(), difference);
        if is_of_rounding(tried, self.longer) {
            self.rounding = 2.0 * difference;
        }
        self.longer = tried;
        Some((reached, self.error(difference, control.tolerance)))
    }

    fn accept(&mut self, reached: Sum<S>, end: f64, _control: &mut Control) {
        (self.begin, self.end) = (self.end, (end, reached));
    }
}

impl<S: StateVector<f64>, C, P: Pieces<S, C>> HalvedSteps<S, C, P> {
    /// The error of a step relative to what it may be.
    fn error(&self, difference: f64, tolerance: f64) -> f64 {
        let allowed = GAIN_BY_HALVING * tolerance;
        difference / if self.rounding > allowed { self.rounding } else { allowed }
    }

    /// The state after two halves of a step to a time, and its difference to that after the whole step; NaN where something
    /// is not finite.
    fn halved(&mut self, until: f64, control: &mut Control) -> (Sum<S>, f64) {
        let (t, start) = self.end;
        let h = until - t;
        let whole = self.composed(&self.whole, t, start, h, control).value;
        let reached = self.in_halves(t, start, h, control);
        let (before, after) = (start.value.as_ref(), reached.value.as_ref());
        let mut difference = whole;
        for (difference, value) in difference.as_mut().iter_mut().zip(after) {
            *difference -= value;
        }
        let of_group = |range| norm(&difference.as_ref()[range]);
        let lasting = control.controller.lasting(h.abs());
        let relative = self.error_norm.largest(lasting, before, after, of_group);
        (reached, if is_finite(&reached.value) { relative } else { f64::NAN })
    }

    fn in_halves(&self, t: f64, start: Sum<S>, h: f64, control: &mut Control) -> Sum<S> {
        let half = self.composed(&self.sweeps, t, start, 0.5 * h, control);
        self.composed(&self.sweeps, t + 0.5 * h, half, 0.5 * h, control)
    }

    fn composed(&self, sweeps: &Sweeps, t: f64, mut point: Sum<S>, h: f64, control: &mut Control) -> Sum<S> {
        control.statistics.evaluations += composed(&self.pieces, sweeps, &self.constants, (t, &mut point), h);
        point
    }
}

/// A step has about the difference that a longer one from the same state had: what a composition errs by falls with the
/// third power of the length at least, rounding does not.
fn is_of_rounding((tried, difference): (f64, f64), (length, before): (f64, f64)) -> bool {
    difference <= ROUNDING && difference * length > before * tried && before > 0.0
}

/// Evaluations of [`fastest`].
pub const EVALUATIONS: u64 = 4;
/// Changes that slopes are compared over, relative to the state: half of the digits.
const SMALL: f64 = 1e-8;

/// The rate `omega` of the fastest motion near a state: `omega^2 = |A^3 y|/|A y|` with the derivative `A` of `f`, which a
/// stiff oscillation with `A^2 = -omega^2` dominates. The change along the state itself changes the dilatation.
pub fn fastest<S: StateVector<f64>>(f: &dyn Fn(f64, &S) -> S, (t, y): (f64, &S)) -> f64 {
    let slope = f(t, y);
    let mut along = *y;
    let mut sizes = [0.0; 3];
    for size in &mut sizes {
        let scale = SMALL * norm(y.as_ref()) / norm(along.as_ref());
        let mut moved = *y;
        for (moved, along) in moved.as_mut().iter_mut().zip(along.as_ref()) {
            *moved += scale * along;
        }
        along = f(t, &moved);
        for (along, slope) in along.as_mut().iter_mut().zip(slope.as_ref()) {
            *along = (*along - slope) / scale;
        }
        *size = norm(along.as_ref());
    }
    let [first, _, third] = sizes;
    let squared = third / first;
    if squared.is_finite() { libm::sqrt(squared) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two oscillators, one of them fast, with a force between them, in units that differ by far.
    #[test]
    fn the_fastest_rate() {
        for (rate, size) in [(1e2, 1.0), (1e5, 1e-3), (1e7, 1e6)] {
            let f = |_: f64, y: &[f64; 4]| {
                let [slow, p, fast, q] = *y;
                [p, size * fast - slow, q, slow / size - rate * rate * fast]
            };
            let found = fastest(&f, (0.0, &[1.0, 0.3, 1e-3, 0.2]));
            // What the slow one adds.
            assert!((found / rate - 1.0).abs() < 0.01, "{found:e} for {rate:e}");
        }
        assert_eq!(fastest(&|_: f64, _: &[f64; 4]| [0.0; 4], (0.0, &[1.0; 4])), 0.0);
    }
}
