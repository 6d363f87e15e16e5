//! Mistakes in the metrics, and in what stands beside them.

use super::message::{Text, text};
use super::names::names;

/// A mistake in a metric, or beside one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum MetricMistake {
    /// `g_ij != g_ji`.
    MetricNotSymmetric {
        /// `space` or `body`.
        side: &'static str,
        /// The row, 1-based.
        row: usize,
        /// The column, 1-based.
        column: usize,
        /// The value at (row, column).
        value: String,
        /// The value at (column, row).
        transposed: String,
    },
    /// A metric that is not positive definite.
    MetricNotPositive {
        /// `space` or `body`.
        side: &'static str,
        /// What shows it: `g[2,2] = -1`.
        defect: String,
    },
    /// A form of potentials that depends on the bases.
    MetricForm {
        /// The form: `tr(phi)`, `tr(G*Ct)`.
        form: String,
    },
}

names! { MetricMistake
    MetricNotSymmetric => "metric-not-symmetric",
    MetricNotPositive => "metric-not-positive",
    MetricForm => "metric-form",
}

impl MetricMistake {
    pub(super) fn text(&self) -> Text {
        match self {
            Self::MetricNotSymmetric { side, row, column, value, transposed } => text(
                format!(
                    "the metric `{side}` is not symmetric: its entry ({row},{column}) is {value}, \
                     ({column},{row}) is {transposed}"
                ),
                "a metric is a scalar product, g(u, v) = g(v, u)",
                "write the same entry in both places",
            ),
            Self::MetricNotPositive { side, defect } => text(
                format!("the metric `{side}` is not positive definite: {defect}"),
                "a metric gives every vector but zero a positive length, and has an orthonormal basis only then",
                "write a symmetric matrix whose leading minors are all positive",
            ),
            Self::MetricForm { form } => text(
                format!("`{form}` depends on the bases, and beside `metrics(...)` no pair of them is meant"),
                "`phi` takes the body to space, `G` has indices of the body and `Ct` of space: the trace identifies the two, \
                 as no more than a choice of bases does",
                "write entries such as `phi[1,2]`, or traces of powers of `G` or of `Ct`",
            ),
        }
    }
}
