//! Pictures are drawn by `report`.
use affine_runtime::frames::Body;
use affine_runtime::prelude::*;
use affine_runtime::state::{PhasePoint, Pinned};

/// Draws a run of a planar body.
///
/// # Errors
/// A file that cannot be written.
pub fn draw(run: &Trajectory<2, PhasePoint<2, Body, Pinned>>) -> affine_runtime::Result<()> {
    run.save_svg("disc.svg")?;
    println!("{}", run.to_svg());
    run.save_html("disc.html")?;
    println!("{}", run.to_html());
    Ok(())
}
