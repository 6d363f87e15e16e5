//! Stiff and extreme cases, one file for each kind, shared by the example and the test.

mod bad_input;
mod coincident;
mod collapse;
mod degenerate;
mod energies;
mod flat;
mod growth;
mod long_runs;
mod many_steps;
mod more_stretches;
mod penalty;
mod reference;
mod shared;
mod stiff;
mod stiff_in_the_plane;
mod stretches;
mod units;

use affine_runtime::report::StabilityReport;

/// How much is tried.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Extent {
    /// What an unoptimised build does within a minute.
    Fast,
    /// Every power of ten.
    Full,
    /// And long runs.
    Long,
}

impl Extent {
    /// All the values, or in the fast subset those up to a limit.
    fn up_to(self, most: f64, values: &[f64]) -> Vec<f64> {
        values.iter().copied().filter(|value| self != Self::Fast || *value <= most).collect()
    }
}

/// All cases.
pub(crate) fn report(extent: Extent) -> affine_runtime::Result<StabilityReport> {
    let mut report = StabilityReport::new();
    stiff::cases(&mut report, extent)?;
    penalty::cases(&mut report, extent)?;
    degenerate::cases(&mut report)?;
    stretches::cases(&mut report)?;
    energies::cases(&mut report)?;
    collapse::cases(&mut report)?;
    coincident::cases(&mut report)?;
    units::cases(&mut report, extent)?;
    long_runs::cases(&mut report, extent)?;
    many_steps::cases(&mut report, extent)?;
    bad_input::cases(&mut report)?;
    Ok(report)
}
