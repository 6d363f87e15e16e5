//! Drifts of conserved quantities over time, as the picture of a trajectory shows them.

use super::axes::Axis;
use super::palette::category_count;
use crate::inner::larger;
use crate::simulate::{Drift, Trajectory};
use crate::state::Phase;

/// Quantities that drift most, and what is said of the others.
pub(super) struct History {
    rows: Vec<Row>,
    smaller: usize,
    exact: usize,
}

/// One quantity.
pub(super) struct Row {
    name: &'static str,
    /// Largest relative drift up to each output.
    pub(super) worst_so_far: Vec<f64>,
}

impl Row {
    fn worst(&self) -> f64 {
        self.worst_so_far.last().copied().unwrap_or(0.0)
    }

    /// Name and largest drift.
    pub(super) fn label(&self) -> String {
        format!("{}: {:.0e}", self.name, self.worst())
    }
}

impl History {
    /// As many of a trajectory's conserved quantities as there are colours, those that drift most.
    pub(super) fn of<const N: usize, P: Phase<N>>(trajectory: &Trajectory<N, P>) -> Self {
        let row = |drift: &Drift| {
            let mut worst = 0.0;
            let history = trajectory.relative_drifts(drift).into_iter().map(|value| {
                worst = larger(worst, value);
                worst
            });
            Row { name: drift.quantity.name(), worst_so_far: history.collect() }
        };
        let all: Vec<Row> = trajectory.conservation().drifts().iter().map(row).collect();
        let (exact, mut rows): (Vec<Row>, Vec<Row>) = all.into_iter().partition(|row| row.worst() == 0.0);
        rows.sort_by(|a, b| b.worst().total_cmp(&a.worst()));
        let smaller = rows.len().saturating_sub(category_count());
        rows.truncate(category_count());
        Self { rows, smaller, exact: exact.len() }
    }

    pub(super) fn rows(&self) -> &[Row] {
        &self.rows
    }

    /// What has no line.
    pub(super) fn remarks(&self) -> Vec<String> {
        let remark = |count: usize, what: &str| (count > 0).then(|| format!("{what}: {count} more"));
        [remark(self.smaller, "smaller drift"), remark(self.exact, "no drift")]
            .into_iter()
            .flatten()
            .collect()
    }

    /// Logarithmic axis that holds all rows.
    pub(super) fn axis(&self) -> Axis {
        let values = self.rows.iter().flat_map(|row| row.worst_so_far.iter().copied());
        Axis::decades(values, 5, |value| format!("{value:e}"))
    }
}
