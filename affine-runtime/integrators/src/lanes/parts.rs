//! Lanes as vectors of a processor.

use pulp::Simd;

use super::Lanes;

/// Number of vectors that lanes fill.
#[inline(always)]
pub(crate) const fn parts<V: Simd, T: Lanes>() -> usize {
    T::LANES / V::F64_LANES
}

/// A vector of lanes; zero beyond the last, which is not asked for.
#[inline(always)]
pub(crate) fn part<V: Simd, T: Lanes>(simd: V, lanes: &T, part: usize) -> V::f64s {
    let (vectors, _) = V::as_simd_f64s(lanes.as_slice());
    vectors.get(part).copied().unwrap_or(simd.splat_f64s(0.0))
}

/// Writes a vector to lanes.
#[inline(always)]
pub(crate) fn set_part<V: Simd, T: Lanes>(_simd: V, lanes: &mut T, part: usize, value: V::f64s) {
    let (vectors, _) = V::as_mut_simd_f64s(lanes.as_mut_slice());
    if let Some(vector) = vectors.get_mut(part) {
        *vector = value;
    }
}

/// `left right + term`, rounded as lanes are.
#[inline(always)]
pub(crate) fn plus<V: Simd>(simd: V, left: V::f64s, right: V::f64s, term: V::f64s) -> V::f64s {
    if cfg!(target_feature = "fma") {
        simd.mul_add_f64s(left, right, term)
    } else {
        simd.add_f64s(simd.mul_f64s(left, right), term)
    }
}
