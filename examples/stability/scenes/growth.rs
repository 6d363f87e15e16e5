//! Exponents of the growth of rounding errors: medians over starts. The largest value of a random walk up to a time
//! scatters by its own size, and so does a single exponent.

/// Starts of an ensemble; its runs together take the time of one long one.
pub(super) const STARTS: u32 = 8;

/// Exponents of several runs.
#[derive(Clone, Copy, Debug)]
pub(super) struct Exponents {
    pub(super) median: f64,
    pub(super) least: f64,
    pub(super) most: f64,
}

impl Exponents {
    /// Of the errors of runs, each at equal distances in time; a run that errs nowhere has none.
    pub(super) fn of(runs: &[Vec<f64>]) -> Self {
        let mut exponents: Vec<f64> = runs.iter().map(|errors| exponent(errors)).collect();
        exponents.sort_by(f64::total_cmp);
        let middle = exponents.len() / 2;
        let median = 0.5 * (exponents[(exponents.len() - 1) / 2] + exponents[middle]);
        Self { median, least: exponents[0], most: exponents[exponents.len() - 1] }
    }

    /// In words.
    pub(super) fn scatter(self) -> String {
        format!("{STARTS} starts, {:.2} to {:.2}", self.least, self.most)
    }
}

/// Exponent of the growth of the largest value between a sixteenth of the run and all of it; 0 where there are none.
pub(super) fn exponent(values: &[f64]) -> f64 {
    let (whole, part) = (up_to(values, 1), up_to(values, 16));
    if whole == 0.0 { 0.0 } else { (whole / part).log2() / 4.0 }
}

/// The largest of the values up to a part of the run; a NaN is kept.
pub(super) fn up_to(values: &[f64], part: usize) -> f64 {
    let larger = |most: f64, &value: &f64| if value <= most || most.is_nan() { most } else { value };
    values.iter().take(values.len() / part).fold(0.0, larger)
}

/// The mean of signed values in units of its standard error: beyond a few, a drift and no walk.
pub(super) fn mean_to_error(values: &[f64]) -> f64 {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let square = values.iter().map(|value| (value - mean) * (value - mean)).sum::<f64>() / (n - 1.0);
    if mean == 0.0 { 0.0 } else { mean.abs() / (square / n).sqrt() }
}
