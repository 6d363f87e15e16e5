//! How many steps keep the tolerance that they were chosen for.

use crate::inner::norm;
use crate::integrate::ErrorNorm;
use crate::model::Model;
use crate::simulate::{Method, Simulation, Trajectory};

/// Tolerance of the motion that each step is held against.
const EXACT: f64 = 1e-15;
/// Below this tolerance the rounding of the comparison itself would be counted.
const LEAST: f64 = 1e-13;

/// The share of the steps of a trajectory whose true local error exceeds the tolerance; `None` where the tolerance is
/// below 1e-13, or the exact continuation of a step stops.
///
/// The local error of a step is its distance from the motion through the point where it began, in the norm in which
/// tolerances are meant, over the whole phase point.
pub(super) fn share_above<const N: usize, M: Model<N>>(
    model: &M,
    steps: &Trajectory<N, M::Point<f64>>,
    tolerance: f64,
) -> Option<f64> {
    if tolerance < LEAST {
        return None;
    }
    // For the inertias of momenta.
    let slope = |t: f64, y: &M::Full<f64>| model.hamilton_equations(t, y);
    let (t0, start) = steps.start();
    let full = model.flatten(start);
    let (error_norm, _) = ErrorNorm::probed(M::DESCRIPTION.full, &slope, (t0, &full, &slope(t0, &full)));
    let mut above = 0_usize;
    let mut count = 0_usize;
    for ((t, begin), (t_next, end)) in steps.iter().zip(steps.iter().skip(1)) {
        let exact = continuation(model, *begin, (t, t_next))?;
        let [before, after, exact] = [begin, end, &exact].map(|point| model.flatten(point));
        let error = error_norm.largest((t_next - t).abs(), before.as_ref(), exact.as_ref(), |range| {
            let (after, exact) = (&after.as_ref()[range.clone()], &exact.as_ref()[range]);
            norm(&after.iter().zip(exact).map(|(a, b)| a - b).collect::<Vec<_>>())
        });
        count += 1;
        above += usize::from(error > tolerance || error.is_nan());
    }
    (count > 0).then(|| above as f64 / count as f64)
}

/// The phase point at `t_next`, where the motion goes on until then.
fn continuation<const N: usize, M: Model<N>>(
    model: &M,
    begin: M::Point<f64>,
    (t, t_next): (f64, f64),
) -> Option<M::Point<f64>> {
    let motion = Simulation::new(model, begin)
        .from(t)
        .until(t_next)
        .method(Method::RungeKutta8)
        .tolerance(EXACT)
        .output([t_next]);
    motion.run().ok().map(|run| *run.end().1)
}
