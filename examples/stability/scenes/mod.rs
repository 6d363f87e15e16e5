//! Stiff and extreme cases, one file for each kind.

mod bad_input;
mod coincident;
mod collapse;
mod contact;
mod degenerate;
mod energies;
mod flat;
mod friction;
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

pub(crate) use friction::Viscous;

/// How much is tried.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Extent {
    /// Every power of ten.
    Full,
    /// And long runs.
    Long,
}

/// All cases.
pub(crate) fn report(extent: Extent) -> affine_runtime::Result<StabilityReport> {
    let mut report = StabilityReport::new();
    stiff::cases(&mut report)?;
    penalty::cases(&mut report)?;
    friction::cases(&mut report)?;
    contact::cases(&mut report)?;
    degenerate::cases(&mut report)?;
    stretches::cases(&mut report)?;
    energies::cases(&mut report)?;
    collapse::cases(&mut report)?;
    coincident::cases(&mut report)?;
    units::cases(&mut report)?;
    long_runs::cases(&mut report, extent)?;
    many_steps::cases(&mut report, extent)?;
    bad_input::cases(&mut report)?;
    Ok(report)
}
