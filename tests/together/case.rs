//! A pair with its model and its law, and points of it.

use affine_oracle::{Constraint, Random};
use affine_runtime::frames::Matrix;
use affine_runtime::model::{Group, Quantity};
use affine_tests::group::starts;
use affine_tests::reference::{entries, norm};

use crate::body::Canonical;
use crate::forms::matrix;
use crate::law::Law;
use crate::lists::{Drawn, Pair, pairs};
use crate::subject::Subject;

/// Time of the start.
pub(crate) const T0: f64 = 0.25;
/// Points of each model.
const SAMPLES: u64 = 2;

/// A pair that is accepted.
pub(crate) struct Case {
    pub(crate) name: String,
    pub(crate) pair: Pair,
    pub(crate) subject: Subject,
    pub(crate) law: Law,
}

/// All of them.
pub(crate) fn cases() -> Vec<Case> {
    let listed: Vec<Pair> = pairs().collect();
    let case = |(number, subject): (usize, fn() -> Subject)| {
        let pair = listed[number];
        let name = format!("{}, {}, centre {}", pair.energy.name, pair.feature.name, pair.centre.name);
        let law = Law::new(pair, Drawn::new(number as u64, pair.dim()));
        Case { name, pair, subject: subject(), law }
    };
    crate::subjects().into_iter().map(case).collect()
}

/// Numbers within 1, not short.
fn numbers(random: &mut Random, len: usize) -> Vec<f64> {
    (0..len).map(|_| random.integer(-9973, 9973) as f64 / 9973.0).collect()
}

impl Case {
    pub(crate) fn dim(&self) -> usize {
        self.pair.dim()
    }

    /// Plain arrays of points, on the group where there is one.
    pub(crate) fn points(&self) -> Vec<Vec<f64>> {
        (0..SAMPLES).map(|seed| self.drawn(seed).0).collect()
    }

    /// A plain array of a point, and a direction in which it may change.
    pub(crate) fn drawn(&self, seed: u64) -> (Vec<f64>, Vec<f64>) {
        let mut random = Random::new(8800 + seed);
        let n = self.dim();
        let (phi, change) = match self.law.constraint {
            Some(constraint) => on_group(constraint, seed, &mut random),
            None => (random.placement(n).to_f64(), numbers(&mut random, n * n)),
        };
        let (mut point, mut direction) = (Vec::new(), Vec::new());
        for group in self.subject.description.full {
            if group.quantity == Quantity::Placement {
                point.extend(&phi);
                direction.extend(&change);
            } else {
                point.extend(numbers(&mut random, group.len));
                direction.extend(numbers(&mut random, group.len));
            }
        }
        (point, direction)
    }

    /// A vector of numbers against another, relative to the larger of 1 and a size.
    pub(crate) fn assert_close(
        &self,
        what: &str,
        found: &[f64],
        expected: &[f64],
        size: f64,
        tolerance: f64,
    ) {
        assert_eq!(found.len(), expected.len(), "{}: {what}: components", self.name);
        let difference: Vec<f64> = found.iter().zip(expected).map(|(f, e)| f - e).collect();
        let error = norm(&difference);
        // Written so that NaN fails.
        assert!(
            error <= tolerance * size.max(1.0),
            "{}: {what}: error {error:e} of {size:e}, tolerance {tolerance:e}\n{found:?}\n{expected:?}",
            self.name
        );
    }

    /// All parts of a point, or of its rates.
    pub(crate) fn assert_parts(
        &self,
        what: &str,
        found: &Canonical,
        expected: &[Vec<f64>; 4],
        tolerance: f64,
    ) {
        let size = expected.iter().map(|part| norm(part)).fold(1.0, f64::max);
        for ((name, found), expected) in found.named().into_iter().zip(expected) {
            self.assert_close(&format!("{what} {name}"), found, expected, size, tolerance);
        }
    }

    /// The components of a group of the reduced state.
    pub(crate) fn of_reduced<'a>(&self, quantity: Quantity, y: &'a [f64]) -> Option<&'a [f64]> {
        group(self.subject.description.reduced, quantity, y)
    }
}

fn group<'a>(layout: &[Group], quantity: Quantity, y: &'a [f64]) -> Option<&'a [f64]> {
    let at = layout.iter().position(|group| group.quantity == quantity)?;
    let before: usize = layout[..at].iter().map(|group| group.len).sum();
    y.get(before..before + layout[at].len)
}

/// A placement of the group, and how it may change there; all groups are in the plane.
fn on_group(constraint: Constraint, seed: u64, random: &mut Random) -> (Vec<f64>, Vec<f64>) {
    let start = starts::<2>(constraint).nth(seed as usize).unwrap();
    let any = matrix::<2>(&numbers(random, 4));
    let (skew, mean) = ((any - any.transpose()) * 0.5, Matrix::<2>::identity() * (0.5 * any.trace()));
    let along = match constraint {
        Constraint::Isochoric => any - mean,
        Constraint::Rigid => skew,
        Constraint::Conformal => skew + mean,
    };
    (entries(&start.phi), entries(&(start.phi * along)))
}
