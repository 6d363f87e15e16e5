//! The inertia J of 1/2 tr(O J O^T), and masses. Signs that depend on fields are left to `prepare()`.

use super::identity::asymmetric;
use crate::algebra::Rational;
use crate::diagnostics::{Diagnostics, TermMistake};
use crate::lower::constant;
use crate::spec::{Expression, Spec, Term, Value};
use crate::symbol::TermKind;

/// p = m x_dot: a zero mass leaves the velocity open. A negative mass is a legitimate indefinite energy beside
/// affine terms, but not beside d'Alembert's, which is the energy of the same positive masses (2.1).
pub(super) fn masses(spec: &Spec, found: &mut Diagnostics) {
    let of_masses = of_masses(spec).is_some();
    for term in spec.kinetic.iter().filter(|term| term.kind.value.is_translation()) {
        let Value::Scalar(mass) = &term.value else { continue };
        let Some(value) = constant(mass, spec.dim.value) else { continue };
        let (name, coefficient) = (term.kind.value.name(), mass.to_string());
        if value.is_zero() {
            found.report(term.span, TermMistake::ZeroMass { term: name, coefficient });
        } else if value.is_negative() && of_masses {
            let value = value.to_string();
            found.report(term.span, TermMistake::NegativeMass { term: name, coefficient, value });
        }
    }
}

/// J = J^T in every frame: T sees only the symmetric part of J (4.17), which for d'Alembert is the second moment of
/// the mass distribution in the body (2.1). Entries with fields must be equal whatever the fields are.
pub(super) fn symmetric(spec: &Spec, found: &mut Diagnostics) {
    for term in spec.forms().filter(|term| term.kind.value.is_inertia()) {
        let Value::Matrix(rows) = &term.value else { continue };
        for (i, j) in asymmetric(rows, spec.dim.value) {
            let mistake = TermMistake::InertiaNotSymmetric {
                term: term.kind.value.name(),
                row: j + 1,
                column: i + 1,
                value: rows[j][i].to_string(),
                transposed: rows[i][j].to_string(),
            };
            found.report(rows[i][j].span, mistake);
        }
    }
}

/// The energy of positive masses, where it is one: with `phi` a rotation it is `body_inertia`, and judged as that.
fn of_masses(spec: &Spec) -> Option<&Term> {
    let same = |kind| spec.constraint.map_or(kind, |group| group.value.same_as(kind));
    spec.kinetic.iter().find(|term| same(term.kind.value) == TermKind::Dalembert)
}

/// J > 0 for d'Alembert: it is a second moment of positive masses, and H = 1/2 Tr(Pi^T J^-1 Pi) (2.2) needs its
/// inverse. Sylvester: the leading minors are positive, that is, all pivots of J = L D L^T. In an affine frame an
/// indefinite J is legitimate; whether its form is degenerate depends on the Casimirs beside it.
pub(super) fn positive(spec: &Spec, found: &mut Diagnostics) {
    let Some(term) = of_masses(spec) else { return };
    if let Some(defect) = defect(&term.value, spec.dim.value, "J") {
        found.report(term.span, TermMistake::InertiaNotPositive { term: term.kind.value.name(), defect });
    }
}

/// What shows that a symmetric matrix of numbers, called by `letters`, is not positive definite.
pub(super) fn defect(value: &Value, n: usize, letters: &str) -> Option<String> {
    match value {
        Value::Scalar(multiple) => constant(multiple, n)
            .filter(|value| !positive_number(value))
            .map(|value| format!("{letters} is {value} times the identity")),
        Value::Diagonal(entries) => entries.iter().enumerate().find_map(|(index, entry)| {
            let value = constant(entry, n).filter(|value| !positive_number(value))?;
            Some(format!("{letters}[{0},{0}] = {value}", index + 1))
        }),
        Value::Matrix(rows) => values(rows, n).and_then(bad_minor),
    }
}

fn positive_number(value: &Rational) -> bool {
    !value.is_zero() && !value.is_negative()
}

/// The first leading minor that is not positive.
fn bad_minor(mut rows: Vec<Vec<Rational>>) -> Option<String> {
    let mut minor = Rational::ONE;
    for k in 0..rows.len() {
        minor = &minor * &rows[k][k];
        if !positive_number(&minor) {
            return Some(format!("its leading {0} x {0} minor is {minor}", k + 1));
        }
        let pivot_row = rows[k].clone();
        for row in rows.iter_mut().skip(k + 1) {
            let factor = row[k].checked_div(&pivot_row[k])?;
            for (value, above) in row.iter_mut().zip(&pivot_row) {
                *value = &*value - &(&factor * above);
            }
        }
    }
    None
}

/// The values of a square symmetric matrix of numbers; the other defects have rules of their own.
fn values(rows: &[Vec<Expression>], n: usize) -> Option<Vec<Vec<Rational>>> {
    let values: Vec<Vec<Rational>> =
        rows.iter().map(|row| row.iter().map(|entry| constant(entry, n)).collect()).collect::<Option<_>>()?;
    let square = values.len() == n && values.iter().all(|row| row.len() == n);
    let symmetric = || (0..n).all(|i| (0..i).all(|j| values[i][j] == values[j][i]));
    (square && symmetric()).then_some(values)
}
