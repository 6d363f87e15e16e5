//! Forces at material points.

use core::marker::PhantomData;

use affine_core::force::{Force, Motion, Translation};

use crate::frames::{Body, Matrix, Space, Vector};
use crate::scalar::Scalar;

/// A force on a material point as a function of where the point is and how it moves, in space: contact, a spring, the wind on
/// a sail. [`AtPoint`] is what a body feels of it.
pub trait PointForce<const N: usize> {
    /// The force at a time on the point at `x` that moves at `v`: a covector, of the power `f . v`.
    fn force<T: Scalar>(&self, t: T, x: &Vector<N, T>, v: &Vector<N, T>) -> Vector<N, T>;
}

/// A [`PointForce`] at some points of the body, as the [`Force`] that it is on the momentum `Q` stands for.
///
/// The point of the body `a` is at `x_a = x + phi a` and moves at `v_a = x_dot + phi_dot a`. The power `f . v_a` of a force `f`
/// there is that of
///
/// ```text
/// Translation:  Q_tr  = f                  on p
/// Space:        Q     = (phi a) f^T        on Sigma
/// Body:         Q_hat = a (phi^T f)^T      on Sigma_hat
/// ```
///
/// (the dipole of forces of Slawianowski et al., section 3). A body whose centre is free feels the first with one of the others,
/// in two fields; of the others that of its own frame costs less. A body whose centre is fixed feels one of the others alone.
///
/// ```
/// use affine_runtime::force::{AtPoint, PointForce, Translation};
/// use affine_runtime::frames::Space;
/// use affine_runtime::prelude::*;
/// use affine_runtime::scalar::Scalar;
///
/// /// The ground presses what is below `x_2 = 0` upward.
/// #[derive(Clone, Copy)]
/// struct Ground {
///     stiffness: f64,
/// }
///
/// impl PointForce<2> for Ground {
///     fn force<T: Scalar>(&self, _: T, x: &Vector<2, T>, _: &Vector<2, T>) -> Vector<2, T> {
///         let depth = (-x[1]).max(T::zero());
///         Vector::<2, T>::new(T::zero(), T::constant(self.stiffness, 0.0) * depth)
///     }
/// }
///
/// type Feet<Q> = AtPoint<2, Ground, Q, 2>;
///
/// #[affine_model(
///     dim = 2,
///     kinetic(dalembert = 0.1, space_translation = 1),
///     potential = orthogonality(100) + 9.81*x[2],
///     forces = custom(press, translation) + custom(turn, spatial),
/// )]
/// #[derive(Clone)]
/// struct Table {
///     press: Feet<Translation>,
///     turn: Feet<Space>,
/// }
///
/// let ground = Ground { stiffness: 400.0 };
/// let feet = [[-1.0, -0.5], [1.0, -0.5]];
/// let table = Table { press: AtPoint::new(feet, ground), turn: AtPoint::new(feet, ground) }.prepare()?;
/// let x = Vector::<2>::new(0.0, 0.5);
/// let start = table.at_velocity(x, Matrix::identity(), Vector::zeros(), Matrix::zeros())?;
/// let run = Simulation::new(&table, start).until(1.0).run()?;
/// assert!(run.points().iter().all(|point| point.x()[1] > 0.4), "it stands on its feet");
/// # Ok::<(), affine_runtime::Error>(())
/// ```
///
/// Forces are written for all numbers, and [`Scalar::max`] and [`Scalar::min`] take the place of branches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AtPoint<const N: usize, F, Q, const POINTS: usize = 1> {
    points: [[f64; N]; POINTS],
    force: F,
    on: PhantomData<Q>,
}

impl<const N: usize, F, Q, const POINTS: usize> AtPoint<N, F, Q, POINTS> {
    /// A force at points of the body, in the bases that the user states the model in.
    pub const fn new(points: [[f64; N]; POINTS], force: F) -> Self {
        Self { points, force, on: PhantomData }
    }
}

impl<const N: usize, F: PointForce<N>, Q, const POINTS: usize> AtPoint<N, F, Q, POINTS> {
    /// The force at each point, with `a` and `phi a`.
    fn each<T: Scalar>(
        &self,
        motion: &Motion<N, T>,
        mut felt: impl FnMut(&Vector<N, T>, &Vector<N, T>, &Vector<N, T>),
    ) {
        for point in &self.points {
            let a = Vector::<N, T>::from_fn(|i, _| T::constant(point[i], 0.0));
            let (arm, turning) = (carried(&motion.phi, &a), carried(&motion.phi_dot, &a));
            let force = self.force.force(motion.t, &(motion.x + arm), &(motion.x_dot + turning));
            felt(&force, &a, &arm);
        }
    }

    /// The sum of `left right^T`.
    fn dipole<T: Scalar>(
        &self,
        motion: &Motion<N, T>,
        sides: impl Fn(&Vector<N, T>, &Vector<N, T>, &Vector<N, T>) -> [Vector<N, T>; 2],
    ) -> Matrix<N, T> {
        let mut sum = Matrix::<N, T>::from_fn(|_, _| T::zero());
        self.each(motion, |force, a, arm| {
            let [left, right] = sides(force, a, arm);
            for i in 0..N {
                for j in 0..N {
                    sum[(i, j)] = sum[(i, j)].plus(left[i], right[j]);
                }
            }
        });
        sum
    }
}

/// `m a`.
fn carried<const N: usize, T: Scalar>(m: &Matrix<N, T>, a: &Vector<N, T>) -> Vector<N, T> {
    Vector::<N, T>::from_fn(|i, _| (1..N).fold(m[(i, 0)] * a[0], |sum, j| sum.plus(m[(i, j)], a[j])))
}

impl<const N: usize, F: PointForce<N>, const POINTS: usize> Force<N> for AtPoint<N, F, Translation, POINTS> {
    type Form = Translation;

    fn force<T: Scalar>(&self, motion: &Motion<N, T>) -> Vector<N, T> {
        let mut sum = Vector::<N, T>::from_fn(|_, _| T::zero());
        self.each(motion, |force, _, _| sum += force);
        sum
    }
}

impl<const N: usize, F: PointForce<N>, const POINTS: usize> Force<N> for AtPoint<N, F, Space, POINTS> {
    type Form = Space;

    fn force<T: Scalar>(&self, motion: &Motion<N, T>) -> Matrix<N, T> {
        self.dipole(motion, |force, _, arm| [*arm, *force])
    }
}

impl<const N: usize, F: PointForce<N>, const POINTS: usize> Force<N> for AtPoint<N, F, Body, POINTS> {
    type Form = Body;

    fn force<T: Scalar>(&self, motion: &Motion<N, T>) -> Matrix<N, T> {
        self.dipole(motion, |force, a, _| [*a, carried(&motion.phi.transpose(), force)])
    }
}
