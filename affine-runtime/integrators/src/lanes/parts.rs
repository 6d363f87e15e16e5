//! Lanes as vectors of a processor.

use pulp::{Arch, Simd, WithSimd};

use super::Lanes;
use affine_core::__private::numerics::IS_FUSED;

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

/// `left right + term`, rounded as in lanes of this kind.
#[inline(always)]
pub(crate) fn plus<V: Simd, T: Lanes>(simd: V, left: V::f64s, right: V::f64s, term: V::f64s) -> V::f64s {
    if const { IS_FUSED || T::IS_FUSED } {
        simd.mul_add_f64s(left, right, term)
    } else {
        simd.add_f64s(simd.mul_f64s(left, right), term)
    }
}

/// The work done for lanes of this kind: fused ones are asked for where there are vectors of AVX2, and a model that has fused
/// ones is not given others there.
#[inline(always)]
pub(crate) fn in_lanes<T: Lanes, W: WithSimd>(work: W, is_a_last_resort: bool) -> W::Output {
    #[cfg(target_arch = "x86_64")]
    if const { T::IS_FUSED } {
        return match (pulp::x86::V4::try_new(), pulp::x86::V3::try_new()) {
            (Some(vectors), _) => Simd::vectorize(vectors, work),
            (None, Some(vectors)) => Simd::vectorize(vectors, work),
            (None, None) => Simd::vectorize(pulp::Scalar, work),
        };
    }
    if is_a_last_resort { Simd::vectorize(pulp::Scalar, work) } else { Arch::new().dispatch(work) }
}
