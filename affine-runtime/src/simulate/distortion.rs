//! Placements whose determinant is the rounding of their entries: the body has not collapsed, but doubles no longer tell.

use super::point::determinant;
use crate::error::Reason;
use crate::frames::Matrix;
use crate::inner::{LogDeterminant, norm};

/// Part of the products that a determinant is the sum of, below which it is rounding: some hundred roundings of each.
const ROUNDED: f64 = 1e-13;
/// Part of these products below which it may be rounding a step away from there.
const NEARLY: f64 = 1e-10;
/// Part of these products that a determinant falls by while the body changes by as much as it is, where it falls to zero.
const FALLS: f64 = 1e-6;
/// Part of a value that rounding may make of a determinant.
const KNOWN: f64 = 0.1;

/// The sum of the absolute values of the products that the determinant is the sum of.
pub(super) fn products<const N: usize>(phi: &Matrix<N>) -> f64 {
    let size = |i: usize, k: usize| phi[(i, k)].abs();
    let minor = |a: usize, b: usize| size(1, a) * size(2, b) + size(1, b) * size(2, a);
    match N {
        2 => size(0, 0) * size(1, 1) + size(0, 1) * size(1, 0),
        3 => size(0, 0) * minor(1, 2) + size(0, 1) * minor(0, 2) + size(0, 2) * minor(0, 1),
        _ => f64::NAN,
    }
}

/// `|det phi|` over the sum of the absolute values of its products: what is left of its digits. 1 where that is not known.
pub(super) fn distinctness<const N: usize>(phi: &Matrix<N>) -> f64 {
    let products_of = products(phi);
    let part = if products_of.is_normal() {
        determinant(phi) / products_of
    } else {
        let unit = phi / norm(phi.as_slice());
        determinant(&unit) / products(&unit)
    };
    let part = part.abs();
    if part.is_nan() { 1.0 } else { part }
}

/// Is the determinant known so well that it can be held against a value?
pub(super) fn tells<const N: usize>(phi: &Matrix<N>, value: f64) -> bool {
    value == 0.0 || f64::EPSILON * products(phi) <= KNOWN * value.abs()
}

/// Why a motion whose stretches differ so much ends at a placement.
pub(super) fn far_apart<const N: usize>(phi: &Matrix<N>, t: f64) -> Reason {
    Reason::Distortion { determinant: LogDeterminant::of(phi).to_f64(), t }
}

/// The determinant is next to the rounding of its products.
pub(super) fn is_nearly_lost<const N: usize>(phi: &Matrix<N>) -> bool {
    distinctness(phi) < NEARLY
}

/// A determinant is the rounding of its products after a placement where it was next to that, and did not fall. `fall` is the part of
/// these by which it falls while the body changes by as much as it is.
pub(super) fn is_rounding<const N: usize>(determinant: f64, phi: &Matrix<N>, fall: f64) -> bool {
    fall < FALLS && determinant.abs() <= ROUNDED * products(phi) && is_nearly_lost(phi)
}

/// The reason with what the last good placement tells: where the determinant is [rounding](is_rounding), or was next to that and
/// grew, the body has not collapsed.
pub(super) fn told<const N: usize>(reason: Reason, phi: &Matrix<N>, fall: f64) -> Reason {
    match reason {
        Reason::Placement { determinant, rate: None, t } if is_rounding(determinant, phi, fall) => {
            Reason::Distortion { determinant, t }
        }
        Reason::Placement { determinant, rate: None, t }
            if determinant <= 0.0 && fall < 0.0 && is_nearly_lost(phi) =>
        {
            far_apart(phi, t)
        }
        Reason::Event { t, .. } if distinctness(phi) < ROUNDED => far_apart(phi, t),
        other => other,
    }
}
