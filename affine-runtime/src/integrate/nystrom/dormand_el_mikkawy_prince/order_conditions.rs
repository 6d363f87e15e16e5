//! The order conditions of Nystrom methods, one per tree, with 60 digits on the published decimals.
//!
//! `q'' = f(q)` has a tree for each product of derivatives of `f` along `q'` and along values of `f`: a root with `k` bare
//! leaves and branches `t_1 ... t_m` that are trees again, of order
//!
//! ```text
//! rho(t)   = 1 + k + sum_j (rho(t_j) + 1)
//! Phi_i(t) = c_i^k prod_j sum_l a_il Phi_l(t_j),        gamma(t) = rho(t) prod_j (rho(t_j) + 1) gamma(t_j)
//! sum_i b'_i Phi_i(t) = 1/gamma(t)                      for rho(t) <= p
//! sum_i b_i Phi_i(t)  = 1/((rho(t) + 1) gamma(t))       for rho(t) <= p - 1
//! ```
//!
//! (Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I, section II.14, Theorem 14.13.)

use std::collections::BTreeMap;
use std::sync::OnceLock;

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero, pow};

use super::PUBLISHED;

const STAGES: usize = 17;
/// Every published decimal is a multiple of `10^-PLACES`.
const PLACES: usize = 34;
/// Order of the solution.
const ORDER: usize = 12;
/// Digits that weights are kept to: conditions up to order 13 have products of 7 matrices, which are cut there.
const DIGITS: usize = 60;

/// Integers over `10^DIGITS`, one per stage.
type Numerators = [BigInt; STAGES];

/// Decimals are rounded at the 30th digit, some are larger than ten and add up.
fn rounding_of_the_publication() -> BigRational {
    BigRational::new(BigInt::one(), ten_to(26))
}

/// A condition that does not hold misses by more than this; between the two lies nothing.
fn clearly_violated() -> BigRational {
    BigRational::new(BigInt::one(), ten_to(9))
}

fn ten_to(power: usize) -> BigInt {
    pow(BigInt::from(10), power)
}

/// A product of two numbers over `10^DIGITS`, cut to the same denominator: an error below `10^-DIGITS`.
fn times(a: &BigInt, b: &BigInt) -> BigInt {
    a * b / ten_to(DIGITS)
}

fn dot(a: &Numerators, b: &Numerators) -> BigInt {
    a.iter().zip(b).filter(|(a, _)| !a.is_zero()).map(|(a, b)| a * b).sum::<BigInt>() / ten_to(DIGITS)
}

/// A tree: bare leaves, and the sorted list of its branches.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord)]
struct Tree {
    leaves: usize,
    branches: Vec<Tree>,
}

impl Tree {
    fn order(&self) -> usize {
        1 + self.leaves + self.branches.iter().map(|branch| branch.order() + 1).sum::<usize>()
    }

    fn density(&self) -> usize {
        self.order() * self.branches.iter().map(|t| (t.order() + 1) * t.density()).product::<usize>()
    }
}

/// A tree with its weights, and with `sum_l a_il Phi_l(t)` for trees that have it as a branch.
struct Condition {
    tree: Tree,
    weights: Numerators,
    as_branch: Numerators,
}

/// All trees up to order 13, by order less one.
fn conditions() -> &'static [Vec<Condition>] {
    static CONDITIONS: OnceLock<Vec<Vec<Condition>>> = OnceLock::new();
    CONDITIONS.get_or_init(|| {
        let (matrix, nodes) = (matrix(), row("NODES"));
        let condition = |tree: Tree, weights: Numerators| {
            let as_branch = std::array::from_fn(|i| dot(&matrix[i], &weights));
            Condition { tree, weights, as_branch }
        };
        let bare = Tree { leaves: 0, branches: Vec::new() };
        let mut found = vec![vec![condition(bare, std::array::from_fn(|_| ten_to(DIGITS)))]];
        for order in 2..=ORDER + 1 {
            // A leaf or a branch more at the root of a smaller tree gives every tree, some several times.
            let mut larger: BTreeMap<Tree, Numerators> = BTreeMap::new();
            for stem in &found[order - 2] {
                let tree = Tree { leaves: stem.tree.leaves + 1, ..stem.tree.clone() };
                larger.insert(tree, std::array::from_fn(|i| times(&stem.weights[i], &nodes[i])));
            }
            for rest in 1..order.saturating_sub(1) {
                for stem in &found[rest - 1] {
                    for branch in &found[order - rest - 2] {
                        let mut tree = stem.tree.clone();
                        tree.branches.push(branch.tree.clone());
                        tree.branches.sort();
                        larger.entry(tree).or_insert_with(|| {
                            std::array::from_fn(|i| times(&stem.weights[i], &branch.as_branch[i]))
                        });
                    }
                }
            }
            found.push(larger.into_iter().map(|(tree, weights)| condition(tree, weights)).collect());
        }
        found
    })
}

/// `-1.25e-2` times `10^DIGITS`.
fn numerator(text: &str) -> BigInt {
    let (mantissa, exponent) = text.split_once('e').unwrap_or((text, "0"));
    let (whole, fraction) = mantissa.split_once('.').unwrap();
    let digits: BigInt = format!("{whole}{fraction}").parse().unwrap();
    let exponent: isize = exponent.parse().unwrap();
    let zeros = PLACES.checked_add_signed(exponent).unwrap().checked_sub(fraction.len()).unwrap();
    digits * ten_to(zeros + DIGITS - PLACES)
}

/// A published row.
fn row(name: &str) -> Numerators {
    let (_, pairs) = PUBLISHED.iter().find(|(n, _)| *n == name).unwrap();
    let mut row = std::array::from_fn(|_| BigInt::zero());
    for (stage, value) in *pairs {
        row[stage - 1] = numerator(value);
    }
    row
}

fn matrix() -> [Numerators; STAGES] {
    std::array::from_fn(|i| match i + 1 {
        1 => std::array::from_fn(|_| BigInt::zero()),
        stage => row(&format!("A{stage}")),
    })
}

/// The largest of `|sum_i w_i Phi_i(t) - value(t)|` over the trees of an order.
fn residual(order: usize, weights: &Numerators, value: impl Fn(&Tree) -> BigRational) -> BigRational {
    let defect = |condition: &Condition| {
        (BigRational::new(dot(weights, &condition.weights), ten_to(DIGITS)) - value(&condition.tree)).abs()
    };
    conditions()[order - 1].iter().map(defect).max().unwrap()
}

/// Positions and momenta have an order, and no higher one.
fn assert_order(order: usize, position: &str, momentum: &str) {
    let over = |n: usize| BigRational::new(BigInt::one(), BigInt::from(n));
    let (position, momentum) = (row(position), row(momentum));
    for (what, weights, last, positions) in
        [("positions", position, order - 1, true), ("momenta", momentum, order, false)]
    {
        let value = |t: &Tree| over(t.density() * if positions { t.order() + 1 } else { 1 });
        for trees in 1..=last {
            let residual = residual(trees, &weights, value);
            assert!(residual < rounding_of_the_publication(), "{what}, order {trees}: {residual}");
        }
        assert!(residual(last + 1, &weights, value) > clearly_violated(), "{what}: a higher order");
    }
}

#[test]
fn numbers_of_trees() {
    let counts: Vec<usize> = conditions().iter().map(Vec::len).collect();
    // Hairer, Norsett, Wanner, Table II.14.3.
    assert_eq!(counts[..8], [1, 1, 2, 3, 6, 10, 20, 36]);
}

#[test]
fn nodes_are_row_sums() {
    // sum_j a_ij = c_i^2/2.
    for (row, node) in matrix().iter().zip(&row("NODES")) {
        let defect: BigInt = row.iter().sum::<BigInt>() * 2 - times(node, node);
        assert!(BigRational::new(defect.abs(), ten_to(DIGITS)) < rounding_of_the_publication());
    }
}

#[test]
fn solution_has_order_12() {
    assert_order(12, "POSITION", "MOMENTUM");
}

#[test]
fn embedded_solution_has_order_10() {
    assert_order(10, "EMBEDDED_POSITION", "EMBEDDED_MOMENTUM");
}
