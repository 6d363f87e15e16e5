//! Bodies of d'Alembert with hand-written canonical equations over `phi, Pi`, row by row.

use affine_integrators::Rattle;
use affine_integrators::rattle::Composition;
use affine_runtime::frames::Matrix;
use affine_runtime::model::{Group, Quantity};

pub(crate) const SPACE: &[Group] =
    &[Group::new(Quantity::Placement, 9), Group::new(Quantity::CanonicalMomentum, 9)];
pub(crate) const PLANE: &[Group] =
    &[Group::new(Quantity::Placement, 4), Group::new(Quantity::CanonicalMomentum, 4)];

pub(crate) fn groups<const N: usize>() -> &'static [Group] {
    if N == 2 { PLANE } else { SPACE }
}

pub(crate) fn part<const N: usize>(y: &[f64], k: usize) -> Matrix<N> {
    Matrix::<N>::from_row_slice(&y[k * N * N..(k + 1) * N * N])
}

pub(crate) fn state<const N: usize, const D: usize>(phi: &Matrix<N>, pi: &Matrix<N>) -> [f64; D] {
    let mut y = [0.0; D];
    for k in 0..N * N {
        y[k] = phi[(k / N, k % N)];
        y[N * N + k] = pi[(k / N, k % N)];
    }
    y
}

/// `T = tr(Pi^T J^-1 Pi)/2`, `U = c/2 tr(G) + d/8 tr(G^2) + e sin(w t) G_11`, `G = phi^T phi`: nonlinear, driven where
/// `e != 0`, invariant under rotations of space.
#[derive(Clone, Copy)]
pub(crate) struct Elastic<const N: usize> {
    pub(crate) inertia: [f64; N],
    pub(crate) c: f64,
    pub(crate) d: f64,
    pub(crate) e: f64,
    pub(crate) w: f64,
}

impl<const N: usize> Elastic<N> {
    /// `phi' = (J^-1 Pi)^T`, `Pi' = -(dU/dphi)^T`.
    pub(crate) fn equations<const D: usize>(self) -> impl Fn(f64, &[f64; D]) -> [f64; D] + Copy {
        move |t, y| {
            let (phi, pi) = (part::<N>(y, 0), part::<N>(y, 1));
            let velocity = Matrix::<N>::from_fn(|i, a| pi[(a, i)] / self.inertia[a]);
            let gram = phi.transpose() * phi;
            let mut slope = Matrix::<N>::identity() * self.c + gram * (0.5 * self.d);
            slope[(0, 0)] += 2.0 * self.e * (self.w * t).sin();
            state(&velocity, &-(phi * slope).transpose())
        }
    }

    pub(crate) fn energy(&self, y: &[f64]) -> f64 {
        let (phi, pi) = (part::<N>(y, 0), part::<N>(y, 1));
        let gram = phi.transpose() * phi;
        let kinetic: f64 =
            (0..N).map(|a| (0..N).map(|i| pi[(a, i)] * pi[(a, i)]).sum::<f64>() / self.inertia[a]).sum();
        0.5 * kinetic + 0.5 * self.c * gram.trace() + 0.125 * self.d * (gram * gram).trace()
    }

    /// `tr(phi^-1 phi_dot)`.
    pub(crate) fn expansion(&self, y: &[f64]) -> f64 {
        let (phi, pi) = (part::<N>(y, 0), part::<N>(y, 1));
        let velocity = Matrix::<N>::from_fn(|i, a| pi[(a, i)] / self.inertia[a]);
        (phi.try_inverse().unwrap() * velocity).trace()
    }
}

pub(crate) const TRIAXIAL: Elastic<3> = Elastic { inertia: [1.0, 1.5, 0.7], c: 0.8, d: 0.5, e: 0.0, w: 0.0 };
pub(crate) const DRIVEN: Elastic<3> = Elastic { e: 0.3, w: 1.7, ..TRIAXIAL };
pub(crate) const ISOTROPIC: Elastic<3> = Elastic { inertia: [1.3; 3], c: 0.8, d: 0.5, e: 0.0, w: 0.0 };
pub(crate) const DISC: Elastic<2> = Elastic { inertia: [1.0, 1.4], c: 0.6, d: 0.4, e: 0.2, w: 1.3 };

/// A start on both constraints: `phi_dot = phi L`, `tr L = 0`.
pub(crate) fn start<const N: usize, const D: usize>(body: &Elastic<N>) -> [f64; D] {
    let last = N - 1;
    let mut shear = Matrix::<N>::identity();
    shear[(0, last)] = 0.3;
    let mut squeeze = Matrix::<N>::identity();
    (squeeze[(0, 0)], squeeze[(last, last)]) = (1.25, 0.8);
    let phi = shear * squeeze * shear.transpose();
    let mut rate = Matrix::<N>::from_fn(|i, k| 0.5 * (1.0 + 2.3 * i as f64 - 1.9 * k as f64).sin());
    let mean = rate.trace() / N as f64;
    for k in 0..N {
        rate[(k, k)] -= mean;
    }
    let velocity = phi * rate;
    let pi = Matrix::<N>::from_fn(|a, i| body.inertia[a] * velocity[(i, a)]);
    state(&phi, &pi)
}

pub(crate) fn run<const N: usize, const D: usize, F: Fn(f64, &[f64; D]) -> [f64; D]>(
    f: F,
    order: usize,
    from: (f64, [f64; D]),
    t_end: f64,
    step: f64,
) -> Rattle<N, [f64; D], F> {
    let composition = Composition::of_order(order).unwrap();
    let mut run = Rattle::<N, _, _>::new(f, groups::<N>(), composition, from, t_end, step).unwrap();
    while !run.is_finished() {
        run.advance().unwrap();
    }
    run
}

pub(crate) fn determinant<const N: usize>(m: &Matrix<N>) -> f64 {
    let minor = |a: usize, b: usize| m[(1, a)] * m[(2, b)] - m[(1, b)] * m[(2, a)];
    if N == 2 {
        m[(0, 0)] * m[(1, 1)] - m[(0, 1)] * m[(1, 0)]
    } else {
        m[(0, 0)] * minor(1, 2) - m[(0, 1)] * minor(0, 2) + m[(0, 2)] * minor(0, 1)
    }
}

pub(crate) fn distance<const D: usize>(a: &[f64; D], b: &[f64; D]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}
