//! The least cost, evaluations or seconds, at which a method reaches an error.

/// Errors at which methods are compared.
pub(crate) const ERRORS: [f64; 5] = [1e-3, 1e-6, 1e-9, 1e-12, 1e-14];

/// The runs, error and cost, that no other run beats in both, from the cheapest on.
pub(crate) fn front(runs: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let mut sorted: Vec<(f64, f64)> =
        runs.iter().filter(|(e, _)| e.is_finite()).map(|(e, cost)| (e.max(1e-17), *cost)).collect();
    sorted.sort_by(|a, b| a.1.total_cmp(&b.1));
    let mut front: Vec<(f64, f64)> = Vec::new();
    for run in sorted {
        if front.last().is_none_or(|last| run.0 < last.0) {
            front.push(run);
        }
    }
    front
}

/// The least cost of an error, by logarithmic interpolation between neighbours on the [`front`]; the cheapest run where
/// all are more accurate. `None` where no run is as accurate.
pub(crate) fn least_cost(runs: &[(f64, f64)], error: f64) -> Option<f64> {
    let front = front(runs);
    let after = front.iter().position(|(e, _)| *e <= error)?;
    let (e1, c1) = front[after];
    let Some((e0, c0)) = after.checked_sub(1).map(|before| front[before]) else { return Some(c1) };
    let part = (e0 / error).ln() / (e0 / e1).ln();
    Some((c0.ln() + part * (c1 / c0).ln()).exp())
}
