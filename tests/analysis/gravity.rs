//! A homogeneous, incompressible, self-gravitating ellipsoid in units `G = M = 1`, the unit ball at `phi = 1`:
//! `T = tr(phi_dot^T phi_dot)/10`, `U = -(3/5) R_F(a_1^2, a_2^2, a_3^2)`.
//!
//! `R_F(x, y, z)`, half the integral of `((t + x)(t + y)(t + z))^(-1/2)` over positive `t`, is by `t = 1/s^2 - 1` that of
//! `p(s^2)^(-1/2)` from 0 to 1, with `p(u) = (1-u)^3 + I_1 u (1-u)^2 + I_2 u^2 (1-u) + I_3 u^3` in the invariants of the squares:
//! here by the rule of Gauss and Legendre, whose error falls like `1.38^(-192)` for the longest axes of these tests. The example
//! `ellipsoids` goes another way, by duplication.

use std::sync::OnceLock;

use affine_runtime::frames::Matrix;
use affine_runtime::potential::{Class, Place, Potential, Slopes};
use affine_runtime::prelude::*;
use affine_runtime::scalar::Scalar;

#[affine_model(
    dim = 3,
    constraint = isochoric,
    kinetic(dalembert = 0.2),
    potential = custom(gravity, isotropic),
)]
pub(crate) struct Star {
    pub(crate) gravity: Gravity,
}

pub(crate) const STAR: Star = Star { gravity: Gravity };

/// `pi G rho`: the ball of volume `4 pi/3` has mass 1. Squares of frequencies are known in this unit.
pub(crate) const PI_G_RHO: f64 = 0.75;

#[derive(Clone, Copy, Debug)]
pub(crate) struct Gravity;

impl Potential<3> for Gravity {
    const CLASS: Class = Class::Isotropic;

    fn energy<T: Scalar>(&self, place: &Place<3, T>) -> T {
        let own = invariants(&place.phi);
        let sum = nodes()
            .iter()
            .fold(T::zero(), |sum, [u, weight]| sum + number::<T>(*weight) / polynomial(*u, own).sqrt());
        -(number::<T>(0.6) * sum)
    }

    fn slopes<T: Scalar>(&self, place: &Place<3, T>) -> Slopes<3, T> {
        let phi = &place.phi;
        let own = invariants(phi);
        let mut by = [T::zero(); 3];
        for [u, weight] in nodes() {
            let p = polynomial(*u, own);
            let factor = number::<T>(0.3 * weight) / (p * p.sqrt());
            for (k, by) in (0_i32..).zip(&mut by) {
                *by += factor * number(u.powi(k + 1) * (1.0 - u).powi(2 - k));
            }
        }
        let green = phi.transpose() * phi;
        let cofactors = cofactors(phi);
        let det = determinant(phi);
        let two = number::<T>(2.0);
        let slopes = phi * (by[0] + by[1] * own[0]) - phi * green * by[1] + cofactors * (by[2] * det);
        Slopes { x: Vector::<3, T>::zeros(), phi: slopes * two }
    }
}

fn number<T: Scalar>(value: f64) -> T {
    T::constant(value, 0.0)
}

fn polynomial<T: Scalar>(u: f64, [first, second, third]: [T; 3]) -> T {
    let v = 1.0 - u;
    number::<T>(v * v * v)
        + first * number(u * v * v)
        + second * number(u * u * v)
        + third * number(u * u * u)
}

/// Of `phi^T phi`.
fn invariants<T: Scalar>(phi: &Matrix<3, T>) -> [T; 3] {
    let green = phi.transpose() * phi;
    let (first, det) = (green.trace(), determinant(phi));
    [first, (first * first - (green * green).trace()) * number(0.5), det * det]
}

fn cofactors<T: Scalar>(phi: &Matrix<3, T>) -> Matrix<3, T> {
    Matrix::<3, T>::from_fn(|i, a| {
        let ([j, k], [b, c]) = ([(i + 1) % 3, (i + 2) % 3], [(a + 1) % 3, (a + 2) % 3]);
        phi[(j, b)] * phi[(k, c)] - phi[(j, c)] * phi[(k, b)]
    })
}

fn determinant<T: Scalar>(phi: &Matrix<3, T>) -> T {
    let cofactors = cofactors(phi);
    (0..3).fold(T::zero(), |sum, a| sum + phi[(0, a)] * cofactors[(0, a)])
}

/// `[s^2, weight]` of the positive nodes between -1 and 1.
fn nodes() -> &'static [[f64; 2]] {
    static NODES: OnceLock<Vec<[f64; 2]>> = OnceLock::new();
    NODES.get_or_init(|| (0..HALF).map(node).collect())
}

const HALF: usize = 48;

/// By Newton's iteration on Legendre's polynomial of degree `2 HALF`.
fn node(k: usize) -> [f64; 2] {
    let degree = 2 * HALF;
    let mut s = (std::f64::consts::PI * (k as f64 + 0.75) / (degree as f64 + 0.5)).cos();
    let mut slope = 1.0;
    for _ in 0..8 {
        let (mut before, mut now) = (1.0, s);
        for n in 2..=degree {
            let n = n as f64;
            (before, now) = (now, ((2.0 * n - 1.0) * s * now - (n - 1.0) * before) / n);
        }
        slope = degree as f64 * (s * now - before) / (s * s - 1.0);
        s -= now / slope;
    }
    [s * s, 2.0 / ((1.0 - s * s) * slope * slope)]
}
