//! What the macro generates for a model, as a trait.

use core::fmt::Debug;

use crate::condition::condition;
pub use crate::constraint::Constraint;
pub use crate::description::{
    Bound, Component, Conserved, Description, Entry, Formula, Guard, LeftOut, Operations, Scope,
};
use crate::matrix::{Matrix, Vector};
use crate::metrics::{Bases, Tensor};
pub use crate::quantity::{Group, Quantity};
pub use crate::regularity::Regularity;
use crate::scalar::{Real, Scalar};
use crate::state::Phase;
pub use crate::system::StateVector;
use crate::system::{NotEmitted, Packing, Pieces, SecondOrder, Series, Unconstrained};
pub use crate::velocity::Velocity;

/// A model of an affinely-rigid body in dimension `N`: Legendre transformation, Hamiltonian, Hamilton's
/// equations and the reduced system that is integrated.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a prepared model of an affinely-rigid body in dimension {N}",
    label = "no Hamilton equations here",
    note = "put `#[affine_model(...)]` on the struct; a struct with fields becomes a model by `.prepare()?`"
)]
pub trait Model<const N: usize> {
    /// Names, equations, counts and conserved quantities, as derived.
    const DESCRIPTION: Description;

    /// A phase point of this model.
    type Point<T: Real>: Phase<N, T>;
    /// What is integrated: the state variables left once everything conserved and everything solvable in
    /// closed form is taken out; see [`Description::reduced`] for the layout.
    type Reduced<T: Scalar>: StateVector<T>;
    /// What one trajectory conserves.
    type Constants<T: Scalar>: Copy + Debug + Send + Sync;
    /// Phase point as a plain array in the model's own frames; see [`Description::full`] for the layout.
    type Full<T: Scalar>: StateVector<T>;

    /// The velocities `(x_dot, phi_dot)` of a phase point: the inverse Legendre transformation.
    fn velocity<T: Real>(&self, point: &Self::Point<T>) -> Velocity<N, T>;
    /// The kinetic energy `T` of velocities at the placement `phi`. With `casimir3` in `hamiltonian(...)` there is no
    /// such function, for several momenta have one velocity: `T = tr(X O) + p.v - H_kin` is one of the momenta, and a
    /// call of this method does not compile.
    fn kinetic_energy<T: Real>(&self, phi: &Matrix<N, T>, velocity: &Velocity<N, T>) -> T;
    /// The Hamiltonian `H` of a phase point at time `t`, which only a potential that contains the time reads.
    fn hamiltonian<T: Real>(&self, t: T, point: &Self::Point<T>) -> T;

    /// The power of the forces that no potential has, `-2 R` of a dissipation function `R`, and `dU/dt` at rest of a
    /// potential that contains the time: `dH/dt`. Zero for a model without either.
    fn power<T: Real>(&self, _t: T, _point: &Self::Point<T>) -> T {
        T::zero()
    }

    /// The values of the functions of [`Description::domain`], one after the other, and of the angles of
    /// [`Description::angles`] after them.
    fn domain(&self, _t: f64, _point: &Self::Point<f64>, _each: &mut dyn FnMut(f64)) {}

    /// The point as a plain array.
    fn flatten<T: Real>(&self, point: &Self::Point<T>) -> Self::Full<T>;
    /// The point from a plain array, unchecked.
    fn unflatten<T: Real>(&self, full: &Self::Full<T>) -> Self::Point<T>;
    /// Hamilton's equations over the plain array: its time derivative.
    fn hamilton_equations<T: Scalar>(&self, t: T, full: &Self::Full<T>) -> Self::Full<T>;

    /// The reduced state and the constants of the trajectory that passes through `point` at time `t0`.
    fn reduce<T: Real>(&self, t0: T, point: &Self::Point<T>) -> (Self::Reduced<T>, Self::Constants<T>);
    /// Time derivative of the reduced state: straight-line code.
    fn reduced_equations<T: Scalar>(
        &self,
        t: T,
        constants: &Self::Constants<T>,
        reduced: &Self::Reduced<T>,
    ) -> Self::Reduced<T>;
    /// The phase point of a reduced state at time `t`.
    fn expand<T: Real>(
        &self,
        t: T,
        constants: &Self::Constants<T>,
        reduced: &Self::Reduced<T>,
    ) -> Self::Point<T>;

    /// The reduced state with what is a function of the rest computed anew: `1/D = (det phi)^(-1/n)` and `q`, which
    /// some reduced equations carry along instead of taking a root or a logarithm.
    #[must_use]
    fn renewed<T: Real>(&self, reduced: &Self::Reduced<T>) -> Self::Reduced<T> {
        *reduced
    }

    /// Signs and weakest pivot of the mass matrix at a placement, for a model whose kinetic energy has a mass matrix
    /// that depends on it and is not known to be definite; `None` for every other one, which is regular everywhere.
    fn regularity(&self, _phi: &Matrix<N>) -> Option<Regularity> {
        None
    }

    /// Condition number of the kinetic energy: the quotient of the largest and the least factor between momentum and
    /// velocity, in absolute value, over the directions that a constraint leaves free. `|I+A|`, `|I-A|` and `|I+A+nB|` are
    /// such factors. Momenta that are known to `eps` give velocities that are known to `eps` times it, and so the other way.
    ///
    /// That of the internal part, in the model's own frame, where it is the same at every placement; of a sum of energies in
    /// different frames it is the one at `phi` where [`regularity`](Self::regularity) is asked for, else at `phi = 1`. Of a Hamiltonian with `casimir3` it is that of the motions of small
    /// momentum. `None` where these have no velocity, where numbers overflow, and where `phi` has no inverse.
    fn condition(&self, phi: &Matrix<N>) -> Option<f64>
    where
        Self: Sized,
    {
        // What depends on the placement at all is refused where it degenerates.
        let phi = match self.regularity(phi) {
            Some(_) => self.bases().map_or(*phi, |bases| bases.placement(phi)),
            None => Matrix::<N>::identity(),
        };
        let at_rest = self.unflatten(&Self::Full::<f64>::zeros());
        condition(&Self::DESCRIPTION, &phi, |momentum| {
            let Some(bases) = self.bases() else {
                return self.velocity(&at_rest.moved(Vector::zeros(), phi, |_| *momentum)).phi_dot;
            };
            let point = at_rest.in_orthonormal(Some(&bases)).moved(Vector::zeros(), phi, |_| *momentum);
            bases.velocity(&self.velocity(&Self::Point::from_orthonormal(&point, &bases))).phi_dot
        })
    }

    /// The bases of space and body in which the model's metrics are the identity, from the user's own; `None` where
    /// they are the identity there. Plain arrays, reduced states and closed forms stand in them, phase points do not.
    fn bases(&self) -> Option<Bases<N>> {
        None
    }

    /// The point in bases in which the metrics are the identity: `phi' = A phi B^-1`, with `g = A^T A`, `eta = B^T B`. What
    /// needs the metrics is read off it: deformation tensors, strains, invariants, stretches, `q`, spin and vorticity. The
    /// point itself of a model without `metrics(...)`.
    ///
    /// ```
    /// use affine_runtime::prelude::*;
    ///
    /// #[affine_model(
    ///     dim = 2,
    ///     metrics(space = diag(4, 1), body = diag(1, 1)),
    ///     kinetic(casimir2 = 0.2, body_inertia = 1),
    ///     potential = tr(G),
    /// )]
    /// struct Body;
    ///
    /// let point = Body.at_momentum(Matrix::<2>::identity(), Comoving(Matrix::<2>::zeros()))?;
    /// let orthonormal = Body.orthonormal(&point);
    /// assert_eq!(orthonormal.green().0.0.trace(), 5.0); // as in the potential
    /// assert_eq!(Body.hamiltonian(0.0, &point), 5.0);
    /// assert_eq!(Body.components(orthonormal.green()), Matrix::<2>::new(4.0, 0.0, 0.0, 1.0)); // g_ij phi_iA phi_jB
    /// # Ok::<(), affine_runtime::Error>(())
    /// ```
    ///
    /// What is read off the point itself would use other metrics, and does not compile:
    ///
    /// ```compile_fail,E0277
    /// # use affine_runtime::prelude::*;
    /// # #[affine_model(dim = 2, metrics(space = diag(4, 1), body = diag(1, 1)), kinetic(casimir2 = 0.2, body_inertia = 1))]
    /// # struct Body;
    /// # let point = Body.at_momentum(Matrix::<2>::identity(), Comoving(Matrix::<2>::zeros())).unwrap();
    /// let trace = point.green().0.0.trace();
    /// ```
    fn orthonormal<T: Real>(&self, point: &Self::Point<T>) -> <Self::Point<T> as Phase<N, T>>::InOrthonormal {
        point.in_orthonormal(self.bases().map(|bases| bases.over()).as_ref())
    }

    /// Components of a tensor in the model's own bases, of one that was read off an [`orthonormal`](Self::orthonormal) point:
    /// `G_AB = g_ij phi^i_A phi^j_B`, `C_ij = eta_AB (phi^-1)^A_i (phi^-1)^B_j`, and skew
    /// `S_ij = g_ik Sigma^k_j - g_jk Sigma^k_i`, `Vort^AB = Sigma_hat^A_C eta^CB - Sigma_hat^B_C eta^CA`.
    fn components(&self, tensor: impl Tensor<N>) -> Matrix<N> {
        tensor.components(self.bases().as_ref())
    }

    /// Every motion of the model has a closed form, [`geodesic`](Self::geodesic): the automatic method integrates nothing.
    const IS_GEODESIC: bool = false;
    /// The closed form of the trajectory through `point` at time `t0`, where the model and the scene have one.
    fn geodesic(&self, _t0: f64, _point: &Self::Point<f64>) -> Option<crate::geodesic::Geodesic<N>> {
        None
    }
    /// The phase point at time `t` on a closed-form trajectory that started at `start`.
    fn on_geodesic(
        &self,
        geodesic: &crate::geodesic::Geodesic<N>,
        t: f64,
        start: &Self::Point<f64>,
    ) -> Self::Point<f64> {
        geodesic.point(t, start)
    }
    /// When a closed form from the placement `start` leaves GL+(n) on the way to `t_end`, as straight lines alone do:
    /// [`Geodesic::collapse`](crate::geodesic::Geodesic::collapse).
    fn collapse(
        &self,
        _geodesic: &crate::geodesic::Geodesic<N>,
        _t_end: f64,
        _start: &Matrix<N>,
    ) -> Option<f64> {
        None
    }

    /// The Taylor coefficients of the reduced motion, where `emit(taylor)` asked for them.
    fn taylor(
        _model: impl Handle<N, Model = Self>,
    ) -> Option<impl Series<Self::Reduced<f64>, Self::Constants<f64>>>
    where
        Self: Sized,
    {
        None::<NotEmitted>
    }

    /// The exact flows of the pieces of the reduced motion, where `emit(splitting)` asked for them.
    fn splitting(
        _model: impl Handle<N, Model = Self>,
    ) -> Option<impl Pieces<Self::Reduced<f64>, Self::Constants<f64>>>
    where
        Self: Sized,
    {
        None::<NotEmitted>
    }

    /// The reduced equations as `q' = V(p)`, `p' = F(t, q)`, where `emit(nystrom)` asked for them.
    fn second_order(
        _model: impl Handle<N, Model = Self>,
    ) -> Option<impl SecondOrder<Self::Reduced<f64>, Self::Constants<f64>>>
    where
        Self: Sized,
    {
        None::<NotEmitted>
    }

    /// The reduced equations in vectors of four doubles, where that takes fewer instructions.
    fn packing(
        _model: impl Handle<N, Model = Self>,
    ) -> Option<impl Packing<Self::Reduced<f64>, Self::Constants<f64>>>
    where
        Self: Sized,
    {
        None::<NotEmitted>
    }

    /// The equations without the constraint `det phi = 1`, where they are those of masses under forces that depend on positions
    /// alone.
    #[doc(hidden)]
    fn unconstrained(_model: impl Handle<N, Model = Self>) -> Option<impl Unconstrained>
    where
        Self: Sized,
    {
        None::<NotEmitted>
    }
}

/// What leads to a model: a reference, an [`Arc`](std::sync::Arc), or the model itself, [`Owned`].
pub trait Handle<const N: usize>: Clone {
    /// Its type.
    type Model: Model<N>;
    /// The model.
    fn model(&self) -> &Self::Model;
}

impl<const N: usize, M: Model<N>> Handle<N> for &M {
    type Model = M;
    #[inline(always)]
    fn model(&self) -> &M {
        self
    }
}

#[cfg(feature = "std")]
impl<const N: usize, M: Model<N>> Handle<N> for std::sync::Arc<M> {
    type Model = M;
    #[inline(always)]
    fn model(&self) -> &M {
        self
    }
}

/// A model by itself, which what takes it keeps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Owned<M>(pub M);

impl<const N: usize, M: Model<N> + Clone> Handle<N> for Owned<M> {
    type Model = M;
    #[inline(always)]
    fn model(&self) -> &M {
        &self.0
    }
}
