//! Material points of a body and rates of its deformation, and moments about points of space (Slawianowski et al., sections 2 to
//! 4).

use crate::decompose::LinearMap;
use crate::frames::{Comoving, Matrix, Spatial, Vector};
use crate::kinematics::{AffineMomentum, InertialQuadrupole, LinearVelocity};
use crate::model::Velocity;
use crate::scalar::Real;
use crate::state::{Euclidean, Phase};

/// Where material points are and how they move, and moments about points other than the origin of space.
///
/// The body point `a` counts from the centre of mass, in the bases that the model is stated in; nothing but the rates needs a
/// metric.
///
/// ```
/// use affine_runtime::material::Material;
/// use affine_runtime::prelude::*;
///
/// #[affine_model(dim = 2, kinetic(dalembert = 1, space_translation = 1))]
/// struct Sheet;
///
/// let (x, v) = (Vector::<2>::new(1.0, 2.0), Vector::<2>::new(0.5, 0.0));
/// let start = Sheet.at_velocity(x, Matrix::<2>::identity() * 2.0, v, Matrix::<2>::new(0.0, -1.0, 1.0, 0.0))?;
/// let velocity = Sheet.velocity(&start);
/// let corner = Vector::<2>::new(1.0, 0.0);
/// assert_eq!(start.place(&corner), Vector::<2>::new(3.0, 2.0));
/// assert_eq!(start.velocity_of(&velocity, &corner), Vector::<2>::new(0.5, 1.0));
/// # Ok::<(), affine_runtime::Error>(())
/// ```
pub trait Material<const N: usize, T: Real = f64>: Phase<N, T> {
    /// Where the body point `a` is: `y = x + phi a`.
    fn place(&self, a: &Vector<N, T>) -> Vector<N, T> {
        self.x() + self.phi() * a
    }
    /// The body point at `y`: `a = phi^-1 (y - x)`.
    fn point_at(&self, y: &Vector<N, T>) -> Vector<N, T> {
        self.phi().inverse() * (y - self.x())
    }
    /// Lagrange's velocity field, that of the body point `a` in space: `x_dot + phi_dot a`.
    fn velocity_of(&self, velocity: &Velocity<N, T>, a: &Vector<N, T>) -> Vector<N, T> {
        velocity.x_dot + velocity.phi_dot * a
    }
    /// Euler's velocity field, that of the body point that passes `y`: `x_dot + Omega (y - x)`.
    fn velocity_at(&self, velocity: &Velocity<N, T>, y: &Vector<N, T>) -> Vector<N, T> {
        velocity.x_dot + velocity.phi_dot * self.point_at(y)
    }
    /// The velocity of the body point `a` as the body sees it: `v_hat + Omega_hat a = phi^-1 (x_dot + phi_dot a)`.
    fn comoving_velocity_of(
        &self,
        velocity: &Velocity<N, T>,
        a: &Vector<N, T>,
    ) -> Comoving<LinearVelocity<N, T>> {
        Comoving(LinearVelocity(self.phi().inverse() * self.velocity_of(velocity, a)))
    }

    /// The rate `dG/dt = phi_dot^T phi + phi^T phi_dot = Omega_hat^T G + G Omega_hat`.
    fn green_rate(&self, velocity: &Velocity<N, T>) -> Comoving<Matrix<N, T>>
    where
        Self: Euclidean,
    {
        let half = velocity.phi_dot.tr_mul(self.phi());
        Comoving(half + half.transpose())
    }
    /// The rate `dC/dt = -(Omega^T C + C Omega)`, by which the acceleration of the drunk missile is stated (section 4).
    fn cauchy_rate(&self, velocity: &Velocity<N, T>) -> Spatial<Matrix<N, T>>
    where
        Self: Euclidean,
    {
        let inverse = self.phi().inverse();
        let half = inverse.tr_mul(&inverse) * velocity.phi_dot * inverse;
        Spatial(-(half + half.transpose()))
    }

    /// The total affine momentum about the point `o` of space: `I(o) = (x - o) p^T + Sigma`. The angular momentum about `o` is
    /// that [of it](Spatial::angular_momentum).
    fn affine_momentum_about(&self, o: &Vector<N, T>) -> Spatial<AffineMomentum<N, T>> {
        Spatial(AffineMomentum((self.x() - o) * self.p().transpose() + self.sigma().0.0))
    }
    /// The dipole of the kinematical momentum about the point `o` of space, of a body with mass `m` and quadrupole `J`:
    /// `K(o) = int (y - o) v^T dmu = m (x - o) x_dot^T + phi J phi_dot^T` (3.7). Its doubled skew part `K - K^T` is the
    /// kinematical angular momentum about `o`.
    fn kinematical_dipole_about(
        &self,
        o: &Vector<N, T>,
        velocity: &Velocity<N, T>,
        (mass, quadrupole): (T, Comoving<InertialQuadrupole<N, T>>),
    ) -> Matrix<N, T> {
        (self.x() - o) * velocity.x_dot.transpose() * mass
            + self.phi() * quadrupole.0.0 * velocity.phi_dot.transpose()
    }
}

impl<const N: usize, T: Real, P: Phase<N, T>> Material<N, T> for P {}
