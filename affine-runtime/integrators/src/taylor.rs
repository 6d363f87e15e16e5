//! Taylor series method with choice of order and step.

mod gaps;
pub(crate) mod lanes;

pub use affine_core::system::Series;

use gaps::{hides_terms, outgrows, quotient};

use super::drive::{Adaptive, AdaptiveMethod, Control};
use super::error_norm::ErrorNorm;
use super::finite::is_finite;
use super::roughly::exp;
use super::step_size::{Controller, first_step, shortest};
use super::tape::Tape;
use super::vectors::Baseline;
use super::widest::{Work, roomiest, widest};
use super::{Failure, sound};
use affine_core::__private::numerics::{
    HIGHEST_ORDER, IN_RANGE as USUAL_SQUARES, LOWEST_ORDER, Vectors, larger, norm, sum_of_squares,
};
use affine_core::model::{Group, StateVector};

/// Adaptive integration from `t0` to `t_end`, in either direction of time, by Taylor polynomials.
///
/// After Jorba and Zou, Experimental Mathematics 14 (2005) 99-117, sections 3.2 and 3.3: with the order
/// `p = ceil(1 - ln(tolerance)/2)` a step of the radius of convergence over `e^2` just meets the tolerance, which is the
/// least work where a set of coefficients costs `p^2`. Here a step costs some `70 + 6 p + p (p - 1)/2` in units of a pair of
/// orders, and [`order_for`] takes six orders more: on the benchmark problems a quarter to a half less run time, the same
/// within a few percent from four to ten more. The step is the longest for which the last two terms do, `|y_j| h^j <=
/// tolerance` in the [`ErrorNorm`] for `j = p - 1` and `p`, times `exp(-0.7/(p - 1))`: it follows from the coefficients
/// alone, and no step is rejected. Two terms, since every other one vanishes for an even or odd solution.
///
/// Series may have longer gaps, `x'' = -x^(k - 1)` from `x = 0` has one of `k` orders: where the last two terms are less than those
/// before let expect, where they vanish, and below order 8, the step is proved before it is taken, by the defect `P' - f(P)` of
/// the polynomial at its end, and shortened to what that allows. So is every step of equations with [roots](Series::ROOTS). Where the
/// coefficients of a value within these grow along the series, those of the motion are what rounding leaves of them, and the whole
/// defect is held against the tolerance.
///
/// What a polynomial leaves out has the same sign in every step of a motion, rounding has not: a tolerance next to the
/// rounding of a double is met a hundred times over.
///
/// The polynomial is the dense output. Steps are summed with compensation.
///
/// Cost: one set of coefficients per step, which [`Statistics`](crate::Statistics) count as a series; at the start one evaluation for each
/// component of a momentum and one more; one for each time that a step is proved.
pub type Taylor<S, C, R> = Adaptive<TaylorSteps<S, C, R>>;

/// Steps by Taylor polynomials.
#[derive(Clone)]
pub struct TaylorSteps<S, C, R: Series<S, C>> {
    series: R,
    constants: C,
    error_norm: ErrorNorm,
    order: usize,
    /// The highest order of the last step: the one above, or the last one of which there is a coefficient.
    highest: usize,
    /// See [`quotient`].
    quotient: f64,
    begin: f64,
    t: f64,
    y: S,
    /// What rounding left out of `y`.
    carry: S,
    /// `y_k unit^k`
    coefficients: [S; HIGHEST_ORDER + 1],
    rows: Rows<[R::Row; HIGHEST_ORDER]>,
    /// A power of two.
    unit: f64,
}

/// Rows that begin with a line of a cache: vectors that lie across two take twice the time to load.
#[derive(Clone)]
#[repr(align(64))]
struct Rows<R>(R);

/// Last coefficients beyond these are taken in another unit of time.
const IN_RANGE: core::ops::RangeInclusive<f64> = 1e-250..=1e250;

/// Orders beyond those of Jorba and Zou, for the cost of coefficients that is linear in the order.
const MORE_ORDERS: f64 = 6.0;

/// The tolerance that a step meets: a hundredth of `tolerance` at 1e-15, all of it from 1e-14 on.
///
/// With order 25 for 1e-15 the truncation of the benchmark problem P3 adds `1e-3 eps` to the energy in each step. That is as
/// much as all rounding after 1e5 steps, and grows linearly from there on.
fn truncation(tolerance: f64) -> f64 {
    let nearness = (tolerance / 1e-14).clamp(0.1, 1.0);
    tolerance * nearness * nearness
}

/// `ceil(7 - ln(tolerance)/2)` for the tolerance that a step meets, within what there is: two more at 1e-15.
#[must_use]
pub fn order_for(tolerance: f64) -> usize {
    let order = libm::ceil(1.0 - 0.5 * libm::log(truncation(tolerance))) + MORE_ORDERS;
    (order as usize).clamp(LOWEST_ORDER, HIGHEST_ORDER)
}

/// Part of a step that is not proved after which it is tried again.
const AGAIN: core::ops::RangeInclusive<f64> = 0.1..=0.8;
/// Rounding of the equations and of the polynomial, which no step undoes.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

impl<S: StateVector<f64>, C, R: Series<S, C>> Adaptive<TaylorSteps<S, C, R>> {
    /// The integration at its start: `groups` lay out the state vector for the [`ErrorNorm`]; the order is that of
    /// [`order_for`] unless given, and within [`LOWEST_ORDER`] and [`HIGHEST_ORDER`].
    ///
    /// # Errors
    /// [`Failure::NotFinite`] where `y0` or its slope is not finite; [`Failure::Time`] for an interval and
    /// [`Failure::Tolerance`] for a tolerance that make no sense.
    #[inline(always)]
    pub fn new(
        (series, constants): (R, C),
        groups: &'static [Group],
        (t0, y0): (f64, S),
        t_end: f64,
        tolerance: f64,
        order: Option<usize>,
    ) -> Result<Self, Failure> {
        sound(t0, t_end, tolerance)?;
        let slope = |t: f64, y: &S| slope(&series, &constants, t, y);
        let first = slope(t0, &y0);
        if !is_finite(&y0) || !is_finite(&first) {
            return Err(Failure::NotFinite);
        }
        let (error_norm, probes) = if t_end == t0 {
            (ErrorNorm::new(groups), 0)
        } else {
            ErrorNorm::probed(groups, &slope, (t0, &y0, &first))
        };
        let mut coefficients = [S::zeros(); HIGHEST_ORDER + 1];
        coefficients[0] = y0;
        let order = order.unwrap_or(order_for(tolerance)).clamp(LOWEST_ORDER, HIGHEST_ORDER);
        // The length of a step follows from its coefficients alone.
        let controller = Controller::of((order + 1) as f64, 1.0);
        let control = Control::new((t_end, truncation(tolerance)), controller, 0.0, probes + 1);
        // In place: it is some kilobytes.
        Ok(Self {
            method: TaylorSteps {
                error_norm,
                order,
                highest: order,
                quotient: quotient(control.tolerance, order),
                begin: t0,
                t: t0,
                y: y0,
                carry: S::zeros(),
                coefficients,
                rows: Rows([R::Row::zeros(); HIGHEST_ORDER]),
                unit: 1.0,
                series,
                constants,
            },
            control,
        })
    }

    /// The order.
    #[must_use]
    pub fn order(&self) -> usize {
        self.method.order
    }
}

impl<S: StateVector<f64>, C, R: Series<S, C>> AdaptiveMethod for TaylorSteps<S, C, R> {
    type State = S;
    const NAME: &'static str = "Taylor";

    fn t(&self) -> f64 {
        self.t
    }

    fn y(&self) -> &S {
        &self.y
    }

    fn step(&mut self, control: &mut Control) -> Result<(), Failure> {
        roomiest(Advance(self, control))
    }

    /// By the polynomial of the step.
    fn at(&mut self, t: f64, _control: &mut Control) -> Result<S, Failure> {
        if t == self.t {
            return Ok(self.y);
        }
        let mut y = widest(Rise(self, t - self.begin));
        for (y, begin) in y.as_mut().iter_mut().zip(self.coefficients[0].as_ref()) {
            *y += begin;
        }
        Ok(y)
    }

    fn exchange(&mut self, tape: &mut impl Tape) {
        tape.number(&mut self.t);
        tape.state(&mut self.y);
        tape.state(&mut self.carry);
        tape.number(&mut self.unit);
        self.begin = self.t;
    }
}

impl<S: StateVector<f64>, C, R: Series<S, C>> TaylorSteps<S, C, R> {
    #[inline(always)]
    fn one(&mut self, vectors: impl Vectors, control: &mut Control) -> Result<(), Failure> {
        let mut again = false;
        loop {
            self.expand(vectors, control);
            if again || self.is_in_range() || !self.takes_a_unit(control) {
                break;
            }
            again = true;
        }
        let mut length = self.longest(control);
        if length.is_nan() {
            length = self.of_lower_order(control)?;
        }
        let rest = control.t_end - self.t;
        // A rest that is hardly longer is no step of its own.
        let mut end =
            if 1.01 * length >= rest.abs() { control.t_end } else { self.t + length.copysign(rest) };
        if let Some(terms) = self.doubts(length, end - self.t) {
            end = self.proved(end, terms, control);
        }
        if (end - self.t).abs() <= shortest(self.t, control.t_end) && end != control.t_end {
            return Err(Failure::StepUnderflow);
        }
        let rise = self.rise(vectors, end - self.t);
        let (mut y, mut carry) = (self.y, self.carry);
        for (i, (y, carry)) in y.as_mut().iter_mut().zip(carry.as_mut()).enumerate() {
            let before = *y;
            let rise = *carry + rise.as_ref()[i];
            *y = before + rise;
            *carry = (before - *y) + rise;
        }
        if !is_finite(&y) {
            return Err(Failure::NotFinite);
        }
        (self.begin, self.t, self.y, self.carry) = (self.t, end, y, carry);
        control.statistics.steps += 1;
        control.controller.took((self.t - self.begin).abs());
        Ok(())
    }

    /// The coefficients at the state reached.
    #[inline(always)]
    fn expand(&mut self, vectors: impl Vectors, control: &mut Control) {
        self.highest = self.order;
        self.coefficients[0] = self.y;
        let coefficients = &mut self.coefficients[..=self.order];
        let rows = &mut self.rows.0[..self.order];
        self.series.coefficients_on(vectors, (self.t, self.unit), &self.constants, coefficients, rows);
        control.statistics = control.statistics.with_series(self.order);
    }

    /// The last coefficients are neither lost nor infinite; a motion that is a polynomial of low order has none.
    #[inline(always)]
    fn is_in_range(&self) -> bool {
        let (last, before) = (&self.coefficients[self.order], &self.coefficients[self.order - 1]);
        if USUAL_SQUARES.contains(&(sum_of_squares(last.as_ref()) + sum_of_squares(before.as_ref()))) {
            return true;
        }
        let largest = |k: usize| self.coefficients[k].as_ref().iter().map(|v| v.abs()).fold(0.0, larger);
        let last = largest(self.order) + largest(self.order - 1);
        IN_RANGE.contains(&last) || last < 1.0 && (2..=3).all(|k| largest(k) == 0.0)
    }

    /// Measures time in steps: is that another unit than before?
    #[cold]
    fn takes_a_unit(&mut self, control: &mut Control) -> bool {
        let slope = |t: f64, y: &S| slope(&self.series, &self.constants, t, y);
        let accuracy = (control.tolerance, self.order as f64);
        let begin = (self.t, &self.y, &slope(self.t, &self.y));
        let length = first_step(&slope, &self.error_norm, begin, control.t_end - self.t, accuracy);
        control.statistics.evaluations += 2;
        let before = self.unit;
        if length > 0.0 && length.is_finite() {
            self.unit = libm::ldexp(1.0, libm::frexp(length).1);
        }
        self.unit != before
    }

    /// Takes the orders up to that after which coefficients, or what they are made of, are no numbers, and the longest step that they
    /// allow: a branch point that is near makes those of high orders larger than any.
    #[cold]
    #[inline(never)]
    fn of_lower_order(&mut self, control: &Control) -> Result<f64, Failure> {
        let coefficients = self.coefficients[1..=self.order].iter().zip(&self.rows.0);
        let numbers = coefficients.take_while(|(after, row)| is_finite(*after) && is_finite(*row));
        self.highest = numbers.count();
        if self.highest < LOWEST_ORDER { Err(Failure::NotFinite) } else { Ok(self.longest(control)) }
    }

    /// The last coefficients may not tell what a step leaves out, and it has to be proved: by a defect of at most so many tolerances.
    /// The defect is as many times what is left out as that has orders, unless coefficients are lost, which may be the first ones.
    #[inline(always)]
    fn doubts(&self, longest: f64, h: f64) -> Option<f64> {
        let (coefficients, rows) = (&self.coefficients[..=self.highest], &self.rows.0[..self.highest]);
        if self.highest != self.order || R::ROOTS && outgrows(rows, h.abs() / self.unit) {
            return Some(1.0);
        }
        let step = (h, self.unit, self.quotient);
        let hides = R::ROOTS || longest == f64::INFINITY || hides_terms(coefficients, &self.error_norm, step);
        hides.then_some((self.order + 1) as f64)
    }

    /// The longest step that the last two coefficients allow.
    #[inline(always)]
    fn longest(&self, control: &Control) -> f64 {
        let terms = [self.highest, self.highest - 1].map(|j| (self.coefficients[j].as_ref(), j));
        let times = (control.tolerance, self.unit, control.controller.lasting);
        let longest = self.error_norm.longest(self.coefficients[0].as_ref(), terms, times);
        exp(longest - 0.7 / (self.highest - 1) as f64) * self.unit
    }

    /// The end of a step to a time, or of a shorter one, after which the polynomial `P` solves the equations: there, `h |P' - f(P)|`
    /// is the first term that is left out times its order, `p + 1` or more, and those behind it. It may be `terms` tolerances.
    #[cold]
    #[inline(never)]
    fn proved(&self, mut end: f64, terms: f64, control: &mut Control) -> f64 {
        let (allowed, orders) = (terms * larger(control.tolerance, ROUNDING), (self.order + 1) as f64);
        loop {
            let h = end - self.t;
            let (mut after, mut defect) = (self.rise(Baseline, h), self.arriving(h));
            after.as_mut().iter_mut().zip(self.y.as_ref()).for_each(|(after, y)| *after += y);
            let slope = slope(&self.series, &self.constants, end, &after);
            let rates = slope.as_ref().iter();
            defect.as_mut().iter_mut().zip(rates).for_each(|(defect, rate)| *defect = h * (*defect - rate));
            control.statistics.evaluations += 1;
            let (states, defect) = ([self.y.as_ref(), after.as_ref()], defect.as_ref());
            let lasting = control.controller.lasting(h.abs());
            let error = self.error_norm.largest(lasting, states[0], states[1], |range| norm(&defect[range]));
            let of_work =
                self.error_norm.over_energy(states, slope.as_ref(), defect, (control.tolerance, lasting));
            let error = larger(error, of_work) / allowed;
            if error <= 1.0 || h.abs() <= shortest(self.t, control.t_end) {
                return end;
            }
            let part = libm::exp2(-libm::log2(error) / orders);
            // A defect that is no number is larger than any.
            let part = if part >= *AGAIN.start() { part } else { *AGAIN.start() };
            end = self.t + part.min(*AGAIN.end()) * h;
        }
    }

    /// `sum_(k > 0) k y_k h^(k - 1)`
    fn arriving(&self, h: f64) -> S {
        let h = h / self.unit;
        let mut rate = S::zeros();
        for (k, coefficient) in self.coefficients[..=self.highest].iter().enumerate().skip(1).rev() {
            for (rate, coefficient) in rate.as_mut().iter_mut().zip(coefficient.as_ref()) {
                *rate = *rate * h + k as f64 * coefficient;
            }
        }
        rate.as_mut().iter_mut().for_each(|rate| *rate /= self.unit);
        rate
    }

    /// `sum_(k > 0) y_k h^k`, by powers of `h` alone: those of a rounded `h^2` would be off by the same in every step of one
    /// length, and the phase drift.
    #[inline(always)]
    fn rise(&self, vectors: impl Vectors, h: f64) -> S {
        let h = h / self.unit;
        let mut rise = self.coefficients[self.highest];
        for coefficient in self.coefficients[1..self.highest].iter().rev() {
            let (fours, rest) = rise.as_mut().as_chunks_mut();
            let (of_fours, of_rest) = coefficient.as_ref().as_chunks();
            for (rise, coefficient) in fours.iter_mut().zip(of_fours) {
                *rise = vectors.plus_product(*coefficient, *rise, [h; 4]);
            }
            for (rise, coefficient) in rest.iter_mut().zip(of_rest) {
                *rise = vectors.plus_one(*coefficient, *rise, h);
            }
        }
        rise.as_mut().iter_mut().for_each(|rise| *rise *= h);
        rise
    }
}

/// A step of an integration.
struct Advance<'a, S, C, R: Series<S, C>>(&'a mut TaylorSteps<S, C, R>, &'a mut Control);

impl<S: StateVector<f64>, C, R: Series<S, C>> Work for Advance<'_, S, C, R> {
    type Output = Result<(), Failure>;
    #[inline(always)]
    fn run(self, vectors: impl Vectors) -> Result<(), Failure> {
        self.0.one(vectors, self.1)
    }
}

/// What the polynomial has risen by after a time.
struct Rise<'a, S, C, R: Series<S, C>>(&'a TaylorSteps<S, C, R>, f64);

impl<S: StateVector<f64>, C, R: Series<S, C>> Work for Rise<'_, S, C, R> {
    type Output = S;
    #[inline(always)]
    fn run(self, vectors: impl Vectors) -> S {
        self.0.rise(vectors, self.1)
    }
}

/// `y'` at a state.
fn slope<S: StateVector<f64>, C, R: Series<S, C>>(series: &R, constants: &C, t: f64, y: &S) -> S {
    let mut coefficients = [*y, S::zeros()];
    let rows = &mut [R::Row::zeros()];
    series.coefficients_on(Baseline, (t, 1.0), constants, &mut coefficients, rows);
    coefficients[1]
}
