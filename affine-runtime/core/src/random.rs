//! Numbers and rotations that are drawn, the same in every run.

use crate::matrix::Matrix;
use crate::scalar::Scalar;

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
pub(crate) fn numbers(seed: usize) -> impl FnMut() -> f64 {
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
