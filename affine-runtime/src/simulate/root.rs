//! A root of a continuous function between two times of opposite sign.

/// Iterations that bisection alone needs between any two doubles, and as many again.
const MOST_ITERATIONS: u32 = 2 * 1100;

/// The least part of the bracket that is cut off first.
const NEAREST: f64 = 1e-3;

/// The time in `(a, b]`, at a distance of rounding from a root, at which the sign is that of `fb` or zero: looked for first after
/// a part of the way from `a`.
///
/// Inverse quadratic interpolation where it is safe, bisection elsewhere (T. R. Chandrupatla, Advances in Engineering
/// Software 28 (1997) 145-149), until the bracket is as short as two floating-point numbers allow.
///
/// # Errors
/// Those of `f`.
pub(super) fn root<E>(
    mut f: impl FnMut(f64) -> Result<f64, E>,
    (a, fa): (f64, f64),
    (b, fb): (f64, f64),
    first: f64,
) -> Result<f64, E> {
    // It has neither sign, and would not close a bracket.
    if fb == 0.0 {
        return Ok(b);
    }
    let begins_negative = fa < 0.0;
    // The last time tried, and the other end of the bracket.
    let (mut near, mut far) = ((b, fb), (a, fa));
    let mut before;
    let mut part = (1.0 - first).clamp(NEAREST, 1.0 - NEAREST);
    for _ in 0..MOST_ITERATIONS {
        let t = near.0 + part * (far.0 - near.0);
        if t == near.0 || t == far.0 {
            break;
        }
        let value = f(t)?;
        if value == 0.0 {
            return Ok(t);
        }
        if (value < 0.0) == (near.1 < 0.0) {
            before = near;
        } else {
            (before, far) = (far, near);
        }
        near = (t, value);
        part = next_part(near, far, before);
    }
    let changed = |(_, value): (f64, f64)| value == 0.0 || (value < 0.0) != begins_negative;
    Ok(if changed(near) { near.0 } else { far.0 })
}

/// Where to look next, as a part of the way from `near` to `far`.
fn next_part(near: (f64, f64), far: (f64, f64), before: (f64, f64)) -> f64 {
    let xi = (near.0 - far.0) / (before.0 - far.0);
    let phi = (near.1 - far.1) / (before.1 - far.1);
    let interpolated = if phi * phi < xi && (1.0 - phi) * (1.0 - phi) < 1.0 - xi {
        near.1 / (far.1 - near.1) * before.1 / (far.1 - before.1)
            + (before.0 - near.0) / (far.0 - near.0) * near.1 / (before.1 - near.1) * far.1
                / (before.1 - far.1)
    } else {
        0.5
    };
    // At least two roundings away from either end, so that both close in.
    let size = if near.0.abs() > far.0.abs() { near.0.abs() } else { far.0.abs() };
    let least = (2.0 * f64::EPSILON * size / (far.0 - near.0).abs()).min(0.5);
    if interpolated.is_nan() { 0.5 } else { interpolated.clamp(least, 1.0 - least) }
}

#[cfg(test)]
mod tests {
    use core::convert::Infallible;

    use super::root;

    fn located(f: impl Fn(f64) -> f64, a: f64, b: f64) -> (f64, u32) {
        let mut calls = 0;
        let counted = |t: f64| {
            calls += 1;
            Ok::<f64, Infallible>(f(t))
        };
        let found = root(counted, (a, f(a)), (b, f(b)), 0.5);
        (found.unwrap_or_else(|never| match never {}), calls)
    }

    #[test]
    fn roots_are_found_to_rounding_from_either_side() {
        let pi = core::f64::consts::PI;
        for (a, b) in [(3.0, 3.5), (3.5, 3.0), (0.1, 6.0), (6.0, 0.1)] {
            let (t, calls) = located(libm::sin, a, b);
            assert!((t - pi).abs() <= 4.0 * f64::EPSILON * pi, "{t} from {a}, {b}");
            assert!(calls < 60, "{calls}");
            let changed = libm::sin(t) == 0.0 || (libm::sin(t) < 0.0) == (libm::sin(b) < 0.0);
            assert!(changed, "the sign has changed at {t}");
        }
    }

    /// Where bisection takes some 53 values; near a start that is almost a root, at a root of third order and at a jump it takes more.
    #[test]
    fn smooth_functions_take_few_values() {
        let calls = [
            located(libm::sin, 3.0, 3.5).1,
            located(libm::sin, 0.1, 6.0).1,
            located(|t| libm::exp(t) - 3.0, -2.0, 3.0).1,
            located(|t| 1.0 - 5.0 * t * t, 0.0, 0.7).1,
            located(|t| t * t * t - 2.0 * t - 5.0, 3.0, 2.0).1,
            located(|t| 1e-3 * t - 5.0 * t * t, 1e-9, 1.0).1,
            located(|t| (t - 1.0) * (t - 1.0) * (t - 1.0), 0.0, 3.0).1,
            located(|t| if t < 0.3 { -1.0 } else { 1.0 }, -1.0, 2.0).1,
        ];
        assert_eq!(calls, [8, 11, 7, 7, 8, 19, 53, 56]);
    }

    #[test]
    fn flat_steep_and_broken_functions() {
        let (t, _) = located(|t| (t - 1.0) * (t - 1.0) * (t - 1.0), 0.0, 3.0);
        assert!((t - 1.0).abs() < 1e-15);
        let (t, _) = located(|t| if t < 0.3 { -1e-300 } else { 1e300 }, -1.0, 2.0);
        assert!((t - 0.3).abs() < 1e-15 && t >= 0.3, "the far side of a jump");
        let (t, _) = located(|t| t - 1e-200, 0.0, 1.0);
        assert!((t - 1e-200).abs() < 1e-15, "{t}");
        for (a, b) in [(1.0, 2.0), (3.0, 2.0)] {
            assert_eq!(located(|t| t - 2.0, a, b).0, 2.0, "a root at the end");
            assert_eq!(located(|t| 2.0 - t, a, b).0, 2.0, "a root at the end");
        }
    }
}
