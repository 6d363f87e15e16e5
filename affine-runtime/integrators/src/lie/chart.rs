//! Cayley charts of SL(n), SO(n) and R+ SO(n), n = 2 or 3.

use core::ops::Range;

use super::{Coordinates, Sum};
use affine_core::frames::Matrix;
use affine_core::model::{Constraint, StateVector};

/// The chart `phi = phi_k c(xi)` around the placement `phi_k` of a body under a constraint; `xi` takes the place of
/// `phi` in the state, and the other components stay.
///
/// ```text
/// SO(n):     c(xi) = cay(xi) = (1 - xi/2)^-1 (1 + xi/2),          xi' = (1 + xi/2) Oh (1 - xi/2)
/// SL(n):     c(xi) = r cay(xi),  r = (det(1 - xi/2)/det(1 + xi/2))^(1/n),  tr xi = 0,
///            xi' = (1 + xi/2)(Oh + k 1)(1 - xi/2),  k = tr(Oh xi^2)/(4n - tr xi^2)
/// R+ SO(n):  c(xi) = exp(s) cay(w),  xi = w + s 1,                w' as for SO(n),  s' = tr Oh/n
/// ```
///
/// with `Oh = phi^-1 phi'`. Each `c` is a diffeomorphism between a neighbourhood of zero in the Lie algebra and one of
/// 1 in the group, `c(-xi) = c(xi)^-1`, and the equations for `xi` are exact: nothing is cut off and nothing is
/// projected. The first is the classical Cayley chart (Hairer, Lubich, Wanner, Geometric Numerical Integration, section
/// IV.8.3). `cay` leaves SL(3), whose defining form is not quadratic; the factor `r`, 1 for n = 2, brings it back: with
/// `phi^-1 phi' = c^-1 c' = (1 + xi/2)^-1 xi' (1 - xi/2)^-1 + (r'/r) 1`, `k = -r'/r` is what keeps `tr xi' = 0`. It takes
/// the place of the exponential, whose equations for `xi` are an infinite series.
///
/// The charts end where an eigenvalue of `xi` is 2, the rotation by a half turn: far beyond the step of any method
/// that resolves the motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Chart<const N: usize> {
    constraint: Constraint,
    /// First component of the placement.
    start: usize,
}

impl<const N: usize> Chart<N> {
    /// The chart for states that hold the placement, row by row, in the `n^2` components from `start` on.
    #[must_use]
    pub fn new(constraint: Constraint, start: usize) -> Self {
        const { assert!(N == 2 || N == 3, "bodies live in the plane or in space") };
        Self { constraint, start }
    }

    /// `c(xi) - 1`, exact to a few roundings of itself.
    #[must_use]
    pub fn displacement(&self, xi: &Matrix<N>) -> Matrix<N> {
        match self.constraint {
            Constraint::Rigid => cayley(xi, 0.0),
            Constraint::Isochoric => {
                let cubic = if N == 3 { determinant(xi) / 8.0 } else { 0.0 };
                let turn = cayley(xi, cubic);
                let ratio = 2.0 * cubic / (quadratic(xi) - cubic);
                let factor = libm::expm1(-libm::log1p(ratio) / N as f64);
                turn + (turn + Matrix::<N>::identity()) * factor
            }
            Constraint::Conformal => {
                let mean = xi.trace() / N as f64;
                let turn = cayley(&without_trace(xi), 0.0);
                turn + (turn + Matrix::<N>::identity()) * libm::expm1(mean)
            }
        }
    }

    /// `xi'` where `phi^-1 phi' = Oh`.
    #[must_use]
    pub fn rate(&self, xi: &Matrix<N>, oh: &Matrix<N>) -> Matrix<N> {
        match self.constraint {
            Constraint::Rigid => inverse_tangent(xi, oh),
            Constraint::Isochoric => {
                let squared = xi * xi;
                let shift = inner(oh, &squared) / (4.0 * N as f64 - squared.trace());
                without_trace(&inverse_tangent(xi, &(oh + Matrix::<N>::identity() * shift)))
            }
            Constraint::Conformal => {
                let mean = oh.trace() / N as f64;
                let turn = inverse_tangent(&without_trace(xi), &without_trace(oh));
                turn + Matrix::<N>::identity() * mean
            }
        }
    }

    /// `phi^-1 phi'` in the Lie algebra: what leads out of it is rounding of `phi'`.
    #[must_use]
    pub fn comoving(&self, phi: &Matrix<N>, phi_dot: &Matrix<N>) -> Matrix<N> {
        self.in_algebra(&match self.constraint {
            Constraint::Rigid => phi.tr_mul(phi_dot),
            Constraint::Isochoric => adjugate(phi) * phi_dot,
            Constraint::Conformal => phi.tr_mul(phi_dot) * (N as f64 / phi.dot(phi)),
        })
    }

    /// The part of a matrix in the Lie algebra.
    fn in_algebra(&self, matrix: &Matrix<N>) -> Matrix<N> {
        match self.constraint {
            Constraint::Rigid => skew(matrix),
            Constraint::Isochoric => without_trace(matrix),
            Constraint::Conformal => skew(matrix) + Matrix::<N>::identity() * (matrix.trace() / N as f64),
        }
    }

    fn range(&self) -> Range<usize> {
        self.start..self.start + N * N
    }

    fn read<S: StateVector<f64>>(&self, state: &S) -> Matrix<N> {
        Matrix::<N>::from_row_slice(&state.as_ref()[self.range()])
    }

    /// `xi` of a state of coordinates. What leads out of the Lie algebra is rounding, and the residual of implicit steps, which
    /// iterate on all entries.
    fn xi<S: StateVector<f64>>(&self, z: &S) -> Matrix<N> {
        self.in_algebra(&self.read(z))
    }

    fn write<S: StateVector<f64>>(&self, state: &mut S, matrix: &Matrix<N>) {
        for (k, entry) in state.as_mut()[self.range()].iter_mut().enumerate() {
            *entry = matrix[(k / N, k % N)];
        }
    }

    /// `rest`, with the placement of `base` moved by `displacement`.
    fn placed<S: StateVector<f64>>(&self, base: &Sum<S>, rest: Sum<S>, displacement: &Matrix<N>) -> Sum<S> {
        let mut rise = S::zeros();
        self.write(&mut rise, &(self.read(&base.value) * displacement));
        let moved = base.plus(&rise);
        let mut placed = rest;
        self.write(&mut placed.value, &self.read(&moved.value));
        self.write(&mut placed.carry, &self.read(&moved.carry));
        placed
    }
}

impl<const N: usize, S: StateVector<f64>> Coordinates<S> for Chart<N> {
    fn origin(&self, base: &Sum<S>) -> Sum<S> {
        let mut origin = *base;
        origin.value.as_mut()[self.range()].fill(0.0);
        origin.carry.as_mut()[self.range()].fill(0.0);
        origin
    }

    #[inline]
    fn state(&self, base: &Sum<S>, z: &S) -> Sum<S> {
        self.placed(base, Sum::of(*z), &self.displacement(&self.xi(z)))
    }

    #[inline]
    fn velocity(&self, state: &S, z: &S, rate: &S) -> S {
        let oh = self.comoving(&self.read(state), &self.read(rate));
        let mut velocity = *rate;
        self.write(&mut velocity, &self.rate(&self.xi(z), &oh));
        velocity
    }

    fn change(&self, base: &Sum<S>, dz: &S) -> S {
        let mut change = *dz;
        self.write(&mut change, &(self.read(&base.value) * self.read(dz)));
        change
    }

    fn middle(&self, base: &Sum<S>, rise: &S) -> Sum<S> {
        self.placed(base, *base, &self.displacement(&(self.xi(rise) * 0.5)))
    }

    fn centred(&self, z: &S, rise: &S) -> S {
        let mut centred = *z;
        self.write(&mut centred, &(self.read(z) - self.read(rise) * 0.5));
        centred
    }

    fn end(&self, base: &Sum<S>, rise: &S) -> Sum<S> {
        let half = self.displacement(&(self.xi(rise) * 0.5));
        self.placed(base, base.plus(rise), &(half * 2.0 + half * half))
    }
}

/// `cay(xi) - 1 = 2 (X + X^2 + det X)/det(1 - X)`, `X = xi/2` without trace; `cubic` is `det X` for n = 3 and 0 for
/// n = 2, where `X^2 = -det X` holds its place.
fn cayley<const N: usize>(xi: &Matrix<N>, cubic: f64) -> Matrix<N> {
    let half = xi * 0.5;
    let mut numerator = half + half * half;
    for k in 0..N {
        numerator[(k, k)] += cubic;
    }
    numerator * (2.0 / (quadratic(xi) - cubic))
}

/// `1 + e_2(xi/2)`, `e_2 = -tr(X^2)/2` the second invariant of a matrix without trace.
fn quadratic<const N: usize>(xi: &Matrix<N>) -> f64 {
    1.0 - inner(xi, xi) / 8.0
}

/// `(1 + xi/2) Oh (1 - xi/2)`.
fn inverse_tangent<const N: usize>(xi: &Matrix<N>, oh: &Matrix<N>) -> Matrix<N> {
    let half = xi * 0.5;
    let left = oh + half * oh;
    left - left * half
}

/// `tr(A B)`.
fn inner<const N: usize>(a: &Matrix<N>, b: &Matrix<N>) -> f64 {
    let mut sum = 0.0;
    for i in 0..N {
        for k in 0..N {
            sum += a[(i, k)] * b[(k, i)];
        }
    }
    sum
}

fn skew<const N: usize>(matrix: &Matrix<N>) -> Matrix<N> {
    (matrix - matrix.transpose()) * 0.5
}

fn without_trace<const N: usize>(matrix: &Matrix<N>) -> Matrix<N> {
    let mean = matrix.trace() / N as f64;
    let mut deviator = *matrix;
    for k in 0..N {
        deviator[(k, k)] -= mean;
    }
    deviator
}

/// The matrix of cofactors, transposed: `A adj(A) = det(A) 1`. Its transpose is the gradient of the determinant.
pub(crate) fn adjugate<const N: usize>(a: &Matrix<N>) -> Matrix<N> {
    if N == 2 {
        return Matrix::<N>::from_fn(|i, k| if i == k { a[(1 - i, 1 - i)] } else { -a[(i, k)] });
    }
    Matrix::<N>::from_fn(|i, k| {
        let (r, s) = ((k + 1) % 3, (k + 2) % 3);
        let (c, d) = ((i + 1) % 3, (i + 2) % 3);
        a[(r, c)] * a[(s, d)] - a[(r, d)] * a[(s, c)]
    })
}

/// `det A`, by the first row.
fn determinant<const N: usize>(a: &Matrix<N>) -> f64 {
    let cofactors = adjugate(a);
    (0..N).map(|k| a[(0, k)] * cofactors[(k, 0)]).sum()
}
