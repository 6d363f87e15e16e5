//! When a body collapses.

/// The time, to the rounding of times, from which a condition fails that holds at `good` and not at `bad`: bisection.
/// Where it fails more than once in between, one of these times.
pub(super) fn first_failure(mut good: f64, mut bad: f64, mut holds: impl FnMut(f64) -> bool) -> f64 {
    loop {
        let middle = good + 0.5 * (bad - good);
        if middle == good || middle == bad {
            return bad;
        }
        if holds(middle) { good = middle } else { bad = middle }
    }
}

#[cfg(test)]
mod tests {
    use super::first_failure;

    #[test]
    fn the_next_double_past_the_edge() {
        for (good, bad, edge) in [(0.0, 3.0, 2.0_f64.sqrt()), (-1.0, -5.0, -3.3), (0.0, 1.0, 1e-200)] {
            let inside = |t: f64| (t - edge) * (bad - good) <= 0.0;
            let found = first_failure(good, bad, inside);
            assert!(!inside(found) && (found - edge).abs() <= 2.0 * f64::EPSILON * edge.abs(), "{found}");
        }
    }
}
