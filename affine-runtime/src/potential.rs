//! Potentials of a type of your own, see [`Potential`], and whether they are what they say.

use core::fmt;

pub use affine_core::potential::*;

use crate::frames::Vector;
use crate::sampling::rotation;

/// A potential that is not what it says.
#[derive(Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Unsound<const N: usize> {
    /// It changes under a rotation of its class, or of `x` although it has no position.
    Class {
        /// The place at which the energy changes.
        place: Place<N>,
        /// The class.
        class: Class,
        /// `U` there, and at a rotated or shifted place.
        energies: [f64; 2],
    },
    /// A derivative is not that of the energy.
    Slope {
        /// The place at which the derivative is wrong.
        place: Place<N>,
        /// By which coordinate: `x[1]`, `phi[1,2]` as its indices from 1, the second 0 for `x`.
        coordinate: (usize, usize),
        /// What [`Potential::slopes`] gives, and the difference quotient of the energy.
        slopes: [f64; 2],
    },
}

impl<const N: usize> fmt::Display for Unsound<N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Class { place, class, energies: [here, there] } => write!(
                f,
                "the potential is said to be {class:?}, but changes from {here:e} to {there:e} under a rotation of \
                 its class, or with x, at {place:?}"
            ),
            Self::Slope { place, coordinate: (i, a), slopes: [given, found] } => {
                let coordinate = if *a == 0 { format_args!("x[{i}]") } else { format_args!("phi[{i},{a}]") };
                write!(
                    f,
                    "the derivative of the potential by {coordinate} is given as {given:e}, but its difference \
                     quotient is {found:e} at {place:?}"
                )
            }
        }
    }
}

impl<const N: usize> fmt::Debug for Unsound<N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl<const N: usize> core::error::Error for Unsound<N> {}

/// Length of the differences, relative to `|phi|`: of order 4, their error is about `1e-3^4` beside `eps/1e-3`.
const STEP: f64 = 1e-3;
/// What the difference quotients of order 4 leave, relative to the largest slope.
const SLOPE: f64 = 1e-8;
/// Rounding of two evaluations, relative to their size.
const ENERGY: f64 = 1e-11;

/// Holds class and derivatives of a potential against samples; see [`places`](crate::sampling::places) for some. The class
/// is held against the rotations of the identity as metric.
///
/// # Errors
/// [`Unsound`] at the first place where the energy changes under a rotation of the class, or where a derivative is not
/// its difference quotient to eight digits of the largest.
pub fn check<const N: usize, P: Potential<N>>(
    potential: &P,
    places: impl IntoIterator<Item = Place<N>>,
) -> Result<(), Unsound<N>> {
    for (k, place) in places.into_iter().enumerate() {
        invariant(potential, &place, k)?;
        derived(potential, &place)?;
    }
    Ok(())
}

fn invariant<const N: usize, P: Potential<N>>(
    potential: &P,
    place: &Place<N>,
    k: usize,
) -> Result<(), Unsound<N>> {
    let (left, right) = (rotation::<N>(2 * k), rotation::<N>(2 * k + 1));
    let phi = match P::CLASS {
        Class::Isotropic => left * place.phi * right,
        Class::Green => left * place.phi,
        Class::Finger => place.phi * right,
        Class::General => place.phi,
    };
    let x = if P::POSITION { place.x } else { place.x + Vector::<N>::from_element(1.0) };
    let energies = [potential.energy(place), potential.energy(&Place { x, phi, ..*place })];
    let [here, there] = energies;
    let size = here.abs().max(there.abs()).max(1.0);
    // NaN is no agreement.
    let agree = (here - there).abs() <= ENERGY * size;
    if !agree {
        return Err(Unsound::Class { place: *place, class: P::CLASS, energies });
    }
    Ok(())
}

fn derived<const N: usize, P: Potential<N>>(potential: &P, place: &Place<N>) -> Result<(), Unsound<N>> {
    let slopes = potential.slopes(place);
    let h = STEP * place.phi.norm();
    let quotient = |moved: &dyn Fn(f64) -> Place<N>| {
        let at = |k: f64| potential.energy(&moved(k * h));
        (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * h)
    };
    let size = slopes.x.norm().max(slopes.phi.norm()).max(potential.energy(place).abs() / place.phi.norm());
    let held = |coordinate: (usize, usize), given: f64, found: f64| {
        if (given - found).abs() <= SLOPE * size.max(f64::MIN_POSITIVE) {
            return Ok(());
        }
        Err(Unsound::Slope { place: *place, coordinate, slopes: [given, found] })
    };
    for (i, a) in (0..N).flat_map(|i| (0..N).map(move |a| (i, a))) {
        let moved = |step: f64| {
            let mut moved = *place;
            moved.phi[(i, a)] += step;
            moved
        };
        held((i + 1, a + 1), slopes.phi[(i, a)], quotient(&moved))?;
    }
    for i in (0..N).filter(|_| P::POSITION) {
        let moved = |step: f64| {
            let mut moved = *place;
            moved.x[i] += step;
            moved
        };
        held((i + 1, 0), slopes.x[i], quotient(&moved))?;
    }
    Ok(())
}
