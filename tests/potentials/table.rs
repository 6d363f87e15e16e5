//! The reference values, and what a model makes of them.

use affine_runtime::model::{Description, Operations};
use affine_runtime::prelude::*;

/// A model beside the table.
pub(crate) struct Energy {
    pub(crate) name: &'static str,
    /// Of the full equations, at a point, and of the reduced ones, along a motion.
    pub(crate) operations: [Operations; 2],
    pub(crate) rows: Vec<Row>,
}

/// A placement: Frobenius norms.
pub(crate) struct Row {
    pub(crate) at: String,
    pub(crate) error: f64,
    pub(crate) size: f64,
    pub(crate) sensitivity: f64,
    pub(crate) near: f64,
}

fn numbers(text: &str) -> Vec<f64> {
    text.split_whitespace().map(|number| number.parse().unwrap()).collect()
}

fn norm(values: &[f64]) -> f64 {
    values.iter().map(|value| value * value).sum::<f64>().sqrt()
}

/// Where a group of components stands in the state.
fn place(description: &Description, name: &str) -> Option<core::ops::Range<usize>> {
    let mut start = 0;
    for group in description.full {
        let (group, len) = (&group.name(), &group.len);
        if *group == name {
            return Some(start..start + len);
        }
        start += len;
    }
    None
}

/// `38* 12+ 1/ 1r`
pub(crate) fn counted(operations: &Operations) -> String {
    let Operations { mul, add, div, sqrt, exp, ln } = *operations;
    let some = [(div, "/"), (sqrt, "r"), (exp, "e"), (ln, "l")];
    let some: String = some.iter().filter(|(k, _)| *k > 0).map(|(k, sign)| format!(" {k}{sign}")).collect();
    format!("{mul}* {add}+{some}")
}

/// A model at the placements of its name, `energy_n`: `dPi/dt = -F^T` and `dp/dt = -dU/dx`.
pub(crate) fn of<const N: usize, M: Model<N>>(name: &'static str, model: &M) -> Energy {
    let description = M::DESCRIPTION;
    let rows = include_str!("../data/potentials.csv")
        .lines()
        .skip(1)
        .map(|line| line.split(',').collect::<Vec<_>>());
    let rows = rows.filter(|cells| format!("{}_{}", cells[0], cells[1]) == name).map(|cells| {
        let t = numbers(cells[5]).first().copied().unwrap_or(0.0);
        let mut state: M::Full<f64> = affine_runtime::model::StateVector::zeros();
        let mut put = |name: &str, values: &[f64]| {
            if let Some(place) = place(&description, name).filter(|place| place.len() == values.len()) {
                state.as_mut()[place].copy_from_slice(values);
            }
        };
        put("phi", &numbers(cells[3]));
        put("x", &numbers(cells[4]));
        let rates = model.hamilton_equations(t, &state);
        let pi = &rates.as_ref()[place(&description, "Pi").unwrap()];
        let force = numbers(cells[6]);
        let mut defects: Vec<f64> = (0..N * N).map(|k| pi[(k % N) * N + k / N] + force[k]).collect();
        let on_centre = numbers(cells[7]);
        if let Some(p) = place(&description, "p").filter(|_| !on_centre.is_empty()) {
            defects.extend(rates.as_ref()[p].iter().zip(&on_centre).map(|(rate, force)| rate + force));
        }
        Row {
            at: cells[2].to_owned(),
            error: norm(&defects),
            size: norm(&[force, on_centre].concat()),
            sensitivity: norm(&numbers(cells[8])),
            near: cells[9].parse().unwrap(),
        }
    });
    let operations = [description.full_operations, description.reduced_operations];
    Energy { name, operations, rows: rows.collect() }
}
