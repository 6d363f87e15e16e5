//! The order conditions of the methods of orders 8 and 6, one per tree, in exact rational arithmetic on the published
//! fractions.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Zero};

use super::trees::{Condition, Method, Tree, conditions};

type Weights = Vec<BigRational>;
type Published = &'static [(&'static str, &'static [(usize, &'static str)])];

/// Rows as published.
struct Rows {
    stages: usize,
    published: Published,
}

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

impl Rows {
    fn row(&self, name: &str) -> Weights {
        let (_, pairs) = self.published.iter().find(|(n, _)| *n == name).unwrap();
        let mut row = vec![BigRational::zero(); self.stages];
        for (stage, value) in *pairs {
            row[stage - 1] = fraction(value);
        }
        row
    }

    fn matrix(&self) -> Vec<Weights> {
        let none = vec![BigRational::zero(); self.stages];
        let later = (2..=self.stages).map(|stage| self.row(&format!("A{stage}")));
        std::iter::once(none).chain(later).collect()
    }

    /// Positions and momenta have an order, and no higher one.
    fn assert_order(&self, order: usize, position: &str, momentum: &str) {
        let conditions = conditions(self, order + 1);
        let hold = |trees: &[Condition<Weights>], weights: &Weights, value: &dyn Fn(&Tree) -> BigRational| {
            trees.iter().all(|condition| dot(weights, &condition.weights) == value(&condition.tree))
        };
        for (name, last, positions) in [(position, order - 1, true), (momentum, order, false)] {
            let weights = self.row(name);
            let value = |t: &Tree| over(t.density() * if positions { t.order() + 1 } else { 1 });
            for trees in 1..=last {
                assert!(hold(&conditions[trees - 1], &weights, &value), "{name}, order {trees}");
            }
            assert!(!hold(&conditions[last], &weights, &value), "{name}: a higher order");
        }
    }

    /// `sum_j a_ij = c_i^2/2`, and the last stage is the end of the step.
    fn assert_stages(&self) {
        let (matrix, nodes) = (self.matrix(), self.nodes());
        for (row, node) in matrix.iter().zip(&nodes) {
            assert_eq!(row.iter().sum::<BigRational>(), node * node * over(2));
        }
        assert_eq!(matrix[self.stages - 1], self.row("POSITION"));
        assert_eq!(nodes[self.stages - 1], BigRational::one());
    }
}

impl Method<Weights> for Rows {
    fn ones(&self) -> Weights {
        vec![BigRational::one(); self.stages]
    }
    fn nodes(&self) -> Weights {
        self.row("NODES")
    }
    fn product(&self, a: &Weights, b: &Weights) -> Weights {
        a.iter().zip(b).map(|(a, b)| a * b).collect()
    }
    fn through(&self, weights: &Weights) -> Weights {
        self.matrix().iter().map(|row| dot(row, weights)).collect()
    }
}

fn order_8() -> Rows {
    Rows { stages: 9, published: super::dormand_el_mikkawy_prince_86::PUBLISHED }
}

fn order_6() -> Rows {
    Rows { stages: 6, published: super::dormand_el_mikkawy_prince_64::PUBLISHED }
}

#[test]
fn numbers_of_trees() {
    let counts: Vec<usize> = conditions(&order_8(), 8).iter().map(Vec::len).collect();
    // Hairer, Norsett, Wanner, Table II.14.3.
    assert_eq!(counts, [1, 1, 2, 3, 6, 10, 20, 36]);
}

#[test]
fn stages_are_consistent_and_the_last_closes_the_step() {
    order_8().assert_stages();
    order_6().assert_stages();
}

#[test]
fn solution_has_order_8() {
    order_8().assert_order(8, "POSITION", "MOMENTUM");
}

#[test]
fn its_embedded_solution_has_order_6() {
    order_8().assert_order(6, "EMBEDDED_POSITION", "EMBEDDED_MOMENTUM");
}

#[test]
fn solution_has_order_6() {
    order_6().assert_order(6, "POSITION", "MOMENTUM");
}

#[test]
fn its_embedded_solution_has_order_4() {
    order_6().assert_order(4, "EMBEDDED_POSITION", "EMBEDDED_MOMENTUM");
}
