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
    /// Largest relative drift over outputs and end.
    worst: f64,
    /// Times of outputs and end, with the largest relative drift up to there.
    pub(super) worst_so_far: Vec<(f64, f64)>,
}

impl Row {
    /// Name and largest drift.
    pub(super) fn label(&self) -> String {
        format!("{}: {:.0e}", self.name, self.worst)
    }
}

impl History {
    /// As many of a trajectory's conserved quantities as there are colours, those that drift most.
    pub(super) fn of<const N: usize, P: Phase<N>>(trajectory: &Trajectory<N, P>) -> Self {
        let row = |drift: &Drift| {
            let (times, (end, _)) = (trajectory.times(), trajectory.end());
            let mut so_far = 0.0;
            let outputs = times.iter().zip(trajectory.relative_drifts(drift)).map(|(t, value)| {
                so_far = larger(so_far, value);
                (*t, so_far)
            });
            let worst = drift.relative();
            let at_end = (times.last() != Some(&end)).then_some((end, worst));
            Row { name: drift.quantity.name(), worst, worst_so_far: outputs.chain(at_end).collect() }
        };
        let all: Vec<Row> = trajectory.conservation().drifts().iter().map(row).collect();
        let (exact, mut rows): (Vec<Row>, Vec<Row>) = all.into_iter().partition(|row| row.worst == 0.0);
        rows.sort_by(|a, b| b.worst.total_cmp(&a.worst));
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
        let values = self.rows.iter().flat_map(|row| row.worst_so_far.iter().map(|(_, worst)| *worst));
        Axis::decades(values, 5, |value| format!("{value:e}"))
    }
}
