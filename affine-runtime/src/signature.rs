//! The signature of a kinetic energy whose coefficients are known when the model is prepared.

use crate::frames::{Matrix, Vector};
use crate::inner::jacobi;
use crate::model::{Constraint, Model, Quantity, Velocity};

/// Degrees of freedom of the largest model: nine of the placement and three of the centre.
const LARGEST: usize = 12;
/// Of the sum of the sizes of all entries: what the differences of energies below leave of a zero.
const ROUNDINGS: f64 = 16.0;

/// Numbers of positive and negative squares of the kinetic energy `T(x_dot, phi_dot)` at the placement `phi`, on the
/// velocities that a constraint leaves free; by Sylvester's law of inertia the same at every placement where the energy
/// has constant coefficients in one frame.
///
/// From the values of the quadratic form, `T(u + v) - T(u) - T(v)` for `phi_dot = phi E`. Where the signature does not
/// depend on fields it stands in [`Description`](crate::model::Description). `None` where a square is zero to rounding
/// or a value is not finite.
#[must_use]
pub fn signature<const N: usize, M: Model<N>>(model: &M, phi: &Matrix<N>) -> Option<(usize, usize)> {
    let (velocities, count) = free_velocities::<N, M>(phi);
    let energy = |x_dot, phi_dot| model.kinetic_energy(phi, &Velocity { x_dot, phi_dot });
    let own: [f64; LARGEST] = velocities.each_ref().map(|u| energy(u.x_dot, u.phi_dot));
    let form = nalgebra::SMatrix::<f64, LARGEST, LARGEST>::from_fn(|a, b| {
        let (u, v) = (&velocities[a], &velocities[b]);
        energy(u.x_dot + v.x_dot, u.phi_dot + v.phi_dot) - own[a] - own[b]
    });
    // A sum of two equal velocities counts the square twice, as the Hessian does.
    let threshold = ROUNDINGS * f64::EPSILON * form.iter().map(|entry| entry.abs()).sum::<f64>();
    let values = jacobi::<LARGEST, f64>(form).values;
    let positive = values.iter().filter(|value| **value > threshold).count();
    let negative = values.iter().filter(|value| **value < -threshold).count();
    (positive + negative == count).then_some((positive, negative))
}

/// A basis of the velocities that are free, filled up with zeros, and its length.
fn free_velocities<const N: usize, M: Model<N>>(phi: &Matrix<N>) -> ([Velocity<N>; LARGEST], usize) {
    let zero = Velocity { x_dot: Vector::<N>::zeros(), phi_dot: Matrix::<N>::zeros() };
    let mut list = [zero; LARGEST];
    let mut count = 0;
    let mut add = |velocity: Velocity<N>| {
        list[count] = velocity;
        count += 1;
    };
    let constraint = M::DESCRIPTION.constraint;
    let shear = !matches!(constraint, Some(Constraint::Rigid | Constraint::Conformal));
    let dilatation = !matches!(constraint, Some(Constraint::Rigid | Constraint::Isochoric));
    let unit = |a: usize, b: usize| {
        let mut unit = Matrix::<N>::zeros();
        unit[(a, b)] = 1.0;
        unit
    };
    let mut turn = |e: Matrix<N>| add(Velocity { phi_dot: phi * e, ..zero });
    for a in 0..N {
        for b in 0..a {
            turn(unit(a, b) - unit(b, a));
            if shear {
                turn(unit(a, b) + unit(b, a));
            }
        }
        if shear && a > 0 {
            turn(unit(a, a) - unit(a - 1, a - 1));
        }
    }
    if dilatation {
        turn(Matrix::<N>::identity());
    }
    if M::DESCRIPTION.full.iter().any(|group| group.quantity == Quantity::Position) {
        for i in 0..N {
            let mut x_dot = Vector::<N>::zeros();
            x_dot[i] = 1.0;
            add(Velocity { x_dot, ..zero });
        }
    }
    (list, count)
}
