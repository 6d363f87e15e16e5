//! Confined phase points: placements on a subgroup of GL+(n), affine velocities in its Lie algebra, affine spins in the dual of
//! that.
//!
//! The dual is identified by the pairing `tr(X O)` with matrices of the same kind as the velocities: traceless, skew,
//! or skew plus a multiple of the identity. The kind is the same in space and in the body.

use crate::constraint::Constraint;
use crate::error::{Error, Result};
use crate::frames::{Frame, Matrix, Momentum};
use crate::kinematics::LogDeterminant;
use crate::matrix::inverse;
use crate::parts::Translation;
use crate::scalar::Real;
use crate::state::PhasePoint;

/// How far from a constraint a point may start, in units of the rounding of its entries: what a product of three
/// matrices and an inverse leave, with some to spare.
const ROUNDINGS: f64 = 32.0;

/// `P X`: the traceless part `X - (tr X/n) 1` (isochoric), the skew part `(X - X^T)/2` (rigid), or the skew part and
/// `(tr X/n) 1` (conformal).
pub fn projected<const N: usize, T: Real>(constraint: Constraint, x: &Matrix<N, T>) -> Matrix<N, T> {
    let mean = || x.trace() / T::constant(N as f64, 0.0);
    let half = T::constant(0.5, 0.0);
    let skew = || (x - x.transpose()) * half;
    match constraint {
        Constraint::Isochoric => x - Matrix::<N, T>::identity() * mean(),
        Constraint::Rigid => skew(),
        Constraint::Conformal => skew() + Matrix::<N, T>::identity() * mean(),
    }
}

/// The placement lies on the group to rounding: `|det phi - 1|` against `|phi| |adj phi|`, `|phi^T phi - 1|` or
/// `|phi^T phi - (tr phi^T phi/n) 1|` against `|phi|^2`, all in the Frobenius norm.
///
/// # Errors
/// [`Error::Placement`] unless `phi` is finite and `det phi > 0`; [`Error::OffConstraint`].
pub fn on_the_group<const N: usize>(constraint: Constraint, phi: &Matrix<N>) -> Result<()> {
    let determinant = LogDeterminant::of(phi);
    if !determinant.is_positive() {
        return Err(Error::Placement { determinant: determinant.to_f64() });
    }
    let green = || phi.tr_mul(phi);
    let (defect, size) = match constraint {
        Constraint::Isochoric => {
            let determinant = determinant.to_f64();
            (libm::fabs(determinant - 1.0), determinant * phi.norm() * inverse(phi).norm())
        }
        Constraint::Rigid => ((green() - Matrix::<N>::identity()).norm(), phi.norm_squared()),
        Constraint::Conformal => {
            let green = green();
            ((green - projected(constraint, &green)).norm(), phi.norm_squared())
        }
    };
    held(constraint, "phi", defect, size)
}

/// The velocity is tangent to the group at `phi`: `Oh = phi^-1 phi_dot` lies in the Lie algebra, its distance from it
/// held against `|phi^-1| |phi_dot|`.
///
/// # Errors
/// [`Error::NotFinite`], [`Error::OffConstraint`].
pub fn in_the_algebra<const N: usize>(
    constraint: Constraint,
    phi: &Matrix<N>,
    phi_dot: &Matrix<N>,
) -> Result<()> {
    if !phi_dot.iter().all(|entry| entry.is_finite()) {
        return Err(Error::NotFinite { quantity: "phi_dot" });
    }
    let to_body = inverse(phi);
    let velocity = to_body * phi_dot;
    let defect = (velocity - projected(constraint, &velocity)).norm();
    held(constraint, "phi_dot", defect, to_body.norm() * phi_dot.norm())
}

/// The phase point with a momentum given in any frame, checked and projected: its distance from the dual of the Lie
/// algebra is held against `|phi| |phi^-1| |X|`, what a change of frame can lose.
///
/// # Errors
/// [`Error::Placement`], [`Error::NotFinite`], [`Error::OffConstraint`].
pub fn confined_point<const N: usize, F: Frame, C: Translation<N, f64>>(
    constraint: Constraint,
    phi: Matrix<N>,
    momentum: impl Momentum<N, f64>,
    centre: C,
) -> Result<PhasePoint<N, F, C>> {
    on_the_group(constraint, &phi)?;
    let point = PhasePoint::<N, F, C>::checked(phi, momentum, centre)?;
    point.respinned(|spin| {
        let momentum = projected(constraint, spin);
        let size = phi.norm() * inverse(&phi).norm() * spin.norm();
        held(constraint, F::MOMENTUM, (spin - momentum).norm(), size)?;
        Ok(momentum)
    })
}

/// `defect <= 32 eps size`, which NaN does not satisfy.
fn held(constraint: Constraint, quantity: &'static str, defect: f64, size: f64) -> Result<()> {
    let threshold = ROUNDINGS * f64::EPSILON * size;
    if defect <= threshold {
        return Ok(());
    }
    Err(Error::OffConstraint { constraint, quantity, defect, threshold })
}
