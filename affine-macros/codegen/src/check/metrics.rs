//! The metrics of space and body, and what can be stated beside them.

use super::identity::equal;
use super::inertia::defect;
use super::shapes::counts;
use crate::algebra::Arena;
use crate::diagnostics::{Diagnostics, MetricMistake, TermMistake};
use crate::spec::{Expression, ExpressionKind, MatrixName, Metric, PolynomialTrace, Spec, Value};

fn stated(spec: &Spec) -> impl Iterator<Item = &Metric> {
    spec.metrics.iter().flatten()
}

/// n x n, as `g_ij` and `eta_AB`.
pub(super) fn sizes(spec: &Spec, found: &mut Diagnostics) {
    let n = spec.dim.value;
    for metric in stated(spec) {
        for (at, counted, actual) in counts(&metric.value, metric.span, n) {
            if actual != n {
                let because = format!("n = {n}");
                let mistake = TermMistake::MatrixSize {
                    term: metric.side,
                    counted,
                    found: actual,
                    expected: n,
                    because,
                };
                found.report(at, mistake);
            }
        }
    }
}

/// `g_ij = g_ji > 0`: a metric measures lengths.
pub(super) fn positive(spec: &Spec, found: &mut Diagnostics) {
    let n = spec.dim.value;
    for metric in stated(spec) {
        if let Value::Matrix(rows) = &metric.value
            && let Some((i, j)) = asymmetric(rows, n)
        {
            let mistake = MetricMistake::MetricNotSymmetric {
                side: metric.side,
                row: j + 1,
                column: i + 1,
                value: rows[j][i].to_string(),
                transposed: rows[i][j].to_string(),
            };
            found.report(rows[i][j].span, mistake);
        } else if let Some(defect) = defect(&metric.value, n, metric.letters()) {
            found.report(metric.span, MetricMistake::MetricNotPositive { side: metric.side, defect });
        }
    }
}

/// The first entry below the diagonal that differs from its transpose.
fn asymmetric(rows: &[Vec<Expression>], n: usize) -> Option<(usize, usize)> {
    let pairs = (0..rows.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
    pairs
        .filter(|(i, j)| rows[*i].len() == rows.len() && rows[*j].len() == rows.len())
        .find(|(i, j)| equal(&rows[*j][*i], &rows[*i][*j], n) == Some(false))
}

/// Traces of `phi` itself, and of products of tensors of the body with tensors of space, take an index of space for one
/// of the body: what they are depends on the bases, and beside metrics no pair of these is the one that is meant.
pub(super) fn invariant(spec: &Spec, found: &mut Diagnostics) {
    if crate::lower::metrics(&mut Arena::new(), spec).is_none() {
        return;
    }
    let mut pending: Vec<&Expression> = spec.potential.iter().map(|potential| &potential.energy).collect();
    while let Some(part) = pending.pop() {
        let factors = match &part.kind {
            ExpressionKind::Trace(factors) => factors.clone(),
            ExpressionKind::PolynomialTrace(PolynomialTrace { products: Some(products), .. }) => {
                pending.push(products);
                continue;
            }
            ExpressionKind::PolynomialTrace(trace) => trace.matrices(),
            _ => Vec::new(),
        };
        if factors.contains(&MatrixName::Placement) || factors.windows(2).any(|pair| pair[0] != pair[1]) {
            found.report(part.span, MetricMistake::MetricForm { form: part.to_string() });
        }
        pending.extend(part.operands());
    }
}
