//! Models with fields, as functions of their coefficients; coefficients as functions of the fields.
//!
//! ```text
//! fields  --coefficients_of-->  coefficients  --hamiltonian_with, reduce_with, ...-->  energies, equations
//! ```
//!
//! Either arrow is computed in whatever number it is asked for. A model that was prepared holds its coefficients as doubles, and
//! the methods of [`Model`] read these. With dual numbers both arrows give derivatives with respect to fields, with
//! double-doubles a model whose coefficients have that precision, and in lanes one model to each.

use crate::error::Result;
use crate::frames::Matrix;
use crate::lanes::{Lanes, gathered};
use crate::model::{Model, StateVector, Velocity};
use crate::scalar::{Real, Scalar};

/// A struct with fields that the coefficients of a model in dimension `N` are computed from; implemented by the macro.
///
/// ```
/// use affine_runtime::dual::Dual;
/// use affine_runtime::parametric::{Fields, Parametric};
/// use affine_runtime::prelude::*;
///
/// #[affine_model(dim = 2, kinetic(casimir2 = a, body_inertia = 1))]
/// struct Disc { a: f64 }
///
/// let disc = Disc { a: 0.2 };
/// let model = disc.prepare()?;
/// let point = model.at_momentum(Matrix::<2>::identity(), Comoving(Matrix::<2>::new(0.0, 1.0, 1.0, 0.0)))?;
///
/// // H = tr(Sigma_hat^2)/(2 (1 + a)) of a symmetric Sigma_hat without trace, and its derivative with respect to a.
/// let a = Dual { value: 0.2, slope: 1.0 };
/// let coefficients = Disc::coefficients_of(&[a])?;
/// let full = model.flatten(&point).map(Dual::fixed);
/// let energy = model.hamiltonian_with(&coefficients, Dual::fixed(0.0), &model.unflatten(&full));
/// assert!((energy.value - 1.0 / 1.2).abs() < 1e-15);
/// assert!((energy.slope + 1.0 / 1.44).abs() < 1e-15);
/// # Ok::<(), affine_runtime::Error>(())
/// ```
pub trait Fields<const N: usize> {
    /// What `prepare()` makes of it.
    type Prepared: Parametric<N>;
    /// The fields that coefficients are computed from: numbers, then matrices.
    const FIELDS: &'static [Field];
    /// Their values: the numbers, then the entries of the matrices row by row.
    type Values<T: Scalar>: StateVector<T>;

    /// The values of the fields.
    fn values(&self) -> Self::Values<f64>;

    /// The coefficients of the equations. What is held against a threshold is held against it as a double.
    ///
    /// # Errors
    /// Those of `prepare()`; [`Error::IllPosed`](crate::Error::IllPosed) also where a number with a derivative has none: principal
    /// axes of a tensor, which `emit(splitting)` asks for, where several of its eigenvalues are equal.
    fn coefficients_of<T: Real>(
        values: &Self::Values<T>,
    ) -> Result<<Self::Prepared as Parametric<N>>::Coefficients<T>>;
}

/// A field: a number, or a square matrix.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Field {
    /// Its name in the struct.
    pub name: &'static str,
    /// Number of rows: 1 of a number.
    pub rows: usize,
}

/// A model with fields as a function of its coefficients: what [`Model`] computes with those that it was prepared with, with any.
///
/// The reduced equations themselves read the [constants](Model::Constants) of a trajectory, which
/// [`reduce_with`](Self::reduce_with) computes from coefficients.
pub trait Parametric<const N: usize>: Model<N> {
    /// What the equations read.
    type Coefficients<T: Scalar>: StateVector<T>;

    /// The coefficients that the model was prepared with.
    fn coefficients<T: Scalar>(&self) -> Self::Coefficients<T>;

    /// Those of several models, one to a lane; those of the last in the lanes that are left.
    fn coefficients_in_lanes<T: Lanes>(models: &[Self]) -> Self::Coefficients<T>
    where
        Self: Sized,
    {
        let mut lanes = Self::Coefficients::<T>::zeros();
        for (k, coefficient) in lanes.as_mut().iter_mut().enumerate() {
            *coefficient = gathered(models, |model| {
                let own = model.coefficients::<f64>();
                own.as_ref().get(k).copied().unwrap_or(f64::NAN)
            });
        }
        lanes
    }

    /// [`Model::velocity`].
    fn velocity_with<T: Real>(
        &self,
        coefficients: &Self::Coefficients<T>,
        point: &Self::Point<T>,
    ) -> Velocity<N, T>;

    /// [`Model::kinetic_energy`]; does not compile where that does not.
    fn kinetic_energy_with<T: Real>(
        &self,
        coefficients: &Self::Coefficients<T>,
        phi: &Matrix<N, T>,
        velocity: &Velocity<N, T>,
    ) -> T;

    /// [`Model::hamiltonian`].
    fn hamiltonian_with<T: Real>(
        &self,
        coefficients: &Self::Coefficients<T>,
        t: T,
        point: &Self::Point<T>,
    ) -> T;

    /// [`Model::power`].
    fn power_with<T: Real>(
        &self,
        _coefficients: &Self::Coefficients<T>,
        _t: T,
        _point: &Self::Point<T>,
    ) -> T {
        T::zero()
    }

    /// [`Model::flatten`].
    fn flatten_with<T: Real>(
        &self,
        _coefficients: &Self::Coefficients<T>,
        point: &Self::Point<T>,
    ) -> Self::Full<T> {
        self.flatten(point)
    }

    /// [`Model::unflatten`].
    fn unflatten_with<T: Real>(
        &self,
        _coefficients: &Self::Coefficients<T>,
        full: &Self::Full<T>,
    ) -> Self::Point<T> {
        self.unflatten(full)
    }

    /// [`Model::hamilton_equations`].
    fn hamilton_equations_with<T: Scalar>(
        &self,
        coefficients: &Self::Coefficients<T>,
        t: T,
        full: &Self::Full<T>,
    ) -> Self::Full<T>;

    /// [`Model::reduce`].
    fn reduce_with<T: Real>(
        &self,
        coefficients: &Self::Coefficients<T>,
        t0: T,
        point: &Self::Point<T>,
    ) -> (Self::Reduced<T>, Self::Constants<T>);

    /// [`Model::reduced_equations`], which ask the coefficients nothing but where a force of a field stands in bases that depend
    /// on fields.
    fn reduced_equations_with<T: Scalar>(
        &self,
        _coefficients: &Self::Coefficients<T>,
        t: T,
        constants: &Self::Constants<T>,
        reduced: &Self::Reduced<T>,
    ) -> Self::Reduced<T> {
        self.reduced_equations(t, constants, reduced)
    }

    /// [`Model::expand`].
    fn expand_with<T: Real>(
        &self,
        coefficients: &Self::Coefficients<T>,
        t: T,
        constants: &Self::Constants<T>,
        reduced: &Self::Reduced<T>,
    ) -> Self::Point<T>;
}
