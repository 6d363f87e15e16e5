//! Whether numbers are finite, and which is the largest.

use crate::model::StateVector;

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

/// The larger of two numbers; NaN where one is, which `f64::max` would drop.
#[inline(always)]
pub(crate) fn larger(a: f64, b: f64) -> f64 {
    if a >= b || a.is_nan() { a } else { b }
}

#[cfg(test)]
mod tests {
    use super::is_finite;
    use super::larger;

    #[cfg(feature = "std")]
    #[test]
    fn nothing_is_larger_than_what_is_no_number() {
        assert_eq!((larger(1.0, 2.0), larger(2.0, 1.0), larger(-1.0, 0.0)), (2.0, 2.0, 0.0));
        let lists = [[f64::NAN, 1.0, 2.0], [1.0, f64::NAN, 2.0], [1.0, 2.0, f64::NAN]];
        assert!(lists.iter().all(|list| list.iter().copied().fold(0.0, larger).is_nan()));
    }

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
