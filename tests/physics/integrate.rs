//! A fixed-step integrator of very high order, for reference trajectories at the accuracy of `f64`.

use affine_runtime::model::StateVector;

/// Rows of the extrapolation table: order 12.
const ROWS: usize = 6;

/// `y(t_0 + duration)` of `y' = f(y)` from `start`, in equal steps.
///
/// Each step extrapolates Gragg's modified midpoint rule with 2, 4, .., 12 substeps (Hairer, Norsett, Wanner, Solving
/// Ordinary Differential Equations I, section II.9). The increment is extrapolated, not the state, so that rounding
/// errors shrink with the step.
pub(crate) fn extrapolated<Y: StateVector<f64>>(
    f: &dyn Fn(&Y) -> Y,
    start: Y,
    duration: f64,
    steps: u32,
) -> Y {
    let h = duration / f64::from(steps);
    (0..steps).fold(start, |y, _| sum(&y, &increment(f, &y, h), 1.0))
}

/// `y + weight direction`.
fn sum<Y: StateVector<f64>>(y: &Y, direction: &Y, weight: f64) -> Y {
    let mut sum = *y;
    for (value, slope) in sum.as_mut().iter_mut().zip(direction.as_ref()) {
        *value += weight * slope;
    }
    sum
}

/// Aitken and Neville in the squares of the substeps.
fn increment<Y: StateVector<f64>>(f: &dyn Fn(&Y) -> Y, y: &Y, h: f64) -> Y {
    // After the row `row`, `table[k]` is extrapolated over the rows `k + 1 ..= row`.
    let mut table: Vec<Y> = Vec::with_capacity(ROWS);
    for row in 1..=ROWS {
        table.push(midpoint(f, y, h, 2 * row));
        for k in (0..row - 1).rev() {
            let (fine, coarse) = ((row * row) as f64, ((k + 1) * (k + 1)) as f64);
            let difference = sum(&table[k + 1], &table[k], -1.0);
            table[k] = sum(&table[k + 1], &difference, coarse / (fine - coarse));
        }
    }
    table[0]
}

/// Gragg's rule without smoothing step: its error has even powers of the substep alone, for even numbers.
fn midpoint<Y: StateVector<f64>>(f: &dyn Fn(&Y) -> Y, y: &Y, h: f64, substeps: usize) -> Y {
    let step = h / substeps as f64;
    let mut before = Y::zeros();
    let mut now = sum(&before, &f(y), step);
    for _ in 1..substeps {
        let next = sum(&before, &f(&sum(y, &now, 1.0)), 2.0 * step);
        (before, now) = (now, next);
    }
    now
}

#[test]
fn order_is_twelve() {
    // y' = y^2, y(0) = 1: y(3/4) = 4. The pole at t = 1 keeps the errors above rounding, and the order, which tends
    // to 12, at 11.03 between these steps.
    let error = |steps| extrapolated(&|y: &[f64; 1]| [y[0] * y[0]], [1.0], 0.75, steps)[0] - 4.0;
    let order = (error(8) / error(16)).log2();
    assert!((order - 11.03).abs() < 0.05, "order {order}");
}
