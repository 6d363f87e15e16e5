//! The variational equations: how a motion changes with its start.

use crate::dual::Dual;
use crate::inner::{DEFAULT_MAX_STEPS, norm, sound};
use crate::integrate::{Failure, RungeKutta8};
use crate::model::{Group, Model, StateVector};
use crate::scalar::Scalar;

/// `emit(tangent)`: the variational equations `(dy)' = f'(t, y) dy` beside `y' = f(t, y)`, over the reduced state;
/// [`Variation`] integrates them.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no variational equations",
    label = "`emit(tangent)` is missing",
    note = "write `emit(tangent)` in its `#[affine_model(...)]`"
)]
pub trait Tangent<const N: usize>: Model<N> {
    /// The reduced state, then its change.
    type Varied<T: Scalar>: StateVector<T>;
    /// Layout of both, for the norm of errors: the change is one group, beside that of the work.
    const VARIED: &'static [Group];

    /// Time derivatives of state and change. The slopes of the constants are their derivatives along the direction.
    fn variational_equations<T: Scalar>(
        &self,
        t: T,
        constants: &Self::Constants<Dual<T>>,
        varied: &Self::Varied<T>,
    ) -> Self::Varied<T>;
}

/// A motion and its derivative with respect to the start, along one direction.
///
/// ```text
/// y' = f(t, y),   (dy)' = f'(t, y) dy,        dpoint(t) = d expand(t, y) dy,   dy(t0) = d reduce(t0, point0) dpoint0
/// ```
///
/// The reduced state and its change are integrated together, by [`RungeKutta8`] with the error of both below the
/// tolerance; reduction and expansion are differentiated by dual numbers, what the trajectory conserves included. The motion is
/// followed as far as its equations have values, through `det phi = 0` too, where a [`Simulation`](crate::Simulation) stops.
/// Under a constraint a direction is one of the group: it holds the slopes of a curve of points on it, and changes do.
/// Directions and changes are plain arrays in the layout of [`Description::full`](crate::model::Description::full), like
/// [`Model::flatten`] gives points.
///
/// ```
/// use affine_runtime::prelude::*;
/// use affine_runtime::variation::Variation;
///
/// #[affine_model(dim = 2, kinetic(casimir2 = 0.2, body_inertia = 1), potential = (tr(G) - 2 - 2*ln(det))/2, emit(tangent))]
/// struct Body;
///
/// let start = Body.at_momentum(Matrix::<2>::new(1.2, 0.1, 0.0, 0.9), Comoving(Matrix::<2>::new(0.3, 0.5, -0.4, 0.1)))?;
/// // The momentum grows by one in its first component.
/// let direction = [0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0];
/// let mut variation = Variation::new(&Body, (0.0, &start), &direction, 1e-12)?;
/// variation.advance_to(3.0)?;
/// let (point, change) = (variation.point(), variation.change());
/// println!("{point:?} {change:?} {}", variation.exponent());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Variation<'a, const N: usize, M: Tangent<N>> {
    model: &'a M,
    constants: M::Constants<Dual<f64>>,
    t0: f64,
    t: f64,
    state: M::Varied<f64>,
    start: f64,
    tolerance: f64,
}

impl<'a, const N: usize, M: Tangent<N>> Variation<'a, N, M> {
    /// The motion through `point` at time `t0`, and its derivative along `direction` there. The tolerance bounds the
    /// relative error of each step.
    ///
    /// # Errors
    /// [`Failure::NotFinite`] where the reduced state has no derivative along the direction: where it depends on the
    /// direction of a linear momentum that vanishes. [`Failure::Time`] for a time that is not finite and
    /// [`Failure::Tolerance`] for a tolerance that is no positive number.
    pub fn new(
        model: &'a M,
        (t0, point): (f64, &M::Point<f64>),
        direction: &M::Full<f64>,
        tolerance: f64,
    ) -> Result<Self, Failure> {
        sound(t0, t0, tolerance)?;
        let mut full = M::Full::<Dual<f64>>::zeros();
        let parts = model.flatten(point);
        for (both, (value, slope)) in
            full.as_mut().iter_mut().zip(parts.as_ref().iter().zip(direction.as_ref()))
        {
            *both = Dual { value: *value, slope: *slope };
        }
        let (reduced, constants) = model.reduce(Dual::fixed(t0), &model.unflatten(&full));
        let mut state = M::Varied::<f64>::zeros();
        let (values, slopes) = state.as_mut().split_at_mut(reduced.as_ref().len());
        for ((value, slope), both) in values.iter_mut().zip(slopes).zip(reduced.as_ref()) {
            (*value, *slope) = (both.value, both.slope);
        }
        if !state.as_ref().iter().all(|number| number.is_finite()) {
            return Err(Failure::NotFinite);
        }
        Ok(Self { model, constants, t0, t: t0, state, start: norm(direction.as_ref()), tolerance })
    }

    /// Moves to the time `t`, forward or backward, and stands there exactly.
    ///
    /// # Errors
    /// [`Failure`]; the variation stays where it was.
    pub fn advance_to(&mut self, t: f64) -> Result<(), Failure> {
        sound(self.t, t, self.tolerance)?;
        let rates =
            |t: f64, state: &M::Varied<f64>| self.model.variational_equations(t, &self.constants, state);
        let steps = RungeKutta8::new(rates, M::VARIED, (self.t, self.state), t, self.tolerance)?;
        let state = steps.finish(DEFAULT_MAX_STEPS)?;
        (self.t, self.state) = (t, state);
        Ok(())
    }

    /// Time reached.
    #[must_use]
    pub fn t(&self) -> f64 {
        self.t
    }

    /// The phase point.
    #[must_use]
    pub fn point(&self) -> M::Point<f64> {
        let mut full = M::Full::<f64>::zeros();
        let both = self.full();
        full.as_mut().iter_mut().zip(both.as_ref()).for_each(|(value, both)| *value = both.value);
        self.model.unflatten(&full)
    }

    /// The derivative of the phase point with respect to the start, along the direction.
    #[must_use]
    pub fn change(&self) -> M::Full<f64> {
        let mut change = M::Full::<f64>::zeros();
        let both = self.full();
        change.as_mut().iter_mut().zip(both.as_ref()).for_each(|(slope, both)| *slope = both.slope);
        change
    }

    /// The finite-time Lyapunov exponent along the direction, `ln(|dpoint(t)|/|dpoint(t0)|)/(t - t0)` in the Euclidean
    /// norm of the plain array; its limit is the largest one for almost every direction. NaN at the start.
    #[must_use]
    pub fn exponent(&self) -> f64 {
        libm::log(norm(self.change().as_ref()) / self.start) / (self.t - self.t0)
    }

    /// The point with its change, as a plain array.
    fn full(&self) -> M::Full<Dual<f64>> {
        let mut reduced = M::Reduced::<Dual<f64>>::zeros();
        let (values, slopes) = self.state.as_ref().split_at(reduced.as_ref().len());
        for (both, (value, slope)) in reduced.as_mut().iter_mut().zip(values.iter().zip(slopes)) {
            *both = Dual { value: *value, slope: *slope };
        }
        self.model.flatten(&self.model.expand(Dual::fixed(self.t), &self.constants, &reduced))
    }
}
