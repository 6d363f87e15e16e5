//! The order conditions of Butcher in exact rational arithmetic, for solution, embedded solution and dense output.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Zero, pow};

use super::PUBLISHED;
use crate::runge_kutta::trees::Tree;

/// Stages 1 to 6 and, as number 13, the slope at the end.
const STAGES: usize = 13;

type Weights = [BigRational; STAGES];

fn integer(value: usize) -> BigRational {
    BigRational::from_integer(BigInt::from(value))
}

/// `-56.0 / 15.0`.
fn fraction(text: &str) -> BigRational {
    let whole = |part: &str| -> BigInt { part.trim().strip_suffix(".0").unwrap().parse().unwrap() };
    match text.split_once('/') {
        Some((over, under)) => BigRational::new(whole(over), whole(under)),
        None => BigRational::from_integer(whole(text)),
    }
}

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
        stage @ 2..=6 => row(&format!("A{stage}")),
        13 => row("B"),
        _ => std::array::from_fn(|_| BigRational::zero()),
    })
}

fn dot(a: &Weights, b: &Weights) -> BigRational {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// `Phi_i(t)`.
fn elementary_weights(tree: &Tree, matrix: &[Weights; STAGES]) -> Weights {
    let mut weights: Weights = std::array::from_fn(|_| BigRational::one());
    for branch in &tree.0 {
        let inner = elementary_weights(branch, matrix);
        for (weight, row) in weights.iter_mut().zip(matrix) {
            *weight *= dot(row, &inner);
        }
    }
    weights
}

/// `sum_i b_i Phi_i(t) = value(|t|)/gamma(t)` for all trees of up to `order` nodes, and not for all of one node more.
fn assert_order(order: usize, what: &str, b: &Weights, value: impl Fn(usize) -> BigRational) {
    let matrix = matrix();
    for (trees, nodes) in Tree::up_to(order + 1).iter().zip(1..) {
        let holds = |tree: &Tree| {
            dot(b, &elementary_weights(tree, &matrix)) == value(nodes) / integer(tree.density())
        };
        assert_eq!(trees.iter().all(holds), nodes <= order, "{what}, {nodes} nodes");
    }
}

#[test]
fn nodes_are_row_sums() {
    let (nodes, matrix) = (row("NODES"), matrix());
    for stage in [2, 3, 4, 5, 6, 13] {
        assert_eq!(matrix[stage - 1].iter().sum::<BigRational>(), nodes[stage - 1], "stage {stage}");
    }
}

#[test]
fn solution_has_order_5_and_the_embedded_one_order_4() {
    assert_order(5, "solution", &row("B"), |_| BigRational::one());
    assert_order(4, "error estimator", &row("E"), |_| BigRational::zero());
}

#[test]
fn dense_output_has_order_4() {
    for (n, d) in [(1, 7), (1, 2), (9, 10)] {
        let theta = integer(n) / integer(d);
        let rest = BigRational::one() - &theta;
        let (rise, last) = (row("B"), row("D"));
        let weights = std::array::from_fn(|i| {
            let (begin, end) = (integer(usize::from(i == 0)), integer(usize::from(i == 12)));
            let inner = integer(2) * &rise[i] - &begin - end + &rest * &last[i];
            &theta * (&rise[i] + &rest * (begin - &rise[i] + &theta * inner))
        });
        assert_order(4, "dense output", &weights, |nodes| pow(theta.clone(), nodes));
    }
}
