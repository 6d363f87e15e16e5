//! Rational bases in which metrics are diagonal, and the roots that normalise them.

use num_bigint::BigInt;
use num_traits::Zero;

use crate::algebra::linear;
use crate::algebra::ring::upper;
use crate::algebra::root::root;
use crate::algebra::{Polynomial, Rational};

/// `g = U^T diag(d) U` with a unit upper triangular `U` (Cholesky without roots): the rows of `U` are the coordinates in a
/// basis whose vectors are orthogonal and have the squared lengths `d`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Axes {
    /// `U`.
    pub matrix: Vec<Vec<Rational>>,
    /// `U^-1`.
    pub inverse: Vec<Vec<Rational>>,
    /// `d`.
    pub squares: Vec<Rational>,
}

impl Axes {
    /// `d_k = g_kk - sum over i < k of d_i U_ik^2`, `U_kj = (g_kj - sum over i < k of d_i U_ik U_ij)/d_k`; `None` unless
    /// every `d_k` is positive.
    pub fn of(metric: &[Vec<Rational>]) -> Option<Self> {
        let n = metric.len();
        let mut matrix = vec![vec![Rational::ZERO; n]; n];
        let mut squares: Vec<Rational> = Vec::new();
        for k in 0..n {
            let rest = |matrix: &[Vec<Rational>], j: usize| {
                (0..k).fold(metric[k][j].clone(), |sum, i| {
                    &sum - &(&squares[i] * &(&matrix[i][k] * &matrix[i][j]))
                })
            };
            let pivot = rest(&matrix, k);
            if pivot.is_negative() || pivot.is_zero() {
                return None;
            }
            for j in k + 1..n {
                matrix[k][j] = rest(&matrix, j).checked_div(&pivot)?;
            }
            matrix[k][k] = Rational::ONE;
            squares.push(pivot);
        }
        let inverse = linear::inverse(&matrix)?;
        Some(Self { matrix, inverse, squares })
    }

    /// The same places with 1 for every entry of `U` and `U^-1` that can differ from zero, where only the zeros of the
    /// metric are known.
    pub fn pattern(metric: &[Vec<Polynomial>]) -> Self {
        let n = metric.len();
        let mut filled = vec![vec![false; n]; n];
        for (k, j) in upper(n) {
            filled[k][j] = k == j || !metric[k][j].is_zero() || (0..k).any(|i| filled[i][k] && filled[i][j]);
        }
        // U^-1 is a sum of products of entries above the diagonal.
        let mut inverse = filled.clone();
        for (k, i, j) in (0..n).flat_map(|k| (0..n).flat_map(move |i| (0..n).map(move |j| (k, i, j)))) {
            inverse[i][j] |= inverse[i][k] && inverse[k][j];
        }
        let ones = |places: Vec<Vec<bool>>| {
            let one = |filled: bool| if filled { Rational::ONE } else { Rational::ZERO };
            places.into_iter().map(|row| row.into_iter().map(one).collect()).collect()
        };
        Self { matrix: ones(filled), inverse: ones(inverse), squares: vec![Rational::ONE; n] }
    }
}

/// `sqrt(product over k of d_k^e_k)`, exact where it is rational, to more than a double-double otherwise. Equal powers
/// of equal roots are equal numbers: even exponents leave the root, and of the rest the squares of small primes do.
pub fn root_of_product(squares: &[&Rational], exponents: &[i32]) -> Option<Rational> {
    let (mut outside, mut inside) = (Rational::ONE, Rational::ONE);
    for (square, exponent) in squares.iter().zip(exponents) {
        outside = &outside * &square.pow(exponent.div_euclid(2))?;
        if exponent.rem_euclid(2) == 1 {
            inside = &inside * square;
        }
    }
    // sqrt(p/q) = sqrt(p q)/q.
    let (numerator, denominator) = inside.parts();
    let (square, rest) = without_squares(&numerator * &denominator);
    let one = BigInt::from(1);
    let outside = &outside * &Rational::quotient(square, denominator)?;
    Some(&outside * &root(&Rational::quotient(rest, one)?)?)
}

/// The largest prime whose squares are looked for.
const LARGEST: u32 = 1000;

/// `s` and `r` with `value = s^2 r`, where no square of a small number divides `r`.
fn without_squares(value: BigInt) -> (BigInt, BigInt) {
    let (mut square, mut rest) = (BigInt::from(1), value);
    for factor in 2..=LARGEST {
        let twice = BigInt::from(u64::from(factor) * u64::from(factor));
        while (&rest % &twice).is_zero() {
            rest /= &twice;
            square *= factor;
        }
    }
    (square, rest)
}
