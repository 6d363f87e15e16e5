//! Hamilton's equations of any model over its plain array, the multiplier of a constraint included.

use crate::dual::Dual;
use crate::frames::{Matrix, inverse};
use crate::model::{Description, Model, Quantity, StateVector};
use crate::scalar::Real;
use crate::simulate::has_multiplier;

/// Where a quantity begins in the plain array.
pub(super) fn place(model: &Description, quantity: Quantity) -> Option<usize> {
    let index = model.full.iter().position(|group| group.quantity == quantity)?;
    Some(model.full[..index].iter().map(|group| group.len).sum())
}

/// The time derivative of the plain array.
///
/// With a multiplier, `dPi/dt = N + Lambda phi^-1`, where `tr(phi^-1 phi_dot)` keeps its value:
/// `tr(phi^-1 phi_ddot) = tr (phi^-1 phi_dot)^2`.
pub(super) fn rates<const N: usize, M: Model<N>, T: Real>(model: &M, t: T, full: &M::Full<T>) -> M::Full<T> {
    let mut rates = model.free_equations(t, full);
    if !has_multiplier(&M::DESCRIPTION) {
        return rates;
    }
    let (Some(placement), Some(momentum)) =
        (place(&M::DESCRIPTION, Quantity::Placement), place(&M::DESCRIPTION, Quantity::CanonicalMomentum))
    else {
        return rates;
    };
    let matrix =
        |state: &M::Full<T>| Matrix::<N, T>::from_row_slice(&state.as_ref()[placement..placement + N * N]);
    let to_body = inverse(&matrix(full));
    let mut reaction = M::Full::<T>::zeros();
    for k in 0..N * N {
        reaction.as_mut()[momentum + k] = to_body[(k / N, k % N)];
    }
    let acceleration = |direction: &M::Full<T>| {
        let slopes = along(full, direction, |state| model.free_equations(Dual::fixed(t), state));
        (to_body * matrix(&slopes)).trace()
    };
    let velocity = to_body * matrix(&rates);
    let multiplier = ((velocity * velocity).trace() - acceleration(&rates)) / acceleration(&reaction);
    for (rate, reaction) in rates.as_mut().iter_mut().zip(reaction.as_ref()) {
        *rate = multiplier.fma(*reaction, *rate);
    }
    rates
}

/// The derivative of a map along a direction.
fn along<T: Real, S: StateVector<T>, D: StateVector<Dual<T>>>(
    at: &S,
    direction: &S,
    map: impl Fn(&D) -> D,
) -> S {
    let mut varied = D::zeros();
    for ((both, value), slope) in varied.as_mut().iter_mut().zip(at.as_ref()).zip(direction.as_ref()) {
        *both = Dual { value: *value, slope: *slope };
    }
    let image = map(&varied);
    let mut slopes = S::zeros();
    slopes.as_mut().iter_mut().zip(image.as_ref()).for_each(|(slope, both)| *slope = both.slope);
    slopes
}
