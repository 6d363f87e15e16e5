//! Functions of `2x2` and `3x3` matrices, and factorisations of placements.

use core::array::from_fn;
use core::borrow::Borrow;

pub use affine_core::decompose::{Polar, TwoPolar};
use affine_core::decompose::{
    characteristic_invariants, dilatation, exponential, inverse, isochoric_part, log_stretches,
    mean_log_stretch, principal_log_stretches, skew_exponential,
};
use affine_core::frames::Matrix;
use affine_core::scalar::{Real, Scalar};

/// An `n` by `n` matrix as a linear map, `n` = 2 or 3: what is computed of a placement, and of what generates placements.
///
/// ```
/// use affine_runtime::prelude::*;
///
/// let phi = Matrix::<2>::new(2.0, 0.3, 0.0, 0.5);
/// assert!((phi.isochoric_part() * phi.dilatation() - phi).norm() < 1e-15);
/// assert!((phi * phi.inverse() - Matrix::<2>::identity()).norm() < 1e-15);
/// let turn = Matrix::<2>::new(0.0, -1.0, 1.0, 0.0);
/// assert!((turn.exponential() - turn.skew_exponential()).norm() < 1e-15);
/// ```
///
/// Decompositions are values: [`Polar::of`] and [`TwoPolar::of`].
pub trait LinearMap<const N: usize, T: Scalar>: Borrow<Matrix<N, T>> {
    /// The inverse: transposed cofactors over the determinant where that is not small beside the entries, so that nothing
    /// cancels that counts; elsewhere Gauss-Jordan elimination with partial pivoting. Not finite where the matrix is singular
    /// (phase points are checked for `det phi > 0` when they are made).
    fn inverse(&self) -> Matrix<N, T>
    where
        T: Real,
    {
        inverse(self.borrow())
    }

    /// Mean log-stretch `q = ln(det phi)/n`, the mean of the logarithms of the stretches.
    ///
    /// Minus infinity where `det phi = 0`, NaN where it is negative or an entry is not finite. Error: a few
    /// epsilons, relative where `|q| > 1` and absolute below, times the condition number that `phi` has after its
    /// rows and columns are scaled; `phi = 1 + H` with a small `H` has the absolute error `epsilon |H|` instead.
    /// (Slawianowski et al., section 5.)
    fn mean_log_stretch(&self) -> T
    where
        T: Real,
    {
        mean_log_stretch(self.borrow())
    }

    /// Dilatation `D = exp(q) = (det phi)^(1/n)`, the geometric mean of the stretches.
    ///
    /// Zero where `det phi = 0`, NaN where it is negative or an entry is not finite; the relative error is that of
    /// [`mean_log_stretch`](Self::mean_log_stretch) for `|q| < 1`, however large `q` is.
    fn dilatation(&self) -> T
    where
        T: Real,
    {
        dilatation(self.borrow())
    }

    /// Isochoric part `Psi = exp(-q) phi` of a placement, with `det Psi = 1`: itself a placement.
    ///
    /// Not finite where `det phi <= 0`.
    fn isochoric_part(&self) -> Matrix<N, T>
    where
        T: Real,
    {
        isochoric_part(self.borrow())
    }

    /// Characteristic invariants `I1..In` of `G = phi^T phi`, the elementary symmetric functions of its eigenvalues:
    /// `det(G - x) = sum_k (-x)^(n-k) I_k`, `I1 = tr G`, `In = (det phi)^2`.
    ///
    /// `I_k` is computed as the sum of the squared `k` by `k` minors of `phi` (Cauchy-Binet), in which no two terms
    /// cancel, not from power traces.
    fn characteristic_invariants(&self) -> [T; N]
    where
        T: Real,
    {
        characteristic_invariants(self.borrow())
    }

    /// Log-stretches `q_a = ln Q_a` of a placement, in no order: those of
    /// [`principal_log_stretches`](Self::principal_log_stretches).
    fn log_stretches(&self) -> [T; N] {
        log_stretches(self.borrow())
    }

    /// The stretches `Q_a`, in no order, the log-stretches `q_a = ln Q_a`, `phi R = L diag(Q)`, and the body's principal axes,
    /// the columns of the rotation `R`: `G = phi^T phi = R diag(Q^2) R^T`. For potentials and forces of your own, as code
    /// without branches that runs on all numbers; [`TwoPolar`] has smaller errors.
    ///
    /// One-sided Jacobi rotations (Hestenes, J. SIAM 6 (1958) 51). Each stretch has an error of a few units of rounding of the
    /// largest one. Of `phi = 1 + H` with a small `H` the errors of `q_a`, and of sums `R diag(f(q)) R^T`, are a few units of
    /// rounding of `|H|`. Where stretches coincide any axes are right, and some are returned. Not finite where `phi` is not,
    /// or has a column of zeros. Squares of entries must have all their digits, too: largest entries between 1e-140 and 1e150 in
    /// doubles. [`TwoPolar`] takes all others.
    fn principal_log_stretches(&self) -> ([T; N], [T; N], Matrix<N, T>, Matrix<N, T>) {
        let phi: &Matrix<N, T> = self.borrow();
        let (stretches, logarithms, stretched, axes) =
            principal_log_stretches(from_fn(|i| from_fn(|a| phi[(i, a)])));
        let matrix = |rows: [[T; N]; N]| Matrix::from_fn(|i, a| rows[i][a]);
        (stretches, logarithms, matrix(stretched), matrix(axes))
    }

    /// `exp(A) = exp(tr A/n) exp(B)`, `B = A - (tr A/n) 1`, of a matrix of doubles.
    ///
    /// `exp(B)` is the Taylor series of the exponential at `B/2^s`, squared `s` times with 25 bits more than those of `f64`:
    /// powers of a non-normal matrix may swell and shrink again (the hump and the overscaling of Moler and Van Loan, SIAM
    /// Rev. 45 (2003) 3, and Al-Mohy and Higham, SIAM J. Matrix Anal. Appl. 31 (2009) 970).
    ///
    /// Error, for Frobenius norms of `A` up to 700: at most `4 eps (1 + kappa)` relative to `exp(A)` in the
    /// Frobenius norm, with `kappa = ||L|| ||A|| / ||exp(A)||` the relative condition number and `L` the Fréchet
    /// derivative of the exponential at `A` (Higham, Functions of Matrices, 2008, section 3.1).
    ///
    /// Entries beyond the range of `f64` are infinite, with their sign. All entries are NaN if one of `A` is
    /// infinite or NaN, or if sums of its entries overflow.
    fn exponential(&self) -> Matrix<N>
    where
        Self: Borrow<Matrix<N>>,
    {
        exponential(Borrow::<Matrix<N>>::borrow(self))
    }

    /// `exp(W)`, the rotation generated by a skew matrix.
    ///
    /// ```text
    /// n = 2:  cos(w) 1 + sin(w) [[0, -1], [1, 0]],                w = W_21
    /// n = 3:  1 + sin(w) K + 2 sin^2(w/2) K^2,    K = W/w,    w^2 = -tr(W^2)/2
    /// ```
    ///
    /// (Rodrigues). Orthogonal to a few roundings for every finite angle; the rotation itself is exact to about
    /// `eps (1 + w)`. Only the entries below the diagonal are read. Not finite if one of them is not.
    fn skew_exponential(&self) -> Matrix<N, T>
    where
        T: Real,
    {
        skew_exponential(self.borrow())
    }
}

impl<const N: usize, T: Scalar> LinearMap<N, T> for Matrix<N, T> {}
