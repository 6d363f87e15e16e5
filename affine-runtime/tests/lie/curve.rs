//! Curves on the groups that are known in closed form, and nonlinear, non-autonomous equations that they solve.

use affine_runtime::frames::Matrix;
use affine_runtime::model::Constraint;

pub(crate) const GROUPS: [Constraint; 3] = [Constraint::Isochoric, Constraint::Rigid, Constraint::Conformal];

/// A matrix function of time with its derivative.
#[derive(Clone, Copy)]
pub(crate) struct Moving<const N: usize> {
    pub(crate) value: Matrix<N>,
    pub(crate) rate: Matrix<N>,
}

impl<const N: usize> Moving<N> {
    fn times(&self, right: &Self) -> Self {
        Self { value: self.value * right.value, rate: self.rate * right.value + self.value * right.rate }
    }

    /// The rotation by `(angle, rate)` in the plane of the axes `i` and `k`.
    fn rotation(i: usize, k: usize, (angle, speed): (f64, f64)) -> Self {
        let (mut value, mut rate) = (Matrix::<N>::identity(), Matrix::<N>::zeros());
        let (sine, cosine) = angle.sin_cos();
        for (row, column, v, r) in
            [(i, i, cosine, -sine), (k, k, cosine, -sine), (k, i, sine, cosine), (i, k, -sine, -cosine)]
        {
            value[(row, column)] = v;
            rate[(row, column)] = r * speed;
        }
        Self { value, rate }
    }

    fn shear(i: usize, k: usize, (amount, speed): (f64, f64)) -> Self {
        let (mut value, mut rate) = (Matrix::<N>::identity(), Matrix::<N>::zeros());
        value[(i, k)] = amount;
        rate[(i, k)] = speed;
        Self { value, rate }
    }

    /// `exp(amount)` along the axis `i`, `exp(-amount)` along `k`.
    fn squeeze(i: usize, k: usize, (amount, speed): (f64, f64)) -> Self {
        let (mut value, mut rate) = (Matrix::<N>::identity(), Matrix::<N>::zeros());
        for (axis, sign) in [(i, 1.0), (k, -1.0)] {
            value[(axis, axis)] = (sign * amount).exp();
            rate[(axis, axis)] = sign * speed * (sign * amount).exp();
        }
        Self { value, rate }
    }

    fn dilatation((amount, speed): (f64, f64)) -> Self {
        let value = Matrix::<N>::identity() * amount.exp();
        Self { value, rate: value * speed }
    }
}

/// `sin(w t) + a` and its derivative.
fn swing(w: f64, a: f64, t: f64) -> (f64, f64) {
    ((w * t).sin() + a, w * (w * t).cos())
}

/// The curve on the group of `constraint` that the equations below have for a solution.
pub(crate) fn exact<const N: usize>(constraint: Constraint, t: f64) -> Moving<N> {
    let last = N - 1;
    let turn =
        Moving::rotation(0, 1, swing(1.3, 0.2, t)).times(&Moving::rotation(0, last, (0.4 * t * t, 0.8 * t)));
    match constraint {
        Constraint::Rigid => turn,
        Constraint::Conformal => turn.times(&Moving::dilatation(swing(0.9, 0.1, t))),
        Constraint::Isochoric => {
            let sheared = turn.times(&Moving::shear(last, 0, swing(0.7, -0.3, t)));
            sheared.times(&Moving::squeeze(0, last, swing(1.1, 0.1, t)))
        }
    }
}

/// The scalar that moves with the curve: `cos 2t`.
pub(crate) fn scalar(t: f64) -> f64 {
    (2.0 * t).cos()
}

/// The part of a matrix in the Lie algebra.
pub(crate) fn project<const N: usize>(constraint: Constraint, m: &Matrix<N>) -> Matrix<N> {
    let mean = Matrix::<N>::identity() * (m.trace() / N as f64);
    match constraint {
        Constraint::Isochoric => m - mean,
        Constraint::Rigid => (m - m.transpose()) * 0.5,
        Constraint::Conformal => (m - m.transpose()) * 0.5 + mean,
    }
}

/// `phi' = phi (Oh(t) + P(K (psi - 1) psi + (s - cos 2t)^2 L))`, `psi = phi_exact^-1 phi`,
/// `s' = -2 sin 2t + (s - cos 2t) tr(psi) + tr(psi - 1)`: solved by the curve and by `s = cos 2t`.
pub(crate) fn equations<const N: usize, const D: usize>(
    constraint: Constraint,
) -> impl Fn(f64, &[f64; D]) -> [f64; D] + Copy {
    move |t, y| {
        let phi = Matrix::<N>::from_row_slice(&y[..N * N]);
        let curve = exact::<N>(constraint, t);
        let back = curve.value.try_inverse().unwrap();
        let psi = back * phi;
        let defect = psi - Matrix::<N>::identity();
        let lag = y[N * N] - scalar(t);
        let k = Matrix::<N>::from_fn(|i, j| 0.3 + 0.4 * i as f64 - 0.5 * j as f64);
        let pull = k * defect * psi + k.transpose() * (lag * lag);
        let oh = back * curve.rate + project(constraint, &pull);
        let mut rates = [0.0; D];
        write(&mut rates, &(phi * oh));
        rates[N * N] = -2.0 * (2.0 * t).sin() + lag * psi.trace() + defect.trace();
        rates
    }
}

/// The state on the solution.
pub(crate) fn solution<const N: usize, const D: usize>(constraint: Constraint, t: f64) -> [f64; D] {
    let mut y = [0.0; D];
    write(&mut y, &exact::<N>(constraint, t).value);
    y[N * N] = scalar(t);
    y
}

pub(crate) fn write<const N: usize>(y: &mut [f64], matrix: &Matrix<N>) {
    for k in 0..N * N {
        y[k] = matrix[(k / N, k % N)];
    }
}

/// How far a matrix is from the group.
pub(crate) fn defect<const N: usize>(constraint: Constraint, phi: &Matrix<N>) -> f64 {
    let gram = phi.transpose() * phi;
    match constraint {
        Constraint::Isochoric => (determinant(phi) - 1.0).abs(),
        Constraint::Rigid => (gram - Matrix::<N>::identity()).norm(),
        Constraint::Conformal => (gram * (N as f64 / gram.trace()) - Matrix::<N>::identity()).norm(),
    }
}

pub(crate) fn determinant<const N: usize>(m: &Matrix<N>) -> f64 {
    let minor = |a: usize, b: usize| m[(1, a)] * m[(2, b)] - m[(1, b)] * m[(2, a)];
    if N == 2 {
        m[(0, 0)] * m[(1, 1)] - m[(0, 1)] * m[(1, 0)]
    } else {
        m[(0, 0)] * minor(1, 2) - m[(0, 1)] * minor(0, 2) + m[(0, 2)] * minor(0, 1)
    }
}

/// Largest difference of two states.
pub(crate) fn distance<const D: usize>(a: &[f64; D], b: &[f64; D]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}
