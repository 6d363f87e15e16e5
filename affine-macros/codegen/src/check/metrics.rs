//! The metrics of space and body, and what can be stated beside them.

use super::identity::asymmetric;
use super::inertia::defect;
use super::shapes::has_size;
use crate::algebra::Arena;
use crate::diagnostics::{Diagnostics, MetricMistake};
use crate::spec::{Expression, ExpressionKind, MatrixName, Metric, PolynomialTrace, Spec, Value};

fn stated(spec: &Spec) -> impl Iterator<Item = &Metric> {
    spec.metrics.iter().flatten()
}

/// n x n, as `g_ij` and `eta_AB`.
pub(super) fn sizes(spec: &Spec, found: &mut Diagnostics) {
    let n = spec.dim.value;
    for metric in stated(spec) {
        has_size((metric.side, &metric.value, metric.span), n, &format!("n = {n}"), found);
    }
}

/// `g_ij = g_ji > 0`: a metric measures lengths.
pub(super) fn positive(spec: &Spec, found: &mut Diagnostics) {
    let n = spec.dim.value;
    for metric in stated(spec) {
        if let Value::Matrix(rows) = &metric.value
            && let Some((i, j)) = asymmetric(rows, n).find(|(i, j)| is_whole(rows, *i) && is_whole(rows, *j))
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

/// Has a row of a square matrix its length?
fn is_whole(rows: &[Vec<Expression>], i: usize) -> bool {
    rows[i].len() == rows.len()
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
