//! What a run asks of a model.

use super::Method;
use super::recorder::Recorder;
use crate::error::Reason;
use crate::frames::Matrix;
use crate::geodesic::Geodesic;
use crate::metrics::Bases;
use crate::model::{Description, Model, Regularity, Velocity};

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
    fn domain(&self, t: f64, point: &P, each: &mut dyn FnMut(f64));
    fn velocity(&self, point: &P) -> Velocity<N>;
    fn geodesic(&self, t0: f64, point: &P) -> Option<Geodesic<N>>;
    fn on_geodesic(&self, geodesic: &Geodesic<N>, t: f64, start: &P) -> P;
    /// Energy and equations of motion at a point, number by number.
    fn witness(&self, t: f64, point: &P, each: &mut dyn FnMut(f64));
    /// Follows the motion from a point by the steps of a method.
    fn integrate(&self, course: &Course<'_, P>, recorder: &mut Recorder<'_, '_, N, P>) -> Result<(), Reason>;
}

/// What is to be integrated.
#[derive(Clone, Copy)]
pub(super) struct Course<'p, P> {
    pub(super) t0: f64,
    pub(super) start: &'p P,
    pub(super) t_end: f64,
    pub(super) method: Method,
    pub(super) tolerance: f64,
}

/// Follows the motion of a model by integrators that are compiled for it.
pub(super) type Integrate<const N: usize, M> = fn(
    &M,
    &Course<'_, <M as Model<N>>::Point<f64>>,
    &mut Recorder<'_, '_, N, <M as Model<N>>::Point<f64>>,
) -> Result<(), Reason>;

/// A model with what integrates it.
pub(super) struct Moving<'a, const N: usize, M: Model<N>> {
    pub(super) model: &'a M,
    pub(super) integrate: Integrate<N, M>,
}

impl<const N: usize, M: Model<N>> Mechanics<N, M::Point<f64>> for Moving<'_, N, M> {
    fn description(&self) -> &'static Description {
        const { &M::DESCRIPTION }
    }
    fn bases(&self) -> Option<Bases<N>> {
        self.model.bases()
    }
    fn condition(&self, phi: &Matrix<N>) -> Option<f64> {
        if const { M::DESCRIPTION.signature.is_none() } { self.model.condition(phi) } else { None }
    }
    fn regularity(&self, phi: &Matrix<N>) -> Option<Regularity> {
        self.model.regularity(phi)
    }
    fn hamiltonian(&self, t: f64, point: &M::Point<f64>) -> f64 {
        self.model.hamiltonian(t, point)
    }
    fn domain(&self, t: f64, point: &M::Point<f64>, each: &mut dyn FnMut(f64)) {
        self.model.domain(t, point, each);
    }
    fn velocity(&self, point: &M::Point<f64>) -> Velocity<N> {
        self.model.velocity(point)
    }
    fn geodesic(&self, t0: f64, point: &M::Point<f64>) -> Option<Geodesic<N>> {
        self.model.geodesic(t0, point)
    }
    fn on_geodesic(&self, geodesic: &Geodesic<N>, t: f64, start: &M::Point<f64>) -> M::Point<f64> {
        self.model.on_geodesic(geodesic, t, start)
    }
    fn witness(&self, t: f64, point: &M::Point<f64>, each: &mut dyn FnMut(f64)) {
        each(self.model.hamiltonian(t, point));
        let (reduced, constants) = self.model.reduce(t, point);
        let rates = self.model.reduced_equations(t, &constants, &reduced);
        rates.as_ref().iter().for_each(|rate| each(*rate));
    }
    fn integrate(
        &self,
        course: &Course<'_, M::Point<f64>>,
        recorder: &mut Recorder<'_, '_, N, M::Point<f64>>,
    ) -> Result<(), Reason> {
        (self.integrate)(self.model, course, recorder)
    }
}
