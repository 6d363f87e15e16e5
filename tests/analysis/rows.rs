//! The rows of `tests/data/analysis.json`, all 67 of them, each against what the public interface finds.
//!
//! Values were computed in 60 digits by two routes, closed forms or Hessian blocks on one side and spectra of Jacobians on the other.
//! A row of a kind that no test knows fails.

mod ellipsoids;
mod flows;
mod modes;
mod tops;
mod turning;

use std::path::Path;

use affine_runtime::analysis::{AnalysisError, Condition, Generator, RelativeEquilibrium, Stability};
use affine_runtime::model::Model;
use affine_runtime::prelude::*;
use serde_json::Value;

/// What is known of one case.
pub(crate) struct Row(Value);

impl Row {
    fn at(&self, place: &str) -> &Value {
        self.0.pointer(&format!("/{place}")).unwrap_or_else(|| panic!("{place} of {}", self.0))
    }

    fn has(&self, place: &str) -> bool {
        self.0.pointer(&format!("/{place}")).is_some_and(|value| !value.is_null())
    }

    fn text(&self, place: &str) -> &str {
        self.at(place).as_str().unwrap()
    }

    fn is(&self, place: &str) -> bool {
        self.at(place).as_bool().unwrap()
    }

    fn count(&self, place: &str) -> usize {
        self.at(place).as_u64().unwrap().try_into().unwrap()
    }

    /// A number of 30 digits, to the nearest double.
    fn number(&self, place: &str) -> f64 {
        self.text(place).parse().unwrap()
    }

    /// An exact decimal.
    fn parameter(&self, name: &str) -> f64 {
        self.number(&format!("parameters/{name}"))
    }

    fn numbers(&self, place: &str) -> Vec<f64> {
        self.at(place).as_array().unwrap().iter().map(|one| one.as_str().unwrap().parse().unwrap()).collect()
    }

    fn array<const K: usize>(&self, place: &str) -> [f64; K] {
        self.numbers(place).try_into().unwrap()
    }

    fn matrix<const N: usize>(&self, place: &str) -> Matrix<N> {
        Matrix::<N>::from_fn(|i, a| self.number(&format!("{place}/{i}/{a}")))
    }
}

fn of_section(section: &str, count: usize) -> Vec<Row> {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("data/analysis.json");
    let all: Value = serde_json::from_str(&std::fs::read_to_string(file).unwrap()).unwrap();
    let rows: Vec<_> = all["sections"][section].as_array().unwrap().iter().cloned().map(Row).collect();
    assert_eq!(rows.len(), count, "{section}");
    rows
}

/// Positive frequencies, from the least.
pub(crate) fn frequencies<const N: usize>(stability: &Stability<N>) -> Vec<f64> {
    let positive = stability.eigenvalues.iter().filter(|one| one.value.im > one.error);
    positive.map(|one| one.value.im).collect()
}

pub(crate) fn assert_near(found: &[f64], expected: &[f64], tolerance: f64) {
    assert_eq!(found.len(), expected.len(), "{found:?} and not {expected:?}");
    for (found, expected) in found.iter().zip(expected) {
        assert!((found - expected).abs() <= tolerance, "{found} and not {expected}");
    }
}

/// Values come with their negatives and conjugates, to rounding.
pub(crate) fn assert_paired<const N: usize>(stability: &Stability<N>) {
    for one in &stability.eigenvalues {
        for other in [-one.value, one.value.conj()] {
            let nearest = stability.eigenvalues.iter().map(|there| (there.value - other).norm());
            assert!(nearest.fold(f64::INFINITY, f64::min) <= 2.0 * one.error, "{:?}", stability.eigenvalues);
        }
    }
}

/// All frequencies are known, with any multiplicity, and all that are known are there, but for those of `free` that turn an axis,
/// which momenta may leave out.
fn assert_frequencies<const N: usize>(stability: &Stability<N>, known: &[f64], free: &[f64], tolerance: f64) {
    assert_paired(stability);
    let found: Vec<f64> = frequencies(stability).into_iter().filter(|one| *one > 1e-3).collect();
    let near = |a: f64, b: &f64| (a - b).abs() <= tolerance;
    for one in &found {
        assert!(known.iter().chain(free).any(|known| near(*one, known)), "{one} of {found:?}: {known:?}");
    }
    for one in known {
        assert!(found.iter().any(|own| near(*own, one)), "{one} is not among {found:?}");
    }
}

/// What turns in space and in the body about the last axis, at these velocities.
fn turned<const N: usize, M: Model<N>>(
    model: &M,
    phi: Matrix<N>,
    [space, body]: [f64; 2],
    start: impl Fn(Matrix<N>, Matrix<N>) -> affine_runtime::Result<M::Point<f64>>,
) -> Result<RelativeEquilibrium<N, M::Point<f64>>, AnalysisError> {
    let turns = [Generator::<N>::rotation(1, 2), Generator::<N>::vorticity(1, 2)];
    let guess = start(phi, turns[0].space * phi * space + phi * turns[1].body * body)?;
    let conditions = [Condition::Velocity(0, space), Condition::Velocity(1, body)];
    affine_runtime::analysis::relative_equilibrium(model, &guess, &turns, &conditions)
}

#[test]
fn vibrations() {
    of_section("modes", 8).iter().for_each(modes::assert_row);
}

#[test]
fn relative_equilibria() {
    of_section("relative_equilibria", 24).iter().for_each(turning::assert_row);
}

#[test]
fn self_gravitating_ellipsoids() {
    of_section("ellipsoids", 18).iter().for_each(ellipsoids::assert_row);
}

#[test]
fn rigid_bodies() {
    of_section("tops", 8).iter().for_each(tops::assert_row);
}

#[test]
fn motions_beside_a_motion() {
    of_section("flows", 9).iter().for_each(flows::assert_row);
}
