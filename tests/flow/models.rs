//! Models that are stepped.

use std::cell::Cell;
use std::rc::Rc;
use std::sync::atomic::{AtomicBool, Ordering};

use affine_runtime::force::{AtPoint, Force, Motion, PointForce, Translation};
use affine_runtime::frames::Space;
use affine_runtime::potential::{Class, Place, Potential, Slopes};
use affine_runtime::prelude::*;
use affine_runtime::scalar::Scalar;

/// A soft block that falls, with every method for free bodies.
#[affine_model(
    dim = 3,
    kinetic(dalembert = 0.25, space_translation = 1),
    potential = orthogonality(stiffness) + g*x[3],
    emit(splitting, lanes, nystrom, taylor),
)]
#[derive(Clone, Copy)]
pub(crate) struct Block {
    pub(crate) stiffness: f64,
    pub(crate) g: f64,
}

pub(crate) type Cube = PreparedBlock;

/// A disc that is driven, so that the times of its steps matter.
#[affine_model(
    dim = 2,
    kinetic(casimir2 = 0.5, body_inertia = 1),
    potential = tr(G)/2 - 2*q + 0.1*sin(2*t)*G[1,1],
    emit(splitting, lanes),
)]
#[derive(Clone, Copy)]
pub(crate) struct Driven;

/// A drop that keeps its volume.
#[affine_model(dim = 2, kinetic(dalembert = 1), constraint = isochoric, potential = tr(G))]
#[derive(Clone, Copy)]
pub(crate) struct Drop;

/// A geodesic, known in closed form.
#[affine_model(dim = 2, kinetic(casimir2 = 0.5, body_inertia = 1))]
#[derive(Clone, Copy)]
pub(crate) struct Free;

/// A geodesic in bases that are not orthonormal.
#[affine_model(
    dim = 2,
    kinetic(casimir2 = 0.5, body_inertia = 1),
    metrics(space = [[2, 0.5], [0.5, 1.5]], body = [[1, -0.4], [-0.4, 3]]),
)]
#[derive(Clone, Copy)]
pub(crate) struct Skewed;

/// Nothing keeps it from turning inside out.
#[affine_model(
    dim = 2,
    kinetic(dalembert = 1),
    potential = pull*(phi[1,1] + phi[2,2]),
    emit(splitting, lanes)
)]
#[derive(Clone, Copy)]
pub(crate) struct Dust {
    pub(crate) pull: f64,
}

/// It has no energy beyond a wall, and its steps are looked after one by one.
#[affine_model(
    dim = 2,
    kinetic(dalembert = 1, space_translation = 1),
    potential = sqrt(1 - x[1]) + orthogonality(10),
    emit(splitting, lanes)
)]
#[derive(Clone, Copy)]
pub(crate) struct Walled;

/// A body in bases that are not orthonormal, with stretches of its own.
#[affine_model(
    dim = 2,
    kinetic(casimir2 = 0.5, body_inertia = 1),
    metrics(space = [[2, 0.5], [0.5, 1.5]], body = [[1, -0.4], [-0.4, 3]]),
    potential = c*(tr(G)/2 - ln(det)),
    emit(splitting, lanes)
)]
#[derive(Clone, Copy)]
pub(crate) struct Slanted {
    pub(crate) c: f64,
}

/// Pulled back to the axis, at every point of its own.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spring(pub(crate) f64);

impl PointForce<2> for Spring {
    fn force<T: Scalar>(&self, _: T, x: &Vector<2, T>, _: &Vector<2, T>) -> Vector<2, T> {
        Vector::<2, T>::new(T::zero(), T::constant(-self.0, 0.0) * x[1])
    }
}

/// Held at two points.
#[affine_model(
    dim = 2,
    kinetic(dalembert = 1, space_translation = 1),
    potential = orthogonality(10),
    forces = custom(press, translation, position) + custom(turn, spatial, position),
    emit(splitting, lanes)
)]
#[derive(Clone, Copy, Debug)]
pub(crate) struct Held {
    pub(crate) press: AtPoint<2, Spring, Translation, 2>,
    pub(crate) turn: AtPoint<2, Spring, Space, 2>,
}

/// Held at two points, with a stiffness that is a field as well.
#[affine_model(
    dim = 2,
    kinetic(dalembert = 1, space_translation = 1),
    potential = orthogonality(stiffness),
    forces = custom(press, translation, position) + custom(turn, spatial, position),
    emit(splitting, lanes)
)]
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tightened {
    pub(crate) stiffness: f64,
    pub(crate) press: AtPoint<2, Spring, Translation, 2>,
    pub(crate) turn: AtPoint<2, Spring, Space, 2>,
}

/// A push that has no value beyond `x[1] = 2`, and notes where it is asked although no body could be there.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Push(pub(crate) &'static AtomicBool);

impl Force<2> for Push {
    type Form = Translation;
    fn force<T: Scalar>(&self, Motion { x, phi, .. }: &Motion<2, T>) -> Vector<2, T> {
        let determinant = phi[(0, 0)] * phi[(1, 1)] - phi[(0, 1)] * phi[(1, 0)];
        let is_finite = determinant * T::zero() == T::zero();
        if determinant == T::zero() || !is_finite {
            self.0.store(true, Ordering::Relaxed);
        }
        Vector::<2, T>::new((T::constant(2.0, 0.0) - x[0]).sqrt(), T::zero())
    }
}

/// Pushed along the first axis.
#[affine_model(
    dim = 2,
    kinetic(dalembert = 1, space_translation = 1),
    potential = orthogonality(10),
    forces = custom(push, translation, position),
    emit(splitting, lanes)
)]
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pushed {
    pub(crate) push: Push,
}

/// A constant force of 2 that knows how often it was asked for.
#[derive(Clone, Debug)]
pub(crate) struct Lift {
    pub(crate) asked: Rc<Cell<u32>>,
}

impl Force<2> for Lift {
    type Form = Translation;
    fn force<T: Scalar>(&self, _: &Motion<2, T>) -> Vector<2, T> {
        self.asked.set(self.asked.get() + 1);
        Vector::<2, T>::new(T::constant(2.0, 0.0), T::zero())
    }
}

/// A body of unit mass that is lifted.
#[affine_model(
    dim = 2,
    kinetic(dalembert = 1, space_translation = 1),
    forces = custom(lift, translation)
)]
#[derive(Clone)]
pub(crate) struct Counted {
    pub(crate) lift: Lift,
}

/// `-ln(1 - x[1]^2)/10`, whose slope has values behind the walls at -1 and 1 as well.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Barrier;

impl Potential<2> for Barrier {
    const CLASS: Class = Class::General;
    const POSITION: bool = true;
    fn energy<T: Scalar>(&self, Place { x, .. }: &Place<2, T>) -> T {
        T::constant(-0.1, 0.0) * (T::one() - x[0] * x[0]).ln()
    }
    fn slopes<T: Scalar>(&self, Place { x, .. }: &Place<2, T>) -> Slopes<2, T> {
        let slope = T::constant(0.2, 0.0) * x[0] / (T::one() - x[0] * x[0]);
        Slopes { x: Vector::<2, T>::new(slope, T::zero()), phi: Matrix::<2, T>::from_element(T::zero()) }
    }
}

/// A body whose centre of mass moves between the walls of [`Barrier`].
#[affine_model(
    dim = 2,
    kinetic(dalembert = 1, space_translation = 1),
    potential = orthogonality(10) + custom(barrier, general, position),
    emit(splitting, lanes)
)]
#[derive(Clone, Copy, Debug)]
pub(crate) struct Confined {
    pub(crate) barrier: Barrier,
}

pub(crate) fn block(g: f64) -> Cube {
    Block { stiffness: 100.0, g }.prepare().unwrap()
}

pub(crate) fn thrown(cube: &Cube) -> <Cube as Model<3>>::Point<f64> {
    let (x, v) = (Vector::<3>::new(0.0, 0.5, 2.0), Vector::<3>::new(1.0, 0.0, 3.0));
    let phi = Matrix::<3>::new(1.05, 0.1, 0.0, -0.1, 0.95, 0.05, 0.0, 0.02, 1.0);
    let phi_dot = Matrix::<3>::new(0.2, -1.0, 0.3, 1.1, 0.0, -0.5, -0.2, 0.4, 0.1);
    cube.at_velocity(x, phi, v, phi_dot).unwrap()
}

pub(crate) fn strained() -> Matrix<2> {
    Matrix::<2>::new(1.2, 0.3, -0.1, 0.9)
}

pub(crate) fn sheared() -> Matrix<2> {
    Matrix::<2>::new(0.2, -0.7, 0.6, -0.1)
}
