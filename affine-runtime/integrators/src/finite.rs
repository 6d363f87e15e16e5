//! Whether numbers are finite, and which is the largest.

use affine_core::model::StateVector;

/// All components are finite: without branches, four at once.
#[inline(always)]
pub(crate) fn is_finite<S: StateVector<f64>>(y: &S) -> bool {
    let (fours, rest) = y.as_ref().as_chunks::<4>();
    // Zero, and NaN once a number is not finite.
    let mut sums = [0.0; 4];
    for four in fours {
        for (sum, v) in sums.iter_mut().zip(four) {
            *sum += 0.0 * v;
        }
    }
    rest.iter().fold((sums[0] + sums[2]) + (sums[1] + sums[3]), |sum, v| sum + 0.0 * v) == 0.0
}

#[cfg(test)]
mod tests {
    use super::is_finite;

    #[test]
    fn each_component_counts() {
        let plain = [1.0, -2.0, 0.0, f64::MAX, f64::MIN_POSITIVE, -0.0, 1e-310];
        assert!(is_finite(&plain));
        for component in 0..plain.len() {
            for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
                let mut y = plain;
                y[component] = bad;
                assert!(!is_finite(&y), "{bad} in component {component}");
            }
        }
    }
}
