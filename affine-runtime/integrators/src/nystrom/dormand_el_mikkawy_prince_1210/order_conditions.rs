//! The order conditions of Nystrom methods, one per tree, with 60 digits on the published decimals.

use std::sync::OnceLock;

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero, pow};

use super::PUBLISHED;
use crate::nystrom::trees::{self, Condition, Method, Tree};

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

/// The method in these numbers.
struct Published {
    matrix: [Numerators; STAGES],
}

impl Method<Numerators> for Published {
    fn ones(&self) -> Numerators {
        std::array::from_fn(|_| ten_to(DIGITS))
    }
    fn nodes(&self) -> Numerators {
        row("NODES")
    }
    fn product(&self, a: &Numerators, b: &Numerators) -> Numerators {
        std::array::from_fn(|i| times(&a[i], &b[i]))
    }
    fn through(&self, weights: &Numerators) -> Numerators {
        std::array::from_fn(|i| dot(&self.matrix[i], weights))
    }
}

/// All trees up to order 13, by order less one.
fn conditions() -> &'static [Vec<Condition<Numerators>>] {
    static CONDITIONS: OnceLock<Vec<Vec<Condition<Numerators>>>> = OnceLock::new();
    CONDITIONS.get_or_init(|| trees::conditions(&Published { matrix: matrix() }, ORDER + 1))
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
    let defect = |condition: &Condition<Numerators>| {
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
