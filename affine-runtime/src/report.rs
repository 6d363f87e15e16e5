//! Reports: error against run time, and trajectories as pictures.
//!
//! # Error against run time
//!
//! [`WorkPrecision`] runs a problem with every method at every tolerance and gives a [`WorkPrecisionReport`]: a
//! table (`Display`), comma-separated values ([`to_csv`](WorkPrecisionReport::to_csv)) and a picture
//! ([`save_svg`](WorkPrecisionReport::save_svg)). Per row:
//!
//! - **True error.** `|a - b|/|b|` at the end of the run for each part of the phase point as the model stores it
//!   (`phi`, the momenta, `x`), in the Euclidean or Frobenius norm, `b` being the reference: a phase point known
//!   from elsewhere, else the closed form where the model has one, else the [`reference_solution`]. An error far below
//!   the reference's own is meaningless; the report cannot know how good the reference is.
//! - **Steps, rejected steps, evaluations** of the right-hand side. They do not depend on the machine and repeat
//!   exactly: compare methods with the same right-hand side by them. Taylor series are not counted in these but in series;
//!   the table shows the evaluations that they are worth with a `~`, since that is derived from operations, see
//!   [`Statistics::series_worth`](affine_integrators::Statistics::series_worth).
//! - **Run time** from phase point to phase point: reduction, integration, the check of every accepted state, the
//!   energy at both ends. It is the median of the repeats, by the monotonic clock, after one run that is not
//!   timed. No output on the way is asked for.
//! - **Energy drift** relative to the size of the energy, where the model conserves it.
//! - **Share of steps above tolerance**: those whose true local error, the distance from the motion through the point
//!   where the step began, exceeds the tolerance. An estimator that can be trusted keeps it near zero.
//!
//! A run that stops keeps its row and says why.
//!
//! *Limits.* Run times on a machine that others use too are noise of ten percent and more, and of a factor of two
//! while its clock rate changes: repeat, and compare within one report rather than between reports. Medians hide
//! single interruptions, not a busy machine. Times below a microsecond are near the resolution of the clock.
//! Nothing is said about the error on the way: a method may be wrong in between and right at the end.
//!
//! # Stability
//!
//! [`StabilityReport`] gathers stiff and extreme cases: each has an [`Oracle`], a [`Demand`] and a [`Finding`], and displays as
//! held, refused in words, or fell short; `cargo run --release --example stability` fills one. [`Stress`] fills one for any model
//! and start, without an oracle of their own.
//!
//! # Pictures
//!
//! [`Trajectory::save_svg`](crate::Trajectory::save_svg) draws the motion, the log-stretches and the drift of what
//! should be conserved. Documents are well-formed SVG 1.1, the same bytes for the same data.
//! [`Trajectory::save_html`](crate::Trajectory::save_html) writes a page on which the body moves, and
//! [`Trajectory::page`](crate::Trajectory::page) adds the fields of the model to it.

mod axes;
mod canvas;
mod curves;
mod diagram;
mod drift;
mod local_error;
mod page;
mod palette;
mod picture;
mod reference;
mod reproduction;
mod scene;
mod stability;
mod stress;
mod table;
mod view;
mod work_precision;

use std::path::Path;

#[cfg(feature = "analysis")]
pub(crate) use curves::PANEL;
pub use curves::{Curve, CurveDiagram, CurvePanel};
pub use diagram::WorkPrecisionDiagram;
pub use page::Page;
pub use reference::reference_solution;
pub use stability::{Demand, Finding, Oracle, Scene, StabilityCase, StabilityReport, Verdict};
pub use stress::Stress;
pub use work_precision::{Measurement, Row, WorkPrecision, WorkPrecisionReport};

use crate::error::{Error, Result};
use crate::simulate::Method;

/// What a method is called in tables and legends.
fn method_name(method: Method) -> &'static str {
    match method {
        Method::Automatic => "automatic",
        Method::ClosedForm => "closed form",
        Method::RungeKutta8 => "Runge-Kutta 8",
        Method::RungeKutta5 => "Runge-Kutta 5",
        Method::RungeKuttaNystrom12 => "Runge-Kutta-Nystrom 12",
        Method::RungeKuttaNystrom8 => "Runge-Kutta-Nystrom 8",
        Method::Taylor { .. } => "Taylor",
        Method::Gauss { stages: 2, .. } => "Gauss 4",
        Method::Gauss { stages: 3, .. } => "Gauss 6",
        Method::Gauss { stages: 4, .. } => "Gauss 8",
        Method::Gauss { .. } => "Gauss 12",
        Method::Rattle { order: 2, .. } => "RATTLE",
        Method::Rattle { order: 4, .. } => "RATTLE 4",
        Method::Rattle { order: 6, .. } => "RATTLE 6",
        Method::Rattle { .. } => "RATTLE 8",
        Method::Splitting { order: 2, .. } => "splitting 2",
        Method::Splitting { order: 4, .. } => "splitting 4",
        Method::Splitting { order: 6, .. } => "splitting 6",
        Method::Splitting { .. } => "splitting 8",
        Method::AdaptiveSplitting { .. } => "adaptive splitting",
        Method::Radau { .. } => "Radau",
    }
}

/// Writes a file.
fn save(path: &Path, contents: &str) -> Result<()> {
    std::fs::write(path, contents)
        .map_err(|error| Error::File { path: path.to_path_buf(), kind: error.kind() })
}

/// Text of XML or HTML.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
