//! Spatial, co-moving and two-point quantities as types.
//!
//! A formula that adds a spatial to a co-moving quantity, or passes a velocity where a momentum belongs, does
//! not compile. Index conventions: `phi[(i, A)]` with the space index first; the canonical momentum
//! `Pi[(A, i)]` is conjugate to `phi[(i, A)]`, so that the pairing is `tr(Pi phi_dot)`.

use crate::metrics::Bases;
use crate::scalar::Real;

/// An `N` by `N` matrix.
pub type Matrix<const N: usize, T = f64> = nalgebra::SMatrix<T, N, N>;
/// An `N`-vector.
pub type Vector<const N: usize, T = f64> = nalgebra::SVector<T, N>;

/// A quantity seen from space: `Omega = phi_dot phi^-1`, `Sigma = phi Pi`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spatial<Q>(pub Q);

/// A quantity seen from the body: `Omega_hat = phi^-1 phi_dot`, `Sigma_hat = Pi phi`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Comoving<Q>(pub Q);

/// A two-point quantity with one index in space and one in the body: `phi_dot`, `Pi`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TwoPoint<Q>(pub Q);

/// Affine velocity: `phi_dot phi^-1` in space, `phi^-1 phi_dot` in the body, `phi_dot` between the two.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AffineVelocity<const N: usize, T = f64>(pub Matrix<N, T>);

/// Affine spin, the momentum conjugate to the affine velocity: `Sigma = (dT/dOmega)^T` in space,
/// `Sigma_hat = (dT/dOmega_hat)^T` in the body, `Pi = (dT/dphi_dot)^T` between the two.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AffineSpin<const N: usize, T = f64>(pub Matrix<N, T>);

/// A frame in which affine spins are stored: [`Space`], [`Body`] or [`Canonical`].
pub trait Frame:
    Copy + core::fmt::Debug + Default + PartialEq + Send + Sync + sealed::Sealed + 'static
{
    /// Name of the momentum in this frame, as in the paper.
    const MOMENTUM: &'static str;

    /// `Sigma` from the affine spin of this frame.
    fn to_space<const N: usize, T: Real>(phi: &Matrix<N, T>, spin: &Matrix<N, T>) -> Matrix<N, T>;
    /// `Sigma_hat` from the affine spin of this frame.
    fn to_body<const N: usize, T: Real>(phi: &Matrix<N, T>, spin: &Matrix<N, T>) -> Matrix<N, T>;
    /// `Pi` from the affine spin of this frame.
    fn to_canonical<const N: usize, T: Real>(phi: &Matrix<N, T>, spin: &Matrix<N, T>) -> Matrix<N, T>;
    /// `Sigma` or `Sigma_hat`, whichever takes no inverse of `phi`. The two are similar matrices: traces of
    /// their powers agree.
    fn to_mixed<const N: usize, T: Real>(phi: &Matrix<N, T>, spin: &Matrix<N, T>) -> Matrix<N, T>;
    /// The affine spin of this frame from that of another.
    fn convert<F: Frame, const N: usize, T: Real>(phi: &Matrix<N, T>, spin: &Matrix<N, T>) -> Matrix<N, T>;
    /// The affine spin of this frame in other bases: `A Sigma A^-1`, `B Sigma_hat B^-1`, `B Pi A^-1`.
    fn rebased<const N: usize, T: Real>(bases: &Bases<N, T>, spin: &Matrix<N, T>) -> Matrix<N, T>;
}

mod sealed {
    pub trait Sealed {}
    impl Sealed for super::Space {}
    impl Sealed for super::Body {}
    impl Sealed for super::Canonical {}
}

/// Spatial frame: the affine spin is `Sigma = phi Pi`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Space;

/// Co-moving frame: the affine spin is `Sigma_hat = Pi phi`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Body;

/// Neither: the momentum is `Pi` itself, conjugate to `phi`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Canonical;

impl Frame for Space {
    const MOMENTUM: &'static str = "Sigma";

    fn to_space<const N: usize, T: Real>(_phi: &Matrix<N, T>, spin: &Matrix<N, T>) -> Matrix<N, T> {
        *spin
    }
    fn to_body<const N: usize, T: Real>(phi: &Matrix<N, T>, spin: &Matrix<N, T>) -> Matrix<N, T> {
        inverse(phi) * spin * phi
    }
    fn to_canonical<const N: usize, T: Real>(phi: &Matrix<N, T>, spin: &Matrix<N, T>) -> Matrix<N, T> {
        inverse(phi) * spin
    }
    fn to_mixed<const N: usize, T: Real>(_phi: &Matrix<N, T>, spin: &Matrix<N, T>) -> Matrix<N, T> {
        *spin
    }
    fn convert<F: Frame, const N: usize, T: Real>(phi: &Matrix<N, T>, spin: &Matrix<N, T>) -> Matrix<N, T> {
        F::to_space(phi, spin)
    }
    fn rebased<const N: usize, T: Real>(bases: &Bases<N, T>, spin: &Matrix<N, T>) -> Matrix<N, T> {
        bases.space * spin * bases.space_inverse
    }
}

impl Frame for Body {
    const MOMENTUM: &'static str = "Sigma_hat";

    fn to_space<const N: usize, T: Real>(phi: &Matrix<N, T>, spin: &Matrix<N, T>) -> Matrix<N, T> {
        phi * spin * inverse(phi)
    }
    fn to_body<const N: usize, T: Real>(_phi: &Matrix<N, T>, spin: &Matrix<N, T>) -> Matrix<N, T> {
        *spin
    }
    fn to_canonical<const N: usize, T: Real>(phi: &Matrix<N, T>, spin: &Matrix<N, T>) -> Matrix<N, T> {
        spin * inverse(phi)
    }
    fn to_mixed<const N: usize, T: Real>(_phi: &Matrix<N, T>, spin: &Matrix<N, T>) -> Matrix<N, T> {
        *spin
    }
    fn convert<F: Frame, const N: usize, T: Real>(phi: &Matrix<N, T>, spin: &Matrix<N, T>) -> Matrix<N, T> {
        F::to_body(phi, spin)
    }
    fn rebased<const N: usize, T: Real>(bases: &Bases<N, T>, spin: &Matrix<N, T>) -> Matrix<N, T> {
        bases.body * spin * bases.body_inverse
    }
}

impl Frame for Canonical {
    const MOMENTUM: &'static str = "Pi";

    fn to_space<const N: usize, T: Real>(phi: &Matrix<N, T>, spin: &Matrix<N, T>) -> Matrix<N, T> {
        phi * spin
    }
    fn to_body<const N: usize, T: Real>(phi: &Matrix<N, T>, spin: &Matrix<N, T>) -> Matrix<N, T> {
        spin * phi
    }
    fn to_canonical<const N: usize, T: Real>(_phi: &Matrix<N, T>, spin: &Matrix<N, T>) -> Matrix<N, T> {
        *spin
    }
    fn to_mixed<const N: usize, T: Real>(phi: &Matrix<N, T>, spin: &Matrix<N, T>) -> Matrix<N, T> {
        spin * phi
    }
    fn convert<F: Frame, const N: usize, T: Real>(phi: &Matrix<N, T>, spin: &Matrix<N, T>) -> Matrix<N, T> {
        F::to_canonical(phi, spin)
    }
    fn rebased<const N: usize, T: Real>(bases: &Bases<N, T>, spin: &Matrix<N, T>) -> Matrix<N, T> {
        bases.body * spin * bases.space_inverse
    }
}

/// A momentum given in some frame: what `at_momentum` accepts.
///
/// `Spatial(sigma)`, `Comoving(sigma_hat)` and `TwoPoint(pi)`, of a bare matrix or of an [`AffineSpin`]; an
/// [`AffineVelocity`] is no momentum and does not compile here.
#[diagnostic::on_unimplemented(
    message = "this is no affine spin in a frame, of a body in dimension {N}",
    label = "no frame, or no momentum",
    note = "write `Spatial(sigma)` for Sigma = phi Pi, `Comoving(sigma_hat)` for Sigma_hat = Pi phi, `TwoPoint(pi)` for Pi, \
            of matrices of that dimension; velocities go to `at_velocity`"
)]
pub trait Momentum<const N: usize, T: Real> {
    /// The frame the matrix is written in.
    type Frame: Frame;
    /// The matrix.
    fn matrix(self) -> Matrix<N, T>;
}

/// A vector of the centre of mass: its position `x`, its velocity `x_dot`, its momentum `p`.
#[diagnostic::on_unimplemented(
    message = "this is no vector of the centre of mass, `x`, `x_dot` or `p`, in dimension {N}",
    label = "no vector of the centre of mass",
    note = "a body with translation has `at_velocity(x, phi, x_dot, phi_dot)` and `at_momentum(x, phi, p, spin)`"
)]
pub trait OfCentre<const N: usize> {
    /// The vector.
    fn vector(self) -> Vector<N>;
}

impl<const N: usize> OfCentre<N> for Vector<N> {
    fn vector(self) -> Vector<N> {
        self
    }
}

macro_rules! momentum {
    ($wrapper:ident, $frame:ident) => {
        impl<const N: usize, T: Real> Momentum<N, T> for $wrapper<Matrix<N, T>> {
            type Frame = $frame;
            fn matrix(self) -> Matrix<N, T> {
                self.0
            }
        }
        impl<const N: usize, T: Real> Momentum<N, T> for $wrapper<AffineSpin<N, T>> {
            type Frame = $frame;
            fn matrix(self) -> Matrix<N, T> {
                self.0.0
            }
        }
    };
}

momentum!(Spatial, Space);
momentum!(Comoving, Body);
momentum!(TwoPoint, Canonical);

/// Inverse: the transposed cofactors over the determinant where that is not small beside the entries, so that
/// nothing cancels that counts; elsewhere by Gauss-Jordan elimination with partial pivoting. Not finite where the
/// matrix is singular (phase points are checked for `det phi > 0` when they are made).
pub fn inverse<const N: usize, T: Real>(matrix: &Matrix<N, T>) -> Matrix<N, T> {
    if N == 3
        && let Some(inverse) = by_cofactors(matrix)
    {
        return inverse;
    }
    by_elimination(matrix)
}

/// `(b x c, c x a, a x b)^T/det` of the columns `a`, `b`, `c`, where `det^2 > 2^-12 |matrix|^6`, which is `2^-7.3` times
/// what it is at most, and in the range of numbers.
fn by_cofactors<const N: usize, T: Real>(matrix: &Matrix<N, T>) -> Option<Matrix<N, T>> {
    let of = |i: usize, j: usize| matrix[(i % 3, j % 3)];
    let cofactor =
        |i: usize, j: usize| of(i + 1, j + 1) * of(i + 2, j + 2) - of(i + 1, j + 2) * of(i + 2, j + 1);
    let squares = matrix.iter().fold(T::zero(), |sum, entry| sum + *entry * *entry);
    let cofactors: [[T; 3]; 3] = core::array::from_fn(|i| core::array::from_fn(|j| cofactor(i, j)));
    let determinant = of(0, 0) * cofactors[0][0] + of(0, 1) * cofactors[0][1] + of(0, 2) * cofactors[0][2];
    let (size, least) = (squares * squares * squares, T::from_f64(WELL_CONDITIONED));
    let is_plain = determinant * determinant > least * size && size > T::from_f64(1e-200);
    is_plain.then(|| Matrix::from_fn(|i, j| cofactors[j][i] / determinant))
}

/// Part of `|matrix|^6` above which `det^2` is no difference of numbers that are much larger.
const WELL_CONDITIONED: f64 = 1.0 / 4096.0;

fn by_elimination<const N: usize, T: Real>(matrix: &Matrix<N, T>) -> Matrix<N, T> {
    // In place: columns of the identity take the places of those that are done with. Rows, and places of rows.
    let mut rows: [[T; N]; N] = core::array::from_fn(|i| core::array::from_fn(|j| matrix[(i, j)]));
    let mut places: [usize; N] = core::array::from_fn(|i| i);
    for column in 0..N {
        for row in column + 1..N {
            if rows[row][column].abs() > rows[column][column].abs() {
                rows.swap(row, column);
                places.swap(row, column);
            }
        }
        let scale = T::one() / rows[column][column];
        rows[column][column] = T::one();
        let head = rows[column].map(|entry| entry * scale);
        rows[column] = head;
        for row in 0..N {
            if row != column {
                let factor = rows[row][column];
                rows[row][column] = T::zero();
                for (entry, head) in rows[row].iter_mut().zip(head) {
                    *entry -= factor * head;
                }
            }
        }
    }
    let mut inverse = Matrix::<N, T>::zeros();
    for (row, entries) in rows.into_iter().enumerate() {
        for (place, entry) in places.into_iter().zip(entries) {
            inverse[(row, place)] = entry;
        }
    }
    inverse
}

#[cfg(test)]
mod tests {
    use super::{Matrix, by_cofactors, by_elimination, inverse};

    /// Rows about those of a multiple of the identity, with the digits of a few products for entries.
    fn near_conformal(k: u32, size: f64, spread: f64) -> Matrix<3> {
        let noise = |i: usize, j: usize| (f64::from(k) * 1.7 + (3 * i + j) as f64 * 2.3).sin() * spread;
        Matrix::from_fn(|i, j| size * (if i == j { 1.0 + noise(i, j) } else { noise(i, j) }))
    }

    #[test]
    fn both_ways_invert() {
        let mut taken = 0;
        for k in 0..200 {
            for (size, spread) in [(1.0, 0.1), (1e-20, 0.5), (1e20, 1.0), (3.0, 2.0)] {
                let matrix = near_conformal(k, size, spread);
                let (whole, cofactors) = (inverse(&matrix), by_cofactors(&matrix));
                let defect = |inverse: Matrix<3>| (inverse * matrix - Matrix::<3>::identity()).norm();
                let condition = whole.norm() * matrix.norm();
                taken += u32::from(cofactors.is_some());
                for found in [Some(by_elimination(&matrix)), cofactors, Some(whole)].into_iter().flatten() {
                    assert!(defect(found) < 4.0 * condition * f64::EPSILON, "{matrix} {}", defect(found));
                }
            }
        }
        assert!((200..700).contains(&taken), "each way is taken: {taken}");
    }

    #[test]
    fn what_is_exact_stays_so() {
        let turned = Matrix::<3>::new(0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0);
        assert_eq!(inverse(&turned), turned.transpose());
        let swapped = Matrix::<2>::new(0.0, 2.0, 4.0, 0.0);
        assert_eq!(inverse(&swapped), Matrix::<2>::new(0.0, 0.25, 0.5, 0.0));
        for diagonal in [[3.0, 5.0, 7.0], [1e-200, 1.0, 1e200], [1e150, 1e-140, 49.0], [1e-90, 1e-90, 2e-90]]
        {
            let matrix = Matrix::<3>::from_diagonal(&diagonal.into());
            let exact = Matrix::<3>::from_diagonal(&diagonal.map(|entry| 1.0 / entry).into());
            let found = inverse(&matrix);
            assert!(
                (0..3).all(|i| (found[(i, i)] / exact[(i, i)] - 1.0).abs() <= f64::EPSILON)
                    && (found - Matrix::<3>::from_diagonal(&found.diagonal())).norm() == 0.0,
                "{found}"
            );
        }
    }

    #[test]
    fn a_singular_matrix_has_no_finite_inverse() {
        let flat = Matrix::<3>::new(1.0, 2.0, 3.0, 2.0, 4.0, 6.0, 1.0, 0.0, 1.0);
        assert!(inverse(&flat).iter().any(|entry| !entry.is_finite()));
    }
}
