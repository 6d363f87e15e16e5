//! Rational numbers as those that models are evaluated in, and back.

use affine_oracle::{Rational, exact, rounded};
use affine_runtime::model::StateVector;
use affine_runtime::parametric::{Fields, Parametric};
use affine_runtime::scalar::Scalar;
use qd::Quad;

/// Coefficients of what is prepared from the fields.
pub(crate) type Coefficients<const N: usize, F, T> =
    <<F as Fields<N>>::Prepared as Parametric<N>>::Coefficients<T>;

/// The number nearest to a rational one, of at most two doubles.
pub(crate) fn nearest<T: Scalar>(value: &Rational) -> T {
    let first = rounded(value);
    T::constant(first, rounded(&(value - exact(first).unwrap())))
}

/// The rational number that a double-double is.
pub(crate) fn as_rational(value: Quad) -> Rational {
    exact(value.0).unwrap() + exact(value.1).unwrap()
}

/// A vector from a function of the place of each component.
pub(crate) fn vector<T, V: StateVector<T>>(component: impl Fn(usize) -> T) -> V {
    let mut vector = V::zeros();
    vector.as_mut().iter_mut().enumerate().for_each(|(k, entry)| *entry = component(k));
    vector
}

/// The coefficients that follow from values of the fields.
pub(crate) fn coefficients<const N: usize, F: Fields<N>, T: affine_runtime::scalar::Real>(
    value: impl Fn(usize) -> T,
) -> Coefficients<N, F, T> {
    F::coefficients_of(&vector(value)).unwrap()
}
