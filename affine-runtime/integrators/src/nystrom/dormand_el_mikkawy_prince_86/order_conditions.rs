//! The order conditions of the method of order 8, one per tree, in exact rational arithmetic on the published
//! fractions.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Zero};

use super::PUBLISHED;
use crate::nystrom::trees::{Method, Tree, conditions};

/// The last of them the first of the next step.
const STAGES: usize = 9;

type Weights = [BigRational; STAGES];

fn over(value: usize) -> BigRational {
    BigRational::new(BigInt::one(), BigInt::from(value))
}

/// `-66701.0 / 197352.0`.
fn fraction(text: &str) -> BigRational {
    let whole = |part: &str| -> BigInt { part.trim().strip_suffix(".0").unwrap().parse().unwrap() };
    match text.split_once('/') {
        Some((over, under)) => BigRational::new(whole(over), whole(under)),
        None => BigRational::from_integer(whole(text)),
    }
}

fn dot(a: &Weights, b: &Weights) -> BigRational {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// A published row.
fn row(name: &str) -> Weights {
    let (_, pairs) = PUBLISHED.iter().find(|(n, _)| *n == name).unwrap();
    let mut row: Weights = std::array::from_fn(|_| BigRational::zero());
    for (stage, value) in *pairs {
        row[stage - 1] = fraction(value);
    }
    row
}

fn matrix() -> [Weights; STAGES] {
    std::array::from_fn(|i| match i + 1 {
        1 => std::array::from_fn(|_| BigRational::zero()),
        STAGES => row("POSITION"),
        stage => row(&format!("A{stage}")),
    })
}

/// The method in fractions.
struct Published {
    matrix: [Weights; STAGES],
}

impl Method<Weights> for Published {
    fn ones(&self) -> Weights {
        std::array::from_fn(|_| BigRational::one())
    }
    fn nodes(&self) -> Weights {
        row("NODES")
    }
    fn product(&self, a: &Weights, b: &Weights) -> Weights {
        std::array::from_fn(|i| &a[i] * &b[i])
    }
    fn through(&self, weights: &Weights) -> Weights {
        std::array::from_fn(|i| dot(&self.matrix[i], weights))
    }
}

/// Positions and momenta have an order, and no higher one.
fn assert_order(order: usize, position: &str, momentum: &str) {
    let conditions = conditions(&Published { matrix: matrix() }, order + 1);
    for (name, last, positions) in [(position, order - 1, true), (momentum, order, false)] {
        let weights = row(name);
        let value = |t: &Tree| over(t.density() * if positions { t.order() + 1 } else { 1 });
        let hold = |trees: usize| {
            let mut conditions = conditions[trees - 1].iter();
            conditions.all(|condition| dot(&weights, &condition.weights) == value(&condition.tree))
        };
        assert_eq!((1..=last).find(|trees| !hold(*trees)), None, "{name}");
        assert!(!hold(last + 1), "{name}: a higher order");
    }
}

#[test]
fn numbers_of_trees() {
    let counts: Vec<usize> = conditions(&Published { matrix: matrix() }, 8).iter().map(Vec::len).collect();
    // Hairer, Norsett, Wanner, Table II.14.3.
    assert_eq!(counts, [1, 1, 2, 3, 6, 10, 20, 36]);
}

#[test]
fn nodes_are_row_sums_and_the_last_closes_the_step() {
    // sum_j a_ij = c_i^2/2.
    let nodes = row("NODES");
    for (row, node) in matrix().iter().zip(&nodes) {
        assert_eq!(row.iter().sum::<BigRational>(), node * node * over(2));
    }
    assert_eq!(nodes[STAGES - 1], BigRational::one());
}

#[test]
fn solution_has_order_8() {
    assert_order(8, "POSITION", "MOMENTUM");
}

#[test]
fn embedded_solution_has_order_6() {
    assert_order(6, "EMBEDDED_POSITION", "EMBEDDED_MOMENTUM");
}
