//! The order conditions in exact rational arithmetic on the published decimals.
//!
//! A symmetric step of order 2 is the flow of `h A_1 + h^3 A_3 + h^5 A_5 + ...` with operators that do not commute. The
//! composition is of order `p` where the product of the exponentials with `w_i h` for `h` agrees with `exp(h A_1)` up to
//! `h^p`: where the coefficient of every word in `A_1, A_3, A_5, A_7` of weight at most `p` is that of the exponential,
//! `1/k!` for `A_1^k` and 0 for the rest (Hairer, Lubich, Wanner, section III.3.3, where Lie series are formed from the
//! same).

use std::collections::BTreeMap;

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero, pow};

use super::Composition;

/// Words of letters 1, 3, 5, 7 with their coefficients, up to a weight.
type Series = BTreeMap<Vec<usize>, BigRational>;

/// Decimals as published, of `w_1` to the middle; none for the methods given by formulas.
const PUBLISHED_SIX: [&str; 5] = [
    "0.39216144400731413927925056",
    "0.33259913678935943859974864",
    "-0.70624617255763935980996482",
    "0.08221359629355080023149045",
    "0.79854399093482996339895035",
];
const PUBLISHED_EIGHT: [&str; 9] = [
    "0.13020248308889008087881763",
    "0.56116298177510838456196441",
    "-0.38947496264484728640807860",
    "0.15884190655515560089621075",
    "-0.39590389413323757733623154",
    "0.18453964097831570709183254",
    "0.25837438768632204729397911",
    "0.29501172360931029887096624",
    "-0.60550853383003451169892108",
];

fn decimal(text: &str) -> BigRational {
    let (sign, digits) = text.strip_prefix('-').map_or((1, text), |rest| (-1, rest));
    let (whole, part) = digits.split_once('.').unwrap();
    let numerator: BigInt = format!("{whole}{part}").parse().unwrap();
    BigRational::new(numerator * sign, pow(BigInt::from(10), part.len()))
}

fn product(a: &Series, b: &Series, weight: usize) -> Series {
    let mut product = Series::new();
    for (left, x) in a {
        for (right, y) in b {
            let word: Vec<usize> = left.iter().chain(right).copied().collect();
            if word.iter().sum::<usize>() <= weight {
                *product.entry(word).or_insert_with(BigRational::zero) += x * y;
            }
        }
    }
    product
}

/// `exp(sum_k w^k A_k)`, `k` odd.
fn step(w: &BigRational, weight: usize) -> Series {
    let exponent: Series = (1..=weight).step_by(2).map(|k| (vec![k], pow(w.clone(), k))).collect();
    let mut term = Series::from([(Vec::new(), BigRational::one())]);
    let mut sum = term.clone();
    for k in 1..=weight {
        term = product(&term, &exponent, weight);
        for value in term.values_mut() {
            *value /= BigRational::from_integer(BigInt::from(k));
        }
        for (word, value) in &term {
            *sum.entry(word.clone()).or_insert_with(BigRational::zero) += value;
        }
    }
    sum
}

/// Largest defect among the conditions of each weight from 1 on.
fn defects(half: &[BigRational], weight: usize) -> Vec<BigRational> {
    let mut composed = Series::from([(Vec::new(), BigRational::one())]);
    for w in half.iter().chain(half.iter().rev().skip(1)) {
        composed = product(&composed, &step(w, weight), weight);
    }
    let exact = {
        let only = |word: &[usize]| word.iter().all(|k| *k == 1);
        move |word: &[usize]| {
            let factorial = (1..=word.len()).map(BigInt::from).product::<BigInt>();
            if only(word) { BigRational::new(BigInt::one(), factorial) } else { BigRational::zero() }
        }
    };
    let mut largest = vec![BigRational::zero(); weight];
    for (word, value) in composed.iter().filter(|(word, _)| !word.is_empty()) {
        let defect = (value - exact(word)).abs();
        let slot = &mut largest[word.iter().sum::<usize>() - 1];
        if defect > *slot {
            *slot = defect;
        }
    }
    largest
}

/// Orders are as stated and not higher; decimals are rounded at the 26th digit.
fn check(order: usize, half: &[BigRational]) {
    let rounding = BigRational::new(BigInt::one(), pow(BigInt::from(10), 23));
    let visible = BigRational::new(BigInt::one(), pow(BigInt::from(10), 6));
    let defects = defects(half, order + 1);
    for (k, defect) in defects.iter().enumerate() {
        if k < order {
            assert!(*defect < rounding, "weight {}", k + 1);
        } else {
            assert!(*defect > visible, "weight {}", k + 1);
        }
    }
}

fn check_stored(composition: &Composition, half: &[BigRational]) {
    for (stored, published) in composition.weights().zip(half) {
        let stored = BigRational::from_float(stored).unwrap();
        // Half a rounding of numbers below 1; the one in the middle is a difference of such.
        assert!((stored - published).abs() < BigRational::from_float(1e-15).unwrap());
    }
    assert_eq!(composition.steps(), 2 * half.len() - 1);
    assert!((composition.weights().sum::<f64>() - 1.0).abs() < 4.0 * f64::EPSILON);
}

#[test]
fn order_2_and_4() {
    check(2, &[BigRational::one()]);
    // 4^(1/3) to 40 digits.
    let root = decimal("1.5874010519681994747517056392723082603915");
    let four = BigRational::from_integer(BigInt::from(4));
    let outer = (four.clone() - root).recip();
    let half = [outer.clone(), outer.clone(), BigRational::one() - four * outer];
    check(4, &half);
    check_stored(Composition::of_order(4).unwrap(), &half);
}

#[test]
fn order_6() {
    let half = PUBLISHED_SIX.map(decimal);
    check(6, &half);
    check_stored(Composition::of_order(6).unwrap(), &half);
}

#[test]
fn order_8() {
    let half = PUBLISHED_EIGHT.map(decimal);
    check(8, &half);
    check_stored(Composition::of_order(8).unwrap(), &half);
}
