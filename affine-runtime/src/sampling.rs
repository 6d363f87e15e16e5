//! Samples of placements and motions, the same in every run: what [`force::check`](crate::force::check) and
//! [`potential::check`](crate::potential::check) look at.

use affine_core::force::Motion;
use affine_core::potential::Place;

use crate::frames::{Matrix, Vector};
use crate::scalar::Scalar;

/// `count` placements with `det phi > 0`, stretched and turned by amounts of order 1, and positions and times.
pub fn places<const N: usize>(count: usize) -> impl Iterator<Item = Place<N>> {
    (0..count).map(|k| {
        let mut number = numbers(k);
        let mut stretched = Matrix::<N>::zeros();
        for a in 0..N {
            stretched[(a, a)] = Scalar::exp(0.6 * number());
        }
        let x = Vector::<N>::from_fn(|_, _| 2.0 * number());
        Place { t: number(), x, phi: rotation::<N>(2 * k) * stretched * rotation::<N>(2 * k + 1) }
    })
}

/// The same placements with velocities of order 1.
pub fn motions<const N: usize>(count: usize) -> impl Iterator<Item = Motion<N>> {
    places::<N>(count).enumerate().map(move |(k, Place { t, x, phi })| {
        let mut number = numbers(count + k);
        let x_dot = Vector::<N>::from_fn(|_, _| number());
        let phi_dot = Matrix::<N>::from_fn(|_, _| number());
        Motion { t, x, phi, x_dot, phi_dot }
    })
}

/// A rotation by angles of order 1.
pub(crate) fn rotation<const N: usize>(k: usize) -> Matrix<N> {
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
