//! The matrices of `metrics(...)`.

use crate::algebra::Rational;
use crate::check::constant;
use crate::mechanics::metrics::Metrics;
use crate::spec::{Metric, Spec, Value};

/// The change to orthonormal bases; `None` where the metrics are the identity, stated or not.
#[must_use]
pub fn metrics(spec: &Spec) -> Option<Metrics> {
    let [space, body] = &spec.metrics;
    Metrics::new(&matrix(spec, space.as_ref())?, &matrix(spec, body.as_ref())?)
}

/// The identity where nothing is stated.
fn matrix(spec: &Spec, metric: Option<&Metric>) -> Option<Vec<Vec<Rational>>> {
    let n = spec.dim.value;
    let diagonal = |entry: &dyn Fn(usize) -> Option<Rational>| -> Option<Vec<Vec<Rational>>> {
        let row = |i: usize| (0..n).map(|j| if i == j { entry(i) } else { Some(Rational::ZERO) }).collect();
        (0..n).map(row).collect()
    };
    match metric.map(|metric| &metric.value) {
        None => diagonal(&|_| Some(Rational::ONE)),
        Some(Value::Scalar(e)) => diagonal(&|_| constant(e, n)),
        Some(Value::Diagonal(entries)) => diagonal(&|i| constant(entries.get(i)?, n)),
        Some(Value::Matrix(rows)) => {
            rows.iter().map(|row| row.iter().map(|e| constant(e, n)).collect()).collect()
        }
    }
}
