//! The order conditions of Butcher, one per rooted tree, in exact rational arithmetic on the published decimals.
//!
//! For a tree `t = [t_1 ... t_m]` of `|t|` nodes: elementary weights `Phi_i(t) = prod_k sum_j a_ij Phi_j(t_k)`,
//! density `gamma(t) = |t| prod_k gamma(t_k)`; order `p` means `sum_i b_i Phi_i(t) = 1/gamma(t)` for `|t| <= p`,
//! and for a continuous method `sum_i b_i(theta) Phi_i(t) = theta^|t|/gamma(t)` (Hairer, Norsett, Wanner, Solving
//! Ordinary Differential Equations I, Theorems II.2.13 and II.6.1).

use std::collections::BTreeMap;
use std::sync::OnceLock;

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero, pow};

use super::PUBLISHED;
use crate::runge_kutta::trees::Tree;

const STAGES: usize = 16;
/// Every published decimal is a multiple of `10^-PLACES`.
const PLACES: usize = 34;

/// Integers over a common denominator, one per stage: rationals would spend their time on common factors.
type Numerators = [BigInt; STAGES];

/// The decimals are rounded at about the 30th digit and some are larger than 100.
fn rounding_of_the_publication() -> BigRational {
    BigRational::new(BigInt::one(), ten_to(27))
}

/// A condition that does not hold misses by more than this; between the two lies nothing.
fn clearly_violated() -> BigRational {
    BigRational::new(BigInt::one(), ten_to(7))
}

fn ten_to(power: usize) -> BigInt {
    pow(BigInt::from(10), power)
}

fn integer(value: usize) -> BigRational {
    BigRational::from_integer(BigInt::from(value))
}

/// A tree with its elementary weights over `10^(PLACES (|t| - 1))`, and with `sum_j a_ij Phi_j(t)` over
/// `10^(PLACES |t|)` for trees that have it as a branch.
struct Condition {
    tree: Tree,
    weights: Numerators,
    as_branch: Numerators,
}

impl Condition {
    fn new(tree: Tree, weights: Numerators, matrix: &[Numerators; STAGES]) -> Self {
        let as_branch = std::array::from_fn(|i| dot(&matrix[i], &weights));
        Self { tree, weights, as_branch }
    }

    /// All trees with at most `nodes` nodes, by number of nodes less one.
    fn up_to(nodes: usize) -> Vec<Vec<Self>> {
        let matrix = matrix();
        let single_node = Self::new(Tree(vec![]), std::array::from_fn(|_| BigInt::one()), &matrix);
        let mut found = vec![vec![single_node]];
        for size in 2..=nodes {
            // One branch more at the root of a smaller tree gives every tree, some several times.
            let mut larger: BTreeMap<Tree, Numerators> = BTreeMap::new();
            for rest in 1..size {
                for stem in &found[rest - 1] {
                    for branch in &found[size - rest - 1] {
                        let weights = || std::array::from_fn(|i| &stem.weights[i] * &branch.as_branch[i]);
                        larger.entry(stem.tree.with_branch(&branch.tree)).or_insert_with(weights);
                    }
                }
            }
            found.push(larger.into_iter().map(|(tree, weights)| Self::new(tree, weights, &matrix)).collect());
        }
        found
    }

    /// `|sum_i b_i Phi_i(t) - value/gamma(t)|`, `b` over `denominator`.
    fn residual(&self, b: &Numerators, denominator: &BigInt, value: BigRational) -> BigRational {
        let scale = denominator * ten_to(PLACES * (self.tree.size() - 1));
        (BigRational::new(dot(b, &self.weights), scale) - value / integer(self.tree.density())).abs()
    }
}

/// The 200 conditions for order 8.
fn conditions() -> &'static [Vec<Condition>] {
    static CONDITIONS: OnceLock<Vec<Vec<Condition>>> = OnceLock::new();
    CONDITIONS.get_or_init(|| Condition::up_to(8))
}

fn dot(a: &Numerators, b: &Numerators) -> BigInt {
    a.iter().zip(b).filter(|(a, _)| !a.is_zero()).map(|(a, b)| a * b).sum()
}

/// `-1.25e-2` times `10^PLACES`.
fn numerator(text: &str) -> BigInt {
    let (mantissa, exponent) = text.split_once('e').unwrap_or((text, "0"));
    let (whole, fraction) = mantissa.split_once('.').unwrap();
    let digits: BigInt = format!("{whole}{fraction}").parse().unwrap();
    let exponent: isize = exponent.parse().unwrap();
    let zeros = PLACES.checked_add_signed(exponent).unwrap().checked_sub(fraction.len()).unwrap();
    digits * ten_to(zeros)
}

/// A published row, over `10^PLACES`.
fn row(name: &str) -> Numerators {
    let (_, pairs) = PUBLISHED.iter().find(|(n, _)| *n == name).unwrap();
    let mut row = std::array::from_fn(|_| BigInt::zero());
    for (stage, value) in *pairs {
        row[stage - 1] = numerator(value);
    }
    row
}

/// Rows 2 to 12 and 14 to 16 as published; row 13 is the step itself.
fn matrix() -> [Numerators; STAGES] {
    std::array::from_fn(|i| match i + 1 {
        1 => std::array::from_fn(|_| BigInt::zero()),
        13 => row("B"),
        stage => row(&format!("A{stage}")),
    })
}

/// The conditions hold up to `order`, and one of the next order does not: by number of nodes, the largest of
/// `|sum_i b_i Phi_i(t) - value(|t|)/gamma(t)|`.
fn assert_order(
    order: usize,
    what: &str,
    (b, denominator): (&Numerators, &BigInt),
    value: impl Fn(usize) -> BigRational,
) {
    for (trees, nodes) in conditions().iter().zip(1..) {
        let residual = trees.iter().map(|tree| tree.residual(b, denominator, value(nodes))).max().unwrap();
        if nodes <= order {
            assert!(residual < rounding_of_the_publication(), "{what}, {nodes} nodes: {residual}");
        } else if nodes == order + 1 {
            assert!(residual > clearly_violated(), "{what} has a higher order than {order}: {residual}");
        }
    }
}

/// `b_i(theta)` of the dense output, over the denominator given with it.
fn dense_weights(theta: &BigRational) -> (Numerators, BigInt) {
    let rational = |name| row(name).map(|n| BigRational::new(n, ten_to(PLACES)));
    let (rise, d4, d5, d6, d7) =
        (rational("B"), rational("D4"), rational("D5"), rational("D6"), rational("D7"));
    let rest = BigRational::one() - theta;
    let denominator = ten_to(PLACES) * pow(theta.denom().clone(), 7);
    let weights = std::array::from_fn(|i| {
        let (begin, end) = (integer(usize::from(i == 0)), integer(usize::from(i == 12)));
        let inner = &d4[i] + theta * (&d5[i] + &rest * (&d6[i] + theta * &d7[i]));
        let third = integer(2) * &rise[i] - &begin - end + &rest * inner;
        let weight = theta * (&rise[i] + &rest * (begin - &rise[i] + theta * third)) * &denominator;
        assert!(weight.is_integer());
        weight.to_integer()
    });
    (weights, denominator)
}

#[test]
fn two_hundred_trees() {
    let counts: Vec<usize> = conditions().iter().map(Vec::len).collect();
    assert_eq!(counts, [1, 1, 2, 4, 9, 20, 48, 115]);
    assert_eq!(counts.iter().sum::<usize>(), 200);
}

#[test]
fn nodes_are_row_sums() {
    let nodes = row("NODES");
    for (row, node) in matrix().iter().zip(&nodes) {
        let defect = BigRational::new(row.iter().sum::<BigInt>() - node, ten_to(PLACES));
        assert!(defect.abs() < rounding_of_the_publication());
    }
}

#[test]
fn solution_has_order_8() {
    assert_order(8, "solution", (&row("B"), &ten_to(PLACES)), |_| BigRational::one());
}

#[test]
fn error_estimators_have_orders_5_and_3() {
    let (b, b3) = (row("B"), row("B3"));
    let third = std::array::from_fn(|i| &b[i] - &b3[i]);
    for (order, weights) in [(5, row("E5")), (3, third)] {
        assert_order(order, "error estimator", (&weights, &ten_to(PLACES)), |_| BigRational::zero());
    }
}

#[test]
fn dense_output_has_order_7() {
    for (n, d) in [(1, 7), (1, 3), (1, 2), (5, 7), (9, 10)] {
        let theta = integer(n) / integer(d);
        let (weights, denominator) = dense_weights(&theta);
        assert_order(7, "dense output", (&weights, &denominator), |nodes| pow(theta.clone(), nodes));
    }
}

#[test]
fn dense_output_ends_at_the_solution() {
    let (weights, denominator) = dense_weights(&BigRational::one());
    assert_eq!(denominator, ten_to(PLACES));
    assert_eq!(weights, row("B"));
    assert!(dense_weights(&BigRational::zero()).0.iter().all(BigInt::is_zero));
}
