//! The matrices of `metrics(...)`.

use super::expression;
use crate::algebra::{Arena, Expr, Rational};
use crate::mechanics::metrics::{Bases, Metrics};
use crate::spec::{Metric, Spec, Value};

/// The metrics; `None` where they are the identity, stated or not, and where a size is wrong.
pub fn metrics(arena: &mut Arena, spec: &Spec) -> Option<Metrics> {
    let [space, body] = &spec.metrics;
    let given = [matrix(arena, spec, space.as_ref())?, matrix(arena, spec, body.as_ref())?];
    let numbers = |rows: &Vec<Vec<Expr>>| -> Option<Vec<Vec<Rational>>> {
        rows.iter().map(|row| row.iter().map(|e| arena.as_constant(*e).cloned()).collect()).collect()
    };
    match (numbers(&given[0]), numbers(&given[1])) {
        (Some(space), Some(body)) => Bases::new(&space, &body).map(Metrics::Known),
        _ => Some(Metrics::Given(given)),
    }
}

/// The identity where nothing is stated.
fn matrix(arena: &mut Arena, spec: &Spec, metric: Option<&Metric>) -> Option<Vec<Vec<Expr>>> {
    let n = spec.dim.value;
    let zero = arena.constant(Rational::ZERO);
    let diagonal = |entries: Vec<Expr>| -> Vec<Vec<Expr>> {
        let row = |i: usize| (0..n).map(|j| if i == j { entries[i] } else { zero }).collect();
        (0..n).map(row).collect()
    };
    let mut of = |e| expression(arena, n, e);
    match metric.map(|metric| &metric.value) {
        None => Some(diagonal(vec![arena.constant(Rational::ONE); n])),
        Some(Value::Scalar(e)) => Some(diagonal(vec![of(e)?; n])),
        Some(Value::Diagonal(entries)) => {
            entries.iter().map(of).collect::<Option<Vec<Expr>>>().filter(|list| list.len() == n).map(diagonal)
        }
        Some(Value::Matrix(rows)) if rows.len() == n && rows.iter().all(|row| row.len() == n) => {
            rows.iter().map(|row| row.iter().map(&mut of).collect()).collect()
        }
        Some(Value::Matrix(_)) => None,
    }
}
