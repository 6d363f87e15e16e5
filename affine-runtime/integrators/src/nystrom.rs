//! Runge-Kutta-Nystrom methods of orders 12 and 8 for equations of second order, with step size control.

mod dormand_el_mikkawy_prince_1210;
mod dormand_el_mikkawy_prince_86;
mod step;
mod sums;
mod tableau;
#[cfg(test)]
mod trees;

pub use affine_core::system::SecondOrder;
pub use tableau::Tableau;

use affine_core::__private::numerics::{Vectors, norm};
use affine_core::system::Sum;

use super::drive::{Adaptive, AdaptiveMethod, Attempt, Control};
use super::error_norm::ErrorNorm;
use super::finite::is_finite;
use super::step_size::{Controller, first_step};
use super::tape::Tape;
use super::widest::{Work, roomiest};
use super::{Failure, sound};
use affine_core::model::{Group, StateVector};
use step::{Step, halves, joined};

/// Adaptive integration of `q' = V(p)`, `p' = F(t, q)` from `t0` to `t_end`, in either direction of time, by a method
/// of Dormand, El-Mikkawy and Prince (IMA J. Numer. Anal. 7 (1987) 423-430):
///
/// ```text
/// q_i = q + h V(c_i p + h sum_j a_ij F_j),   F_i = F(t + c_i h, q_i)
/// q_1 = q + h V(p + h sum_i b_i F_i),        p_1 = p + h sum_i b'_i F_i
/// ```
///
/// A step is accepted when the difference to the embedded solution, relative to the tolerance in the [`ErrorNorm`], is
/// at most 1. States are summed with compensation.
///
/// | | embedded | evaluations of `F` per accepted step | per rejected one |
/// |---|---|---|---|
/// | [`Tableau::ORDER_12`] | order 10 | 17 | 16 |
/// | [`Tableau::ORDER_8`] | order 6 | 8 | 8 |
///
/// and 2 at the start, the first of which is that of the first step.
pub type RungeKuttaNystrom<S, C, R> = Adaptive<NystromSteps<S, C, R>>;

/// The steps of a Runge-Kutta-Nystrom method.
#[derive(Clone)]
pub struct NystromSteps<S, C, R: SecondOrder<S, C>> {
    system: R,
    constants: C,
    error_norm: ErrorNorm,
    step: Step<R::Half>,
    t: f64,
    /// Positions and momenta reached.
    reached: [Sum<R::Half>; 2],
    /// The state that holds them. The rest of it, which no step reads, is that of the start.
    state: S,
    /// The force there, where it is known.
    force: Option<R::Half>,
}

impl<S: StateVector<f64>, C, R: SecondOrder<S, C>> Adaptive<NystromSteps<S, C, R>> {
    /// The integration at its start: `groups` lay out the state vector for the [`ErrorNorm`].
    ///
    /// # Errors
    /// [`Failure::NotFinite`] where `y0` or the force there is not finite; [`Failure::Time`] for an interval and
    /// [`Failure::Tolerance`] for a tolerance that make no sense.
    #[inline(always)]
    pub fn new(
        (system, constants): (R, C),
        tableau: &'static Tableau,
        groups: &'static [Group],
        (t0, y0): (f64, S),
        t_end: f64,
        tolerance: f64,
    ) -> Result<Self, Failure> {
        sound(t0, t_end, tolerance)?;
        let slope = |t: f64, y: &S| {
            let [positions, momenta] = halves(y);
            let velocity = system.drift(&constants, &momenta);
            joined::<S, R::Half>(&velocity, &system.force(t, &constants, &positions))
        };
        let first = slope(t0, &y0);
        if !is_finite(&y0) || !is_finite(&first) {
            return Err(Failure::NotFinite);
        }
        let (mut error_norm, mut length, mut evaluations) = (ErrorNorm::new(groups), 0.0, 1);
        if t_end != t0 {
            // Inertias are those of the velocities alone.
            let drift = |_: f64, y: &S| joined(&system.drift(&constants, &halves(y)[1]), &R::Half::zeros());
            error_norm = ErrorNorm::probed(groups, &drift, (t0, &y0, &first)).0;
            let accuracy = (tolerance, tableau.error_order);
            length = first_step(&slope, &error_norm, (t0, &y0, &first), t_end - t0, accuracy);
            evaluations += 1;
        }
        let [_, force] = halves(&first);
        let reached = halves(&y0).map(Sum::of);
        // What steps do not change has no error.
        error_norm = error_norm.of_the_first(2 * R::Half::LEN);
        let controller = Controller::of(tableau.error_order, tableau.margin);
        let control = Control::new((t_end, tolerance), controller, length, evaluations);
        // In place: it is some kilobytes.
        Ok(Self {
            method: NystromSteps {
                system,
                constants,
                error_norm,
                step: Step::at(tableau, t0, reached),
                t: t0,
                reached,
                state: y0,
                force: Some(force),
            },
            control,
        })
    }
}

impl<S: StateVector<f64>, C, R: SecondOrder<S, C>> AdaptiveMethod for NystromSteps<S, C, R> {
    type State = S;
    const NAME: &'static str = "RungeKuttaNystrom";

    fn t(&self) -> f64 {
        self.t
    }

    /// Its positions and momenta. What is a function of the positions, which no step reads, is that of the start;
    /// [`SecondOrder::renewed`] computes it.
    fn y(&self) -> &S {
        &self.state
    }

    fn step(&mut self, control: &mut Control) -> Result<(), Failure> {
        roomiest(Advance(self, control))
    }

    /// By a shorter step of the same method from the beginning of the last one, at the cost of a rejected one.
    fn at(&mut self, t: f64, control: &mut Control) -> Result<S, Failure> {
        if t == self.t {
            return Ok(self.system.renewed(&self.state));
        }
        control.statistics.evaluations += self.step.tableau().evaluations();
        self.step.attempt((&self.system, &self.constants), t);
        let between = self.system.renewed(&self.with_end_of_step());
        if is_finite(&between) { Ok(between) } else { Err(Failure::NotFinite) }
    }

    fn exchange(&mut self, tape: &mut impl Tape) {
        tape.number(&mut self.t);
        self.reached.iter_mut().for_each(|half| tape.sum(half));
        tape.state(&mut self.state);
        let (mut is_known, mut force) = (self.force.is_some(), self.force.unwrap_or_else(R::Half::zeros));
        tape.flag(&mut is_known);
        tape.state(&mut force);
        self.force = is_known.then_some(force);
    }
}

impl<S: StateVector<f64>, C, R: SecondOrder<S, C>> Attempt for NystromSteps<S, C, R> {
    type Trial = S;

    #[inline(always)]
    fn begin(&mut self, control: &mut Control) {
        let force = self.force.unwrap_or_else(|| {
            control.statistics.evaluations += 1;
            self.system.force(self.t, &self.constants, &self.reached[0].value)
        });
        self.step.begin((&self.system, &self.constants), (self.t, &self.reached), force);
    }

    #[inline(always)]
    fn attempt(&mut self, vectors: impl Vectors, end: f64, control: &mut Control) -> Option<(S, f64)> {
        control.statistics.evaluations += self.step.tableau().evaluations();
        let h = (end - self.t).abs();
        self.step.attempt_in(vectors, (&self.system, &self.constants), end);
        let after = self.with_end_of_step();
        let [positions, momenta] = self.step.error_slopes();
        let lasting = control.controller.lasting(h);
        let largest = self.error_norm.largest(lasting, self.state.as_ref(), after.as_ref(), |range| {
            match range.start.checked_sub(R::Half::LEN) {
                Some(start) => norm(&momenta.as_ref()[start..start + range.len()]),
                None => norm(&positions.as_ref()[range]),
            }
        });
        Some((after, h / control.tolerance * largest))
    }

    #[inline(always)]
    fn accept(&mut self, state: S, end: f64, _control: &mut Control) {
        (self.t, self.state) = (end, state);
        (self.reached, self.force) = (*self.step.end(), self.step.end_force());
    }
}

impl<S: StateVector<f64>, C, R: SecondOrder<S, C>> NystromSteps<S, C, R> {
    /// The state with positions and momenta at the end of the step.
    #[inline(always)]
    fn with_end_of_step(&self) -> S {
        let mut state = self.state;
        let components = state.as_mut().chunks_exact_mut(R::Half::LEN);
        for (components, half) in components.zip(self.step.end()) {
            components.copy_from_slice(half.value.as_ref());
        }
        state
    }
}

/// An accepted step of an integration, all of it on the vectors of a processor: what is done between two steps is as long as
/// an evaluation or two.
struct Advance<'a, S, C, R: SecondOrder<S, C>>(&'a mut NystromSteps<S, C, R>, &'a mut Control);

impl<S: StateVector<f64>, C, R: SecondOrder<S, C>> Work for Advance<'_, S, C, R> {
    type Output = Result<(), Failure>;
    #[inline(always)]
    fn run(self, vectors: impl Vectors) -> Result<(), Failure> {
        self.1.by_error(self.0, vectors.rounding_as_numbers())
    }
}
