//! Support for emitted reductions: turning space, closed forms, well-posedness of prepared models.

use crate::error::{Error, IllPosed, Result, UnitVelocity};
use crate::frames::{Matrix, Vector};
use crate::geodesic::Orbit;
use crate::scalar::Real;
use crate::state::Phase;

/// `I(O) = x p^T + Sigma`.
pub fn total_affine_momentum<const N: usize, T: Real>(point: &impl Phase<N, T>) -> Matrix<N, T> {
    point.x() * point.p().transpose() + point.sigma().0.0
}

/// A rotation `R` with `R p = (|p|, 0, ..)` and, for `n = 3` and a given `I(O)`, `(R I(O) R^T)_13 = 0`.
///
/// Products of plane rotations, each built from `hypot`: orthogonal to rounding for every `p`, zero included.
pub fn turn<const N: usize, T: Real>(p: &Vector<N, T>, total: Option<&Matrix<N, T>>) -> Matrix<N, T> {
    let mut turn = Matrix::<N, T>::identity();
    let mut direction = *p;
    for k in (1..N).rev() {
        rotate_into(&mut turn, 0, k, direction[0], direction[k]);
        direction = turn * p;
    }
    if let (3, Some(total)) = (N, total) {
        let turned = turn * total * turn.transpose();
        rotate_into(&mut turn, 1, 2, turned[(0, 1)], turned[(0, 2)]);
    }
    turn
}

/// Multiplies `turn` from the left by the rotation of the plane `(i, k)` that takes `(a, b)` to `(r, 0)`.
fn rotate_into<const N: usize, T: Real>(turn: &mut Matrix<N, T>, i: usize, k: usize, a: T, b: T) {
    let r = a.hypot(b);
    if r == T::zero() {
        return;
    }
    let (c, s) = (a / r, b / r);
    for column in 0..N {
        let (u, v) = (turn[(i, column)], turn[(k, column)]);
        turn[(i, column)] = c * u + s * v;
        turn[(k, column)] = c * v - s * u;
    }
}

impl<const N: usize> Orbit<N> {
    /// The closed form in the co-moving frame from `Sigma_hat` and `[1/alpha, 1/beta, 1/mu]`.
    #[must_use]
    pub fn body(spin: &Matrix<N>, inverse: [f64; 3]) -> Self {
        let (stretch, whirl) = generators(spin, inverse);
        Orbit::Body { stretch, whirl }
    }

    /// The closed form in the spatial frame from `Sigma` and `[1/alpha, 1/beta, 1/mu]`.
    #[must_use]
    pub fn space(spin: &Matrix<N>, inverse: [f64; 3]) -> Self {
        let (stretch, whirl) = generators(spin, inverse);
        Orbit::Space { stretch, whirl }
    }

    /// The same with `C(3)/3` in the Hamiltonian, `X^2` in the velocity: it commutes with `X` and adds `casimir3 X^2`
    /// to the stretch.
    #[must_use]
    pub fn with_square(mut self, spin: &Matrix<N>, casimir3: f64) -> Self {
        if let Orbit::Body { stretch, .. } | Orbit::Space { stretch, .. } = &mut self {
            *stretch += spin * spin * casimir3;
        }
        self
    }

    /// The straight line with the velocity `phi_dot0`.
    #[must_use]
    pub fn straight(velocity: Matrix<N>) -> Self {
        Orbit::Straight { velocity }
    }
}

/// `X/alpha + (tr X/beta) 1` and `-W/mu`, the latter left out where it vanishes.
fn generators<const N: usize>(spin: &Matrix<N>, inverse: [f64; 3]) -> (Matrix<N>, Option<Matrix<N>>) {
    let [alpha, beta, mu] = inverse;
    let stretch = spin * alpha + Matrix::<N>::identity() * (spin.trace() * beta);
    let whirl = (spin.transpose() - spin) * mu;
    (stretch, (whirl != Matrix::<N>::zeros()).then_some(whirl))
}

/// A quantity that must not vanish, with the size of the terms it is a sum of.
#[derive(Clone, Copy, Debug)]
pub struct Condition {
    /// The condition: `I + A != 0`.
    pub condition: &'static str,
    /// What fails without it.
    pub reason: &'static str,
    /// Must the value be positive?
    pub positive: bool,
    /// The value.
    pub value: f64,
    /// Sum of the sizes of its summands.
    pub size: f64,
}

/// `|a| + |b| + ...`
#[must_use]
pub fn total_size<const K: usize, T: Real>(summands: [T; K]) -> f64 {
    summands.iter().fold(0.0, |sum, s| sum + s.to_f64().abs())
}

/// Holds every value against `eps` times the largest sum of sizes.
///
/// # Errors
/// [`Error::IllPosed`] with the first condition that fails.
pub fn well_posed(conditions: &[Condition]) -> Result<()> {
    let scale = conditions.iter().map(|c| c.size).fold(0.0, f64::max);
    let threshold = f64::EPSILON * scale;
    let refused = |c: &Condition, threshold: f64| {
        let Condition { condition, reason, value, .. } = *c;
        Err(Error::IllPosed(IllPosed { condition, reason, value, threshold, velocity: None }))
    };
    // One that is not finite would be the threshold of the others.
    if let Some(c) = conditions.iter().find(|c| !c.value.is_finite()) {
        return refused(c, f64::MAX);
    }
    for c in conditions {
        let held = if c.positive { c.value } else { c.value.abs() };
        // A NaN is above nothing.
        if !held.gt(&threshold) {
            return refused(c, threshold);
        }
    }
    Ok(())
}

/// The fields that coefficients are computed from, each with its name, are finite.
///
/// # Errors
/// [`Error::FieldNotFinite`] with the first that is not.
pub fn finite_fields<T: Real>(fields: &[(&'static str, T)]) -> Result<()> {
    let mut values = fields.iter().map(|(field, value)| (*field, value.to_f64()));
    match values.find(|(_, value)| !value.is_finite()) {
        Some((field, value)) => Err(Error::FieldNotFinite { field, entry: None, value }),
        None => Ok(()),
    }
}

/// The coefficients, if all are finite: a value can pass its threshold and still have no reciprocal.
///
/// # Errors
/// [`Error::IllPosed`] with the first that is not.
pub fn finite<const K: usize, T: Real>(coefficients: [T; K]) -> Result<[T; K]> {
    let mut values = coefficients.iter().map(|c| c.to_f64());
    let Some(value) = values.find(|c| !c.is_finite()) else { return Ok(coefficients) };
    Err(Error::IllPosed(IllPosed {
        condition: "every coefficient is finite",
        reason: "a coefficient of the equations overflows, is divided by zero, or is a root or logarithm of a negative number; choose other fields, nearer to 1 in other units",
        value,
        threshold: f64::MAX,
        velocity: None,
    }))
}

/// Inverse of a symmetric form on affine velocities of dimension `N`, given by its upper triangle in a basis, as an
/// upper triangle: through its eigenvectors, so that the smallest eigenvalue is at hand. `M = K (K + 1)/2`; `size` is
/// that of the terms of all entries, and `basis` has the entries of each vector that are not zero: row-major place and
/// weight. It is the inverse in doubles, refined where the entries are more than doubles.
///
/// # Errors
/// [`Error::IllPosed`] where an eigenvalue is not above `eps` times `size`, or not positive on demand, with its
/// velocity.
pub fn inverse_form<const N: usize, const K: usize, const M: usize, T: Real>(
    upper: [T; M],
    size: f64,
    positive: bool,
    basis: [&[(usize, f64)]; K],
) -> Result<[T; M]> {
    let doubles = upper.map(Real::to_f64);
    let eigen = jacobi::<K, f64>(symmetric(&doubles));
    let threshold = f64::EPSILON * size;
    for (k, value) in eigen.values.into_iter().enumerate() {
        let held = if positive { value } else { value.abs() };
        if !(held > threshold && held.is_finite()) {
            return Err(Error::IllPosed(IllPosed {
                condition: if positive {
                    "T > 0 on every velocity"
                } else {
                    "T != 0 on every principal velocity"
                },
                reason: "the quadratic form of the velocities is degenerate to rounding or has the wrong sign; \
                         choose fields that keep its eigenvalues away from zero",
                value,
                threshold,
                velocity: value.is_finite().then(|| direction::<N, K>(&eigen, k, &basis)),
            }));
        }
    }
    let mut inverse = [0.0; M];
    for i in 0..K {
        for j in i..K {
            inverse[place::<K>(i, j)] =
                (0..K).map(|k| eigen.vectors[(i, k)] * eigen.vectors[(j, k)] / eigen.values[k]).sum();
        }
    }
    let inverse = inverse.map(T::from_f64);
    let is_double = upper == doubles.map(T::from_f64) && T::EPSILON.to_f64() >= f64::EPSILON;
    Ok(if is_double { inverse } else { refined::<K, M, T>(&upper, &inverse) })
}

/// The inverse of a form from one that is known roughly, `X <- X (2 - F X)`: the residue `1 - F X` is squared each time
/// (Schulz, ZAMM 13 (1933) 57).
fn refined<const K: usize, const M: usize, T: Real>(form: &[T; M], inverse: &[T; M]) -> [T; M] {
    let (form, mut inverse) = (symmetric::<K, M, T>(form), symmetric::<K, M, T>(inverse));
    let twice = nalgebra::SMatrix::<T, K, K>::identity() * T::from_f64(2.0);
    for _ in 0..REFINEMENTS {
        inverse = inverse * (twice - form * inverse);
    }
    let mut upper = [T::zero(); M];
    for i in 0..K {
        (i..K).for_each(|j| upper[place::<K>(i, j)] = inverse[(i, j)]);
    }
    upper
}

/// From a residue of 0.1, below any rounding of double-doubles.
const REFINEMENTS: usize = 6;

/// Eigenvalues and orthonormal eigenvectors, one after the other, of a symmetric form given by its upper triangle:
/// `F = sum over k of values[k] vectors[k]^T vectors[k]`. `M = K (K + 1)/2`.
#[must_use]
pub fn principal_axes<const K: usize, const M: usize, T: Real>(upper: [T; M]) -> ([T; K], [[T; K]; K]) {
    let Eigen { values, vectors } = jacobi::<K, T>(symmetric(&upper));
    (values, core::array::from_fn(|k| core::array::from_fn(|i| vectors[(i, k)])))
}

/// The eigenvector of place `k` as an affine velocity of unit size.
fn direction<const N: usize, const K: usize>(
    eigen: &Eigen<K, f64>,
    k: usize,
    basis: &[&[(usize, f64)]; K],
) -> UnitVelocity {
    let mut velocity = [[0.0; N]; N];
    for (i, vector) in basis.iter().enumerate() {
        for (entry, weight) in vector.iter() {
            velocity[entry / N][entry % N] += eigen.vectors[(i, k)] * weight;
        }
    }
    let norm = libm::sqrt(velocity.iter().flatten().map(|entry| entry * entry).sum());
    UnitVelocity::new(N, |entry| velocity[entry / N][entry % N] / norm)
}

/// The symmetric matrix with this upper triangle, row after row.
pub(crate) fn symmetric<const K: usize, const M: usize, T: Real>(
    upper: &[T; M],
) -> nalgebra::SMatrix<T, K, K> {
    nalgebra::SMatrix::from_fn(|i, j| upper[place::<K>(i, j)])
}

/// Where the entry stands in an upper triangle.
fn place<const K: usize>(i: usize, j: usize) -> usize {
    let (a, b) = (i.min(j), i.max(j));
    a * K - a * (a + 1) / 2 + b
}

/// Eigenvalues and orthonormal eigenvectors (columns).
pub struct Eigen<const K: usize, T> {
    pub values: [T; K],
    vectors: nalgebra::SMatrix<T, K, K>,
}

/// Cyclic Jacobi rotations (Golub and Van Loan, section 8.5): small symmetric matrices of any size `K` without
/// the dimension arithmetic that nalgebra's solver asks of its types, and of numbers with a derivative.
pub fn jacobi<const K: usize, T: Real>(mut form: nalgebra::SMatrix<T, K, K>) -> Eigen<K, T> {
    let (half, one) = (T::from_f64(0.5), T::one());
    let mut vectors = nalgebra::SMatrix::<T, K, K>::identity();
    for _sweep in 0..30 {
        let mut moved = false;
        for p in 0..K {
            for q in p + 1..K {
                let off = form[(p, q)];
                if off == T::zero() {
                    continue;
                }
                moved = true;
                // The root of smaller size of off t^2 + 2 gap t - off = 0; no quotient by `off`, whose slope may be all of it.
                let gap = half * (form[(q, q)] - form[(p, p)]);
                let t = off / (gap + gap.hypot(off).copysign(gap));
                let c = one / t.hypot(one);
                let s = t * c;
                for k in 0..K {
                    let (a, b) = (form[(k, p)], form[(k, q)]);
                    form[(k, p)] = c * a - s * b;
                    form[(k, q)] = s * a + c * b;
                }
                for k in 0..K {
                    let (a, b) = (form[(p, k)], form[(q, k)]);
                    form[(p, k)] = c * a - s * b;
                    form[(q, k)] = s * a + c * b;
                    let (a, b) = (vectors[(k, p)], vectors[(k, q)]);
                    vectors[(k, p)] = c * a - s * b;
                    vectors[(k, q)] = s * a + c * b;
                }
            }
        }
        if !moved {
            break;
        }
    }
    Eigen { values: core::array::from_fn(|k| form[(k, k)]), vectors }
}

/// The traceless part of an affine spin times `1/alpha`, in parts: its symmetric part on and above the diagonal, its
/// skew part `(X_ba - X_ab)/2`, `b < a`, below.
pub fn shear_and_turn<const N: usize, T: Real>(spin: &Matrix<N, T>, inverse_alpha: T) -> Matrix<N, T> {
    let half = T::from_f64(0.5);
    let mean = spin.trace() / crate::kinematics::integer(N);
    Matrix::from_fn(|a, b| {
        let part = match a.cmp(&b) {
            core::cmp::Ordering::Less => half * (spin[(a, b)] + spin[(b, a)]),
            core::cmp::Ordering::Equal => spin[(a, a)] - mean,
            core::cmp::Ordering::Greater => half * (spin[(b, a)] - spin[(a, b)]),
        };
        part * inverse_alpha
    })
}

/// The affine spin with these parts and this trace.
pub fn from_shear_and_turn<const N: usize, T: Real>(
    parts: &Matrix<N, T>,
    inverse_alpha: T,
    trace: T,
) -> Matrix<N, T> {
    let mean = trace / crate::kinematics::integer(N);
    Matrix::from_fn(|a, b| match a.cmp(&b) {
        core::cmp::Ordering::Less => (parts[(a, b)] + parts[(b, a)]) / inverse_alpha,
        core::cmp::Ordering::Equal => parts[(a, a)] / inverse_alpha + mean,
        core::cmp::Ordering::Greater => (parts[(b, a)] - parts[(a, b)]) / inverse_alpha,
    })
}
