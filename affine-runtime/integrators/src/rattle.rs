//! RATTLE on `det phi = 1` and its symmetric compositions: explicit but for one number, symplectic, with a fixed step.

mod constraint;
mod layout;

pub use crate::composition::Composition;

use core::marker::PhantomData;

use super::Failure;
use super::drive::{Equal, EqualStepMethod};
use super::equal_steps::{EqualSteps, Times};
use super::finite::is_finite;
use super::lie::{Sum, adjugate};
use super::tape::Tape;
use affine_core::model::{Group, StateVector};
use constraint::{Motion, multiplier};
use layout::Layout;

/// How far a start may be off the constraint and the hidden constraint: what the rounding of input leaves. It is taken
/// out before the first step.
const START: f64 = 1e-10;

/// Integration of Hamilton's equations of `H = T(Pi) + U(t, phi)` under `det phi = 1`, from `t0` to `t_end`, in either
/// direction of time, in equal steps that are compositions of steps `h` of RATTLE (H. Andersen, J. Comput. Phys. 52
/// (1983) 24-34; Hairer, Lubich, Wanner, Geometric Numerical Integration, section VII.1.4):
///
/// ```text
/// Pi_1/2 = Pi - h/2 (dU/dphi)^T + mu adj(phi),         phi_1 = phi + h T'(Pi_1/2),       mu such that det phi_1 = 1
/// Pi_1   = Pi_1/2 - h/2 (dU/dphi_1)^T + nu adj(phi_1),            nu such that tr(phi_1^-1 T'(Pi_1)) = 0
/// ```
///
/// Orders 2, 4, 6, 8 by [`Composition`]. A step is symmetric and symplectic on the constrained phase space. `mu` is
/// iterated to rounding by Newton's method, and `nu` is linear: both constraints hold to rounding at each step, whatever
/// the number of steps. Multipliers change neither spin nor vorticity, whose conservation is that of the free steps:
/// exact up to rounding where `U` is invariant. States are summed with compensation.
///
/// Where a step is far too long for the motion, `mu` need not be unique: the one found is the one that the iteration leads
/// to from the multiplier of the step before.
///
/// The equations are those of the body without constraint: the state holds the groups `phi` and `Pi`, with `x` and `p`
/// or without, and its time derivative is `T'(Pi)` and the force. A multiple of `adj(phi)` in the force is immaterial.
/// Where the state holds the work too, whose time derivative is the power, a step adds `h/2` times the powers at its ends: with
/// that it is as symmetric, and compositions give the work to their order.
///
/// One evaluation for each step of RATTLE, two where the state holds the work; at the start two and one for each component of the
/// momenta, from which the matrix of `T'` is read.
pub type Rattle<const N: usize, S, F> = Equal<RattleSteps<N, S, F>>;

/// Steps of RATTLE.
#[derive(Clone)]
pub struct RattleSteps<const N: usize, S, F> {
    f: F,
    layout: Layout<N>,
    composition: &'static Composition,
    evaluations: u64,
    residual: f64,
    state: PhantomData<S>,
}

/// A state with the forces there.
#[derive(Clone, Copy)]
pub struct Point<S> {
    state: Sum<S>,
    rates: S,
    /// The last multiplier over its step: where the next one is looked for.
    multiplier: f64,
}

impl<const N: usize, S: StateVector<f64>, F: Fn(f64, &S) -> S> Equal<RattleSteps<N, S, F>> {
    /// The integration at its start; `groups` lay out the state.
    ///
    /// # Errors
    /// [`Failure::NotSeparable`] unless the groups are `phi` and `Pi`, with `x` and `p` or without, with the work or without, and
    /// velocities are linear in the momenta and independent of the placement; [`Failure::OffConstraint`] where the start is not on
    /// the constraints; [`Failure::NotFinite`]; [`Failure::Step`] where `step` is not positive, not finite, or gives more
    /// steps than there are floating-point times.
    pub fn new(
        f: F,
        groups: &[Group],
        composition: &'static Composition,
        (t0, y0): (f64, S),
        t_end: f64,
        step: f64,
    ) -> Result<Self, Failure> {
        let times = Times::new(t0, t_end, step)?;
        if !is_finite(&y0) {
            return Err(Failure::NotFinite);
        }
        let layout = Layout::of(groups, &f, (t0, &y0))?;
        let mut state = y0;
        let defect = constraint::settle(&layout, &mut state);
        if defect.is_nan() {
            return Err(Failure::NotFinite);
        }
        if defect > START {
            return Err(Failure::OffConstraint { defect });
        }
        let rates = f(t0, &state);
        if !is_finite(&rates) {
            return Err(Failure::NotFinite);
        }
        let start = Point { state: Sum::of(state), rates, multiplier: 0.0 };
        let evaluations = layout.evaluations() + 1;
        let method = RattleSteps { f, layout, composition, evaluations, residual: 0.0, state: PhantomData };
        Ok(Self { method, steps: EqualSteps::at(times, start) })
    }
}

impl<const N: usize, S: StateVector<f64>, F: Fn(f64, &S) -> S> EqualStepMethod for RattleSteps<N, S, F> {
    type State = S;
    type Point = Point<S>;
    const NAME: &'static str = "Rattle";

    fn state(point: &Point<S>) -> &S {
        &point.state.value
    }

    /// # Errors
    /// [`Failure::NoSolution`] with what is left of `det phi - 1`.
    fn step(&mut self, (t, point): (f64, &mut Point<S>), h: f64, _last: Option<f64>) -> Result<(), Failure> {
        let mut part = 0.0;
        for weight in self.composition.weights() {
            let from = t + part * h;
            part += weight;
            *point = self.one(from + weight * h, *point, weight * h)?;
        }
        Ok(())
    }

    fn evaluations(&self) -> u64 {
        self.evaluations
    }

    fn exchange(&mut self, tape: &mut impl Tape) {
        tape.number(&mut self.residual);
        tape.bits(&mut self.evaluations);
    }

    fn exchange_point(tape: &mut impl Tape, point: &mut Point<S>) {
        tape.sum(&mut point.state);
        tape.state(&mut point.rates);
        tape.number(&mut point.multiplier);
    }

    /// `|det phi - 1|` that the iteration left, relative to the products in the determinant.
    fn residual(&self) -> Option<f64> {
        Some(self.residual)
    }
}

impl<const N: usize, S: StateVector<f64>, F: Fn(f64, &S) -> S> RattleSteps<N, S, F> {
    /// One step of RATTLE, which ends at the time `end`.
    fn one(&mut self, end: f64, begin: Point<S>, h: f64) -> Result<Point<S>, Failure> {
        let normal = self.normal(&begin.state.value);
        let mut state = begin.state.plus(&self.layout.kick(&begin.rates, 0.5 * h));
        let free = self.layout.drift(&state.value, h);
        let along = self.layout.drift(&normal, h);
        let motion = Motion {
            phi: self.layout.placement(&begin.state.value),
            carry: self.layout.placement(&begin.state.carry),
            free: self.layout.placement(&free),
            along: self.layout.placement(&along),
        };
        let found = multiplier(&motion, begin.multiplier * h)?;
        self.residual = if found.residual > self.residual { found.residual } else { self.residual };
        let mut rise = free;
        for ((rise, along), normal) in rise.as_mut().iter_mut().zip(along.as_ref()).zip(normal.as_ref()) {
            *rise += found.value * (along + normal);
        }
        state = state.plus(&rise);

        let mut rates = (self.f)(end, &state.value);
        self.evaluations += 1;
        state = state.plus(&self.layout.kick(&rates, 0.5 * h));
        let normal = self.normal(&state.value);
        state = constraint::tangent(&self.layout, state, &normal);
        if self.layout.has_work() {
            // The power is that of the velocities at the end, which the forces there have changed.
            rates = (self.f)(end, &state.value);
            self.evaluations += 1;
            state = state.plus(&self.layout.work([&begin.rates, &rates], h));
        }
        if !is_finite(&rates) || !is_finite(&state.value) {
            return Err(Failure::NotFinite);
        }
        Ok(Point { state, rates, multiplier: found.value / h })
    }

    /// The momentum `adj(phi)`, along which the constraint acts.
    fn normal(&self, state: &S) -> S {
        self.layout.momentum(&adjugate(&self.layout.placement(state)))
    }
}
