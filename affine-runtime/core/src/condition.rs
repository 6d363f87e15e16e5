//! Condition number of the Legendre transformation.

use crate::constraint::Constraint;
use crate::description::Description;
use crate::matrix::Matrix;
use crate::quantity::Quantity;
use crate::scalar::Scalar;

/// Most directions that are free, those of `gl(3)`.
const MOST: usize = 9;
/// Sweeps of plane rotations, at most; a diagonal matrix takes one, any other some six.
const SWEEPS: usize = 30;

/// Quotient of the largest and the least singular value of the map from momentum to velocity at zero momentum, in the
/// frame of the model's own affine momentum and over the directions that a constraint leaves free; `None` where it has no
/// linear part, or numbers overflow.
///
/// The directions are those on which isotropic energies are multiples of the identity: traceless symmetric, skew, trace.
/// They have whole entries, so that of momenta along one of them nothing is left over for the others.
///
/// `velocity` gives `phi_dot` of an affine momentum at `phi`, in bases in which the metrics are the identity.
pub(crate) fn condition<const N: usize>(
    description: &Description,
    phi: &Matrix<N>,
    velocity: impl Fn(&Matrix<N>) -> Matrix<N>,
) -> Option<f64> {
    let (directions, count) = directions::<N>(free(description));
    let directions = &directions[..count];
    let inverse = phi.try_inverse()?;
    let mut columns = [[0.0; MOST]; MOST];
    for (u, column) in directions.iter().zip(&mut columns) {
        let velocity = linear_part(description, &velocity, &inverse, u)?;
        for (v, entry) in directions.iter().zip(column.iter_mut()) {
            *entry = v.dot(&velocity) / (Scalar::sqrt(u.dot(u)) * Scalar::sqrt(v.dot(v)));
        }
    }
    let singular = singular_values(columns, count);
    let singular = &singular[..count];
    let largest = singular.iter().fold(0.0, |most, &s| if s > most { s } else { most });
    let least = singular.iter().fold(f64::INFINITY, |least, &s| if s < least { s } else { least });
    let sound = largest > 0.0 && singular.iter().all(|s| s.is_finite());
    sound.then_some(largest / least)
}

/// Which velocities are free: traceless symmetric, skew, trace.
type Free = [bool; 3];

fn free(description: &Description) -> Free {
    match description.constraint {
        None => [true; 3],
        Some(Constraint::Isochoric) => [true, true, false],
        Some(Constraint::Rigid) => [false, true, false],
        Some(Constraint::Conformal) => [false, true, true],
    }
}

/// An orthogonal basis of those, and its length.
fn directions<const N: usize>([symmetric, skew, trace]: Free) -> ([Matrix<N>; MOST], usize) {
    let mut list = [Matrix::<N>::zeros(); MOST];
    let mut count = 0;
    let mut add = |wanted: bool, entries: &[(usize, usize, f64)]| {
        if wanted && count < MOST {
            entries.iter().for_each(|&(a, b, value)| list[count][(a, b)] = value);
            count += 1;
        }
    };
    for b in 0..N {
        for a in 0..b {
            add(symmetric, &[(a, b, 1.0), (b, a, 1.0)]);
            add(skew, &[(a, b, 1.0), (b, a, -1.0)]);
        }
    }
    add(symmetric, &[(0, 0, 1.0), (1, 1, -1.0)]);
    if N == 3 {
        add(symmetric, &[(0, 0, 1.0), (1, 1, 1.0), (2, 2, -2.0)]);
    }
    let unit: [(usize, usize, f64); N] = core::array::from_fn(|a| (a, a, 1.0));
    add(trace, &unit);
    (list, count)
}

/// The part of the velocity that is odd in the momentum, in the frame of the momentum.
fn linear_part<const N: usize>(
    description: &Description,
    velocity: &impl Fn(&Matrix<N>) -> Matrix<N>,
    inverse: &Matrix<N>,
    momentum: &Matrix<N>,
) -> Option<Matrix<N>> {
    let is_affine = |quantity: &Quantity| {
        matches!(quantity, Quantity::ComovingAffineSpin | Quantity::AffineSpin | Quantity::CanonicalMomentum)
    };
    let frame = description.full.iter().map(|group| group.quantity).find(is_affine)?;
    let along = |sign: f64| {
        let phi_dot = velocity(&(momentum * sign));
        match frame {
            Quantity::ComovingAffineSpin => inverse * phi_dot,
            Quantity::AffineSpin => phi_dot * inverse,
            _ => phi_dot,
        }
    };
    Some((along(1.0) - along(-1.0)) * 0.5)
}

/// Norms of columns made orthogonal by rotations in planes: small singular values keep their digits (Demmel and Veselic,
/// "Jacobi's method is more accurate than QR", 1992).
fn singular_values(mut columns: [[f64; MOST]; MOST], count: usize) -> [f64; MOST] {
    let dot = |a: &[f64; MOST], b: &[f64; MOST]| -> f64 { a.iter().zip(b).map(|(a, b)| a * b).sum() };
    for _ in 0..SWEEPS {
        let mut rotated = false;
        for k in 1..count {
            for j in 0..k {
                let (left, right) = (columns[j], columns[k]);
                let (a, b, c) = (dot(&left, &left), dot(&right, &right), dot(&left, &right));
                if c.abs() <= f64::EPSILON * Scalar::sqrt(a * b) || !c.is_finite() {
                    continue;
                }
                rotated = true;
                let slope = (b - a) / (2.0 * c);
                let tangent = slope.signum() / (slope.abs() + Scalar::sqrt(1.0 + slope * slope));
                let cosine = 1.0 / Scalar::sqrt(1.0 + tangent * tangent);
                let sine = cosine * tangent;
                columns[j] = core::array::from_fn(|i| cosine * left[i] - sine * right[i]);
                columns[k] = core::array::from_fn(|i| sine * left[i] + cosine * right[i]);
            }
        }
        if !rotated {
            break;
        }
    }
    columns.map(|column| Scalar::sqrt(dot(&column, &column)))
}

#[cfg(test)]
mod tests {
    use super::{MOST, singular_values};

    #[test]
    fn small_singular_values_keep_their_digits() {
        // [[1, 1], [0, 1e-9]]: the product of both is 1e-9, the sum of their squares 2 + 1e-18.
        let mut columns = [[0.0; MOST]; MOST];
        columns[0][0] = 1.0;
        columns[1] = core::array::from_fn(|i| [1.0, 1e-9].get(i).copied().unwrap_or(0.0));
        let [a, b, ..] = singular_values(columns, 2);
        let (large, small) = if a > b { (a, b) } else { (b, a) };
        assert!((large - core::f64::consts::SQRT_2).abs() < 1e-15, "{large:e}");
        assert!((small / 1e-9 * core::f64::consts::SQRT_2 - 1.0).abs() < 1e-14, "{small:e}");
    }

    #[test]
    fn a_diagonal_matrix_is_left_alone() {
        let mut columns = [[0.0; MOST]; MOST];
        (0..3).for_each(|k| columns[k][k] = [3.0, -1e-100, 1e100][k]);
        assert_eq!(singular_values(columns, 3)[..3], [3.0, 1e-100, 1e100]);
    }
}
