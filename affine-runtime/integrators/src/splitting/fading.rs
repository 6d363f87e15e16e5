//! Momenta that friction takes away, while positions stay.

use affine_core::scalar::Real;

/// Terms of the series up to here are below the rounding of the first for matrices of norm 1.
const TERMS: usize = 18;

/// The increment `(exp(-h A) - 1) z` of `z' = -A z` over the time `h`, to some roundings of `z`; where `h |A|` is more than 1 by
/// doubling of `exp(-h A/2^s) - 1`, in which nothing cancels.
#[inline]
#[must_use]
pub fn fading<const K: usize, T: Real>(h: T, a: [[T; K]; K], z: [T; K]) -> [T; K] {
    let b = a.map(|row| row.map(|entry| T::zero() - h * entry));
    let mut largest = T::zero();
    for row in &b {
        let sum = row.iter().fold(T::zero(), |sum, entry| sum + entry.abs());
        // A NaN stays in the result.
        largest = if sum > largest { sum } else { largest };
    }
    if largest <= T::one() {
        return series(&b, z);
    }
    let (mut scale, mut halvings) = (T::one(), 0);
    while largest * scale > T::one() && halvings < 1100 {
        scale *= T::from_f64(0.5);
        halvings += 1;
    }
    let b = b.map(|row| row.map(|entry| entry * scale));
    // Column after column, as rows.
    let mut g: [[T; K]; K] = core::array::from_fn(|j| {
        series(&b, core::array::from_fn(|i| if i == j { T::one() } else { T::zero() }))
    });
    for _ in 0..halvings {
        g = core::array::from_fn(|j| {
            let twice = applied_columns(&g, &g[j]);
            core::array::from_fn(|i| (g[j][i] + g[j][i]) + twice[i])
        });
    }
    applied_columns(&g, &z)
}

/// `(b + b^2/2 + b^3/6 + ...) z`.
#[inline]
fn series<const K: usize, T: Real>(b: &[[T; K]; K], z: [T; K]) -> [T; K] {
    let mut sum = [T::zero(); K];
    for k in (1..=TERMS).rev() {
        let part = T::from_f64(1.0 / k as f64);
        let before: [T; K] = core::array::from_fn(|i| z[i] + sum[i]);
        sum = core::array::from_fn(|i| part * (0..K).fold(T::zero(), |sum, j| b[i][j].fma(before[j], sum)));
    }
    sum
}

/// The product of a matrix, given by its columns, and a vector.
#[inline]
fn applied_columns<const K: usize, T: Real>(columns: &[[T; K]; K], z: &[T; K]) -> [T; K] {
    core::array::from_fn(|i| (0..K).fold(T::zero(), |sum, j| columns[j][i].fma(z[j], sum)))
}

#[cfg(test)]
mod tests {
    use super::fading;

    /// `[[r, w], [-w, r]]`: `exp(-h A)` shrinks by `exp(-h r)` and turns by `h w`.
    #[test]
    fn spirals() {
        for (r, w, h) in
            [(0.3, 0.7, 0.01), (0.3, 0.7, 1.0), (2.0, 40.0, 0.5), (5.0, 0.0, -0.3), (1e6, 0.0, 1.0)]
        {
            let [x, y] = fading(h, [[r, w], [-w, r]], [0.6, -0.8]);
            let (fall, (sine, cosine)) = (f64::exp(-h * r), f64::sin_cos(h * w));
            let exact = [fall * (0.6 * cosine + 0.8 * sine) - 0.6, fall * (0.6 * sine - 0.8 * cosine) + 0.8];
            let bound = 40.0 * f64::EPSILON * (1.0 + h.abs() * (r + w)).min(100.0) * fall.max(1.0);
            assert!(
                (x - exact[0]).abs() < bound && (y - exact[1]).abs() < bound,
                "{r} {w} {h}: {x} {y} {exact:?}"
            );
        }
    }

    /// A shear, `exp(-h A) = 1 - h A`.
    #[test]
    fn shears() {
        let [x, y, z]: [f64; 3] = fading(3.0, [[0.0, 7.0, 0.0], [0.0; 3], [0.0; 3]], [1.0, 2.0, 5.0]);
        assert!((x + 42.0).abs() < 1e-12 && y == 0.0 && z == 0.0, "{x} {y} {z}");
        assert!(fading(1.0, [[f64::NAN]], [1.0])[0].is_nan());
    }
}
