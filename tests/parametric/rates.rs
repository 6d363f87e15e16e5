//! Rates of a motion over any number, by Hamilton's equations and by the reduced ones; the same from the oracle.

use affine_oracle::{Kinetic, Matrix as Exact, Observable, Rational, State, exact};
use affine_runtime::dual::Dual;
use affine_runtime::model::Quantity;
use affine_runtime::parametric::Parametric;
use affine_runtime::prelude::*;
use affine_runtime::scalar::Real;

use crate::numbers::vector;

/// Time of the start.
pub(crate) const T0: f64 = 0.25;

/// The plain array over another number.
pub(crate) fn over<const N: usize, M: Model<N>, T: Real>(full: &M::Full<f64>) -> M::Full<T> {
    vector(|k| T::from_f64(full.as_ref()[k]))
}

/// The rates of the plain array.
pub(crate) fn of_full<const N: usize, M: Parametric<N>, T: Real>(
    model: &M,
    coefficients: &M::Coefficients<T>,
    full: &M::Full<T>,
) -> Vec<T> {
    model.hamilton_equations_with(coefficients, T::from_f64(T0), full).as_ref().to_vec()
}

/// Where the motion through a plain array is a while later, were it not for the reduced equations: only what moves in closed form
/// has moved. The array there, and its rates as the derivative of `expand` along the reduced equations.
pub(crate) fn of_reduced<const N: usize, M: Parametric<N>, T: Real>(
    model: &M,
    coefficients: &M::Coefficients<T>,
    full: &M::Full<T>,
) -> (M::Full<T>, Vec<T>) {
    let coefficients: M::Coefficients<Dual<T>> = vector(|k| Dual::fixed(coefficients.as_ref()[k]));
    let full: M::Full<Dual<T>> = vector(|k| Dual::fixed(full.as_ref()[k]));
    let point = model.unflatten_with(&coefficients, &full);
    let start = Dual::fixed(T::from_f64(T0 - 0.75));
    let now = Dual { value: T::from_f64(T0), slope: T::one() };
    let (mut reduced, constants) = model.reduce_with(&coefficients, start, &point);
    let rates = model.reduced_equations_with(&coefficients, now, &constants, &reduced);
    for (state, rate) in reduced.as_mut().iter_mut().zip(rates.as_ref()) {
        state.slope = rate.value;
    }
    let moving = model.expand_with(&coefficients, now, &constants, &reduced);
    let there = model.flatten_with(&coefficients, &moving);
    (vector(|k| there.as_ref()[k].value), there.as_ref().iter().map(|number| number.slope).collect())
}

/// The exact rates of the plain array of a motion without forces.
pub(crate) fn exactly<const N: usize, M: Model<N>>(kinetic: &Kinetic, full: &M::Full<f64>) -> Vec<Rational> {
    let state = state::<N, M>(full);
    let motion = kinetic.motion(&state).unwrap();
    let bracket = |observable| motion.bracket(observable).unwrap().entries();
    let of_group = |quantity: Quantity| match quantity {
        Quantity::Position => motion.rate().x.entries(),
        Quantity::Placement => motion.rate().phi.entries(),
        Quantity::LinearMomentum => motion.rate().p.entries(),
        Quantity::ComovingLinearMomentum => bracket(Observable::ComovingLinearMomentum),
        Quantity::CanonicalMomentum => motion.rate().pi.entries(),
        Quantity::ComovingAffineSpin => bracket(Observable::ComovingAffineSpin),
        other => panic!("no model here has {other:?}"),
    };
    M::DESCRIPTION.full.iter().flat_map(|group| of_group(group.quantity)).collect()
}

/// The plain array, taken at its word.
fn state<const N: usize, M: Model<N>>(full: &M::Full<f64>) -> State {
    let zero = || Exact::zeros(N, 1);
    let (mut x, mut phi, mut p) = (zero(), Exact::identity(N), zero());
    let mut rest = full.as_ref();
    for group in M::DESCRIPTION.full {
        let (part, after) = rest.split_at(group.len);
        rest = after;
        let entries: Vec<Rational> = part.iter().map(|entry| exact(*entry).unwrap()).collect();
        let matrix = Exact::from_rationals(N, group.len / N, &entries);
        match group.quantity {
            Quantity::Position => x = matrix,
            Quantity::Placement => phi = matrix,
            Quantity::LinearMomentum => p = matrix,
            Quantity::ComovingLinearMomentum => p = &phi.inverse().unwrap().transpose() * &matrix,
            Quantity::CanonicalMomentum => return State::new(x, phi, p, matrix).unwrap(),
            Quantity::ComovingAffineSpin => {
                return State::with_comoving_affine_spin(x, phi, p, &matrix).unwrap();
            }
            other => panic!("no model here has {other:?}"),
        }
    }
    panic!("every array has an affine momentum")
}

/// The exact kinetic energy of a plain array.
pub(crate) fn energy<const N: usize, M: Model<N>>(kinetic: &Kinetic, full: &M::Full<f64>) -> Rational {
    kinetic.motion(&state::<N, M>(full)).unwrap().energy().clone()
}
