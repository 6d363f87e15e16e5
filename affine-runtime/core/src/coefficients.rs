//! Arrays in emitted code that hold several things, one after the other.

use crate::frames::Matrix;
use crate::metrics::Bases;
use crate::scalar::Scalar;

/// The entries of the parts, one after the other.
#[inline]
pub fn joined<T: Scalar, const PARTS: usize, const ALL: usize>(parts: [&[T]; PARTS]) -> [T; ALL] {
    let mut all = [T::zero(); ALL];
    let mut places = all.iter_mut();
    for part in parts {
        part.iter().zip(&mut places).for_each(|(entry, place)| *place = *entry);
    }
    all
}

/// The rows of a matrix, from its entries.
pub fn table<T, const K: usize>(entry: impl Fn(usize, usize) -> T) -> [[T; K]; K] {
    core::array::from_fn(|row| core::array::from_fn(|column| entry(row, column)))
}

/// The rows of a matrix whose first entry stands at a place of an array.
#[inline]
pub fn square<const K: usize, T: Scalar, const ALL: usize>(values: &[T; ALL], first: usize) -> [[T; K]; K] {
    table(|row, column| values.get(first + row * K + column).copied().unwrap_or_else(T::zero))
}

/// The coefficients, and the entries of bases after them.
#[must_use]
pub fn beside_bases<const N: usize, T: Scalar, const K: usize, const ALL: usize>(
    coefficients: [T; K],
    bases: &Bases<N, T>,
) -> [T; ALL] {
    let Bases { space, space_inverse, body, body_inverse } = bases;
    let matrices = [space, space_inverse, body, body_inverse].into_iter().flat_map(|matrix| matrix.iter());
    let mut all = coefficients.iter().chain(matrices).copied();
    core::array::from_fn(|_| all.next().unwrap_or_else(T::zero))
}

/// The bases that stand after the coefficients.
#[inline]
#[must_use]
pub fn bases_beside<const N: usize, T: Scalar, const ALL: usize>(coefficients: &[T; ALL]) -> Bases<N, T> {
    let matrix = |place: usize| {
        let first = ALL - (4 - place) * N * N;
        Matrix::from_fn(|row, column| coefficients[first + column * N + row])
    };
    Bases { space: matrix(0), space_inverse: matrix(1), body: matrix(2), body_inverse: matrix(3) }
}
