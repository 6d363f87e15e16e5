//! The matrices of `metrics(...)`.

use super::coefficient;
use crate::algebra::ring::table;
use crate::algebra::{Arena, Expr, Matrix, Rational};
use crate::mechanics::metrics::{Bases, Metrics};
use crate::mechanics::term::Coefficient;
use crate::spec::{Metric, Spec};

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
    let [zero, one] = [Rational::ZERO, Rational::ONE].map(|number| arena.constant(number));
    let stated = metric.map(|metric| coefficient(arena, n, &metric.value));
    match stated.unwrap_or(Coefficient::Scalar(one)) {
        Coefficient::Scalar(e) => Some(table(n, |i, j| if i == j { e } else { zero })),
        Coefficient::Matrix(Matrix(rows)) => {
            (rows.len() == n && rows.iter().all(|row| row.len() == n)).then_some(rows)
        }
    }
}
