//! Whether forces and potentials of your own are what they say: [`check_force`] and [`check_potential`], and samples to look at,
//! the same in every run.

use core::fmt;

use crate::force::{Force, Form, Motion};
use crate::frames::{Matrix, Vector};
use crate::potential::{Class, Place, Potential};
use crate::scalar::Scalar;

/// A force or a potential that is not what it says.
#[derive(Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Unsound<const N: usize> {
    /// A potential changes under a rotation of its class, or of `x` although it has no position.
    Class {
        /// The place at which the energy changes.
        place: Place<N>,
        /// The class.
        class: Class,
        /// `U` there, and at a rotated or shifted place.
        energies: [f64; 2],
    },
    /// A derivative of a potential is not that of its energy.
    Slope {
        /// The place at which the derivative is wrong.
        place: Place<N>,
        /// By which coordinate: `x[1]`, `phi[1,2]` as its indices from 1, the second 0 for `x`.
        coordinate: (usize, usize),
        /// What [`Potential::slopes`] gives, and the difference quotient of the energy.
        slopes: [f64; 2],
    },
    /// A force that is said to be gyroscopic has power.
    Power {
        /// The time, placement and velocities at which it has power.
        motion: Motion<N>,
        /// The power there.
        power: f64,
        /// `|Q| |Omega|`, which the power is held against.
        scale: f64,
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
            Self::Power { motion, power, scale } => write!(
                f,
                "the force is said to be gyroscopic, but has the power {power:e} (of {scale:e}) at {motion:?}"
            ),
        }
    }
}

impl<const N: usize> fmt::Debug for Unsound<N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl<const N: usize> core::error::Error for Unsound<N> {}

/// Holds a force that says it is gyroscopic against its power at the given motions; see [`motions`] for some.
///
/// # Errors
/// [`Unsound::Power`] at the first motion along which the power is more than rounding, 1e-12 of `|Q| |Omega|`.
pub fn check_force<const N: usize, F: Force<N>>(
    force: &F,
    motions: impl IntoIterator<Item = Motion<N>>,
) -> Result<(), Unsound<N>> {
    if !F::GYROSCOPIC {
        return Ok(());
    }
    for motion in motions {
        let (power, scale) = F::Form::power(&force.force(&motion), &motion);
        // NaN is no zero.
        let vanishes = power.abs() <= 1e-12 * scale;
        if !vanishes {
            return Err(Unsound::Power { motion, power, scale });
        }
    }
    Ok(())
}

/// Length of the differences, relative to `|phi|`: of order 4, their error is about `1e-3^4` beside `eps/1e-3`.
const STEP: f64 = 1e-3;
/// What the difference quotients of order 4 leave, relative to the largest slope.
const SLOPE: f64 = 1e-8;
/// Rounding of two evaluations, relative to their size.
const ENERGY: f64 = 1e-11;

/// Holds class and derivatives of a potential against samples; see [`places`] for some. The class
/// is held against the rotations of the identity as metric.
///
/// # Errors
/// [`Unsound`] at the first place where the energy changes under a rotation of the class, or where a derivative is not
/// its difference quotient to eight digits of the largest.
pub fn check_potential<const N: usize, P: Potential<N>>(
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
    let energies = [potential.energy(place), potential.energy(&Place { x, phi })];
    let ([here, there], slopes) = (energies, potential.slopes(place));
    // Of an energy that is a small difference of large ones, the slopes tell how large.
    let size = here.abs().max(there.abs()).max(slopes.phi.norm() * place.phi.norm());
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

/// `count` placements with `det phi > 0`, stretched and turned by amounts of order 1, and positions.
pub fn places<const N: usize>(count: usize) -> impl Iterator<Item = Place<N>> {
    (0..count).map(|k| {
        let mut number = numbers(k);
        let mut stretched = Matrix::<N>::zeros();
        for a in 0..N {
            stretched[(a, a)] = Scalar::exp(0.6 * number());
        }
        let x = Vector::<N>::from_fn(|_, _| 2.0 * number());
        Place { x, phi: rotation::<N>(2 * k) * stretched * rotation::<N>(2 * k + 1) }
    })
}

/// The same placements with times and velocities of order 1.
pub fn motions<const N: usize>(count: usize) -> impl Iterator<Item = Motion<N>> {
    places::<N>(count).enumerate().map(move |(k, Place { x, phi })| {
        let mut number = numbers(count + k);
        let x_dot = Vector::<N>::from_fn(|_, _| number());
        let phi_dot = Matrix::<N>::from_fn(|_, _| number());
        Motion { t: number(), x, phi, x_dot, phi_dot }
    })
}

/// A rotation by angles of order 1.
fn rotation<const N: usize>(k: usize) -> Matrix<N> {
    let mut number = numbers(1000 + k);
    let mut rotation = Matrix::<N>::identity();
    for (a, b) in (0..N).flat_map(|a| (a + 1..N).map(move |b| (a, b))) {
        let angle = 3.0 * number();
        let (c, s) = (Scalar::cos(angle), Scalar::sin(angle));
        let mut turn = Matrix::<N>::identity();
        (turn[(a, a)], turn[(b, b)], turn[(a, b)], turn[(b, a)]) = (c, c, -s, s);
        rotation *= turn;
    }
    rotation
}

/// Numbers between -1 and 1 (SplitMix64, Steele et al., OOPSLA 2014).
fn numbers(seed: usize) -> impl FnMut() -> f64 {
    let mut state = (seed as u64).wrapping_mul(0xd134_2543_de82_ef95);
    move || {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^= z >> 31;
        (z >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}
