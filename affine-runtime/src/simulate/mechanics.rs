//! What a run asks of a model.

use super::course::{Choice, Course};
use super::cubic::{Knot, on_cubic};
use super::friction::rate_of_friction;
use super::motion::{Begin, Follow, Followed, Goal, Purpose};
use super::stiffness::would_pass_over;
use crate::error::Reason;
use crate::frames::Matrix;
use crate::geodesic::Geodesic;
use crate::inner::vectorized;
use crate::metrics::Bases;
use crate::model::{Description, Model, Regularity, StateVector, Velocity};

/// A model as far as its phase points go, and the motion from one of them, in whatever variables.
///
/// A run calls it at outputs, and once for each integration: what is behind `dyn` is compiled for each model, and the run
/// itself only once for each kind of phase point.
pub(super) trait Mechanics<const N: usize, P> {
    fn description(&self) -> &'static Description;
    fn bases(&self) -> Option<Bases<N>>;
    /// Only where coefficients are fields: numbers were checked when the model was compiled.
    fn condition(&self, phi: &Matrix<N>) -> Option<f64>;
    fn regularity(&self, phi: &Matrix<N>) -> Option<Regularity>;
    fn hamiltonian(&self, t: f64, point: &P) -> f64;
    fn power(&self, t: f64, point: &P) -> f64;
    /// How fast friction takes velocities away at a point, where that is known.
    fn rate_of_friction(&self, t: f64, point: &P) -> Option<f64>;
    /// How many radians of a stiff dilatation steps by pieces would pass over, which were not emitted.
    fn would_pass_over(&self, course: &Course<'_, P>) -> Option<f64>;
    fn domain(&self, t: f64, point: &P, each: &mut dyn FnMut(f64));
    fn velocity(&self, point: &P) -> Velocity<N>;
    /// Sets a knot to a point.
    fn knot(&self, t: f64, point: &P, knot: &mut Knot);
    /// The points after each quarter of a step, on the cubic between its ends, if it tells the motion.
    fn on_cubic(&self, ends: [&Knot; 2]) -> Option<[P; 3]>;
    fn geodesic(&self, t0: f64, point: &P) -> Option<Geodesic<N>>;
    fn on_geodesic(&self, geodesic: &Geodesic<N>, t: f64, start: &P) -> P;
    /// When a closed form leaves GL+(n).
    fn collapse(&self, geodesic: &Geodesic<N>, t_end: f64, start: &Matrix<N>) -> Option<f64>;
    /// Energy and equations of motion at a point, number by number.
    fn witness(&self, t: f64, point: &P, each: &mut dyn FnMut(f64));
}

/// What a run asks besides: the motion, followed to one end.
pub(super) trait Moves<const N: usize, P>: Mechanics<N, P> {
    /// Begins to integrate, by the method that is chosen, and follows the motion.
    fn follow(
        &self,
        course: &Course<'_, P>,
        choice: &mut Choice,
        then: &mut Follow<'_, P>,
    ) -> Result<(), Reason>;
}

/// A model with what integrates it.
#[derive(Clone)]
pub(super) struct Moving<'a, const N: usize, H: Purpose<'a, N>> {
    pub(super) handle: H,
    pub(super) begin: Begin<'a, N, H>,
}

impl<'a, const N: usize, M: Model<N>, H: Purpose<'a, N, Model = M>> Mechanics<N, M::Point<f64>>
    for Moving<'a, N, H>
{
    fn description(&self) -> &'static Description {
        const { &M::DESCRIPTION }
    }
    fn bases(&self) -> Option<Bases<N>> {
        self.handle.model().bases()
    }
    fn condition(&self, phi: &Matrix<N>) -> Option<f64> {
        if const { M::DESCRIPTION.signature.is_none() } { self.handle.model().condition(phi) } else { None }
    }
    fn regularity(&self, phi: &Matrix<N>) -> Option<Regularity> {
        self.handle.model().regularity(phi)
    }
    fn hamiltonian(&self, t: f64, point: &M::Point<f64>) -> f64 {
        self.handle.model().hamiltonian(t, point)
    }
    fn power(&self, t: f64, point: &M::Point<f64>) -> f64 {
        self.handle.model().power(t, point)
    }
    fn rate_of_friction(&self, t: f64, point: &M::Point<f64>) -> Option<f64> {
        rate_of_friction::<N, M>(self.handle.model(), (t, point)).rate
    }
    fn would_pass_over(&self, course: &Course<'_, M::Point<f64>>) -> Option<f64> {
        would_pass_over::<N, M>(self.handle.model(), course)
    }
    fn domain(&self, t: f64, point: &M::Point<f64>, each: &mut dyn FnMut(f64)) {
        self.handle.model().domain(t, point, each);
    }
    fn velocity(&self, point: &M::Point<f64>) -> Velocity<N> {
        self.handle.model().velocity(point)
    }
    fn knot(&self, t: f64, point: &M::Point<f64>, knot: &mut Knot) {
        knot.set(self.handle.model(), t, point);
    }
    fn on_cubic(&self, ends: [&Knot; 2]) -> Option<[M::Point<f64>; 3]> {
        let mut quarters = [M::Full::<f64>::zeros(); 3];
        let is_told = vectorized(
            #[inline(always)]
            || on_cubic::<N, M>(ends, &mut quarters),
        );
        is_told.then(|| quarters.each_ref().map(|full| self.handle.model().unflatten(full)))
    }
    fn geodesic(&self, t0: f64, point: &M::Point<f64>) -> Option<Geodesic<N>> {
        self.handle.model().geodesic(t0, point)
    }
    fn on_geodesic(&self, geodesic: &Geodesic<N>, t: f64, start: &M::Point<f64>) -> M::Point<f64> {
        self.handle.model().on_geodesic(geodesic, t, start)
    }
    fn collapse(&self, geodesic: &Geodesic<N>, t_end: f64, start: &Matrix<N>) -> Option<f64> {
        self.handle.model().collapse(geodesic, t_end, start)
    }
    fn witness(&self, t: f64, point: &M::Point<f64>, each: &mut dyn FnMut(f64)) {
        each(self.handle.model().hamiltonian(t, point));
        let (reduced, constants) = self.handle.model().reduce(t, point);
        let rates = self.handle.model().reduced_equations(t, &constants, &reduced);
        rates.as_ref().iter().for_each(|rate| each(*rate));
    }
}

impl<'a, const N: usize, M: Model<N>> Moves<N, M::Point<f64>> for Moving<'a, N, Followed<'a, M>> {
    fn follow(
        &self,
        course: &Course<'_, M::Point<f64>>,
        choice: &mut Choice,
        then: &mut Follow<'_, M::Point<f64>>,
    ) -> Result<(), Reason> {
        let then: &mut Follow<'_, M::Point<f64>> = &mut |motion, choice| then(motion, choice);
        let goal = Goal { choice, then };
        (self.begin)(&self.handle, course, goal)
    }
}
