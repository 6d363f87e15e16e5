//! Symmetric forms as sums of squares (Lagrange; `L D L^T`).

use super::arena::Arena;
use super::polynomial::Polynomial;
use super::rational::Rational;
use super::ring::scalar;

/// Weights `d_k` and rows of linear forms `l_k` with `F = sum over k of d_k l_k^T l_k`, as many as the rank; `None` where a
/// pivot has no reciprocal.
///
/// Pivots are chosen among all entries, as by Bunch and Parlett (SIAM J. Numer. Anal. 8 (1971) 639-655), so that small ones do
/// not make large squares that nearly cancel; a product `y_i y_j` is a difference of two squares.
pub fn completed(
    arena: &mut Arena,
    mut form: Vec<Vec<Polynomial>>,
) -> Option<Vec<(Polynomial, Vec<Polynomial>)>> {
    let size = form.len();
    let mut rows = scalar(size, &Polynomial::constant(Rational::ONE));
    let mut open: Vec<usize> = (0..size).collect();
    let mut squares = Vec::new();
    while let Some(k) = pivot(&mut form, &mut rows, &open) {
        open.retain(|other| *other != k);
        let weight = form[k][k].clone();
        let reciprocal = weight.expression(arena);
        let reciprocal = arena.pow(reciprocal, -1)?;
        let reciprocal = Polynomial::normal_form(arena, reciprocal);
        let factors: Vec<(usize, Polynomial)> =
            open.iter().map(|j| (*j, form[k][*j].mul(&reciprocal))).filter(|(_, f)| !f.is_zero()).collect();
        for (j, factor) in &factors {
            for l in &open {
                let less = factor.mul(&form[k][*l]);
                form[*j][*l].add_scaled(&less, &Rational::MINUS_ONE);
            }
            let more: Vec<Polynomial> = rows[*j].iter().map(|c| c.mul(factor)).collect();
            rows[k].iter_mut().zip(&more).for_each(|(c, more)| c.add_scaled(more, &Rational::ONE));
        }
        squares.push((weight, rows[k].clone()));
    }
    Some(squares)
}

/// Least size of a square beside a product: the quotient of Bunch and Parlett, `(1 + sqrt 17)/8`, as 16/25.
const ENOUGH: [i64; 2] = [16, 25];

/// The place of the largest square; where the largest product is much larger, that of the sum of its factors, made a
/// coordinate. `None` where nothing is left.
fn pivot(form: &mut [Vec<Polynomial>], rows: &mut [Vec<Polynomial>], open: &[usize]) -> Option<usize> {
    let pairs = open.iter().flat_map(|i| open.iter().map(move |j| (*i, *j)));
    let sizes = pairs.map(|(i, j)| ((i, j), size(&form[i][j]))).filter(|(_, size)| !size.is_zero());
    let (squares, products): (Vec<_>, Vec<_>) = sizes.partition(|((i, j), _)| i == j);
    // The first of equals: nothing but the form decides.
    let largest = |list: Vec<((usize, usize), Rational)>| {
        list.into_iter().reduce(|most, next| if next.1 > most.1 { next } else { most })
    };
    let (square, product) = (largest(squares), largest(products));
    let Some(((i, j), product)) = product else { return square.map(|((k, _), _)| k) };
    let [above, below] = ENOUGH.map(Rational::from);
    if let Some(((k, _), square)) = square
        && &square * &below >= &product * &above
    {
        return Some(k);
    }
    // y_i = (u + v)/2 and y_j = (u - v)/2, in the rows and in the columns of the form.
    let half = Rational::HALF;
    for _ in 0..2 {
        mix(form, (i, j), &half);
        transpose(form);
    }
    mix(rows, (i, j), &Rational::ONE);
    Some(i)
}

/// The size of a number; of what is no rational number, that of one.
fn size(entry: &Polynomial) -> Rational {
    entry.as_constant().map_or(Rational::ONE, |number| number.abs())
}

/// Rows `i` and `j` become `w` times their sum and their difference.
fn mix(rows: &mut [Vec<Polynomial>], (i, j): (usize, usize), weight: &Rational) {
    for c in 0..rows[i].len() {
        let (one, other) = (rows[i][c].scaled(weight), rows[j][c].scaled(weight));
        (rows[i][c], rows[j][c]) = (one.clone(), one);
        rows[i][c].add_scaled(&other, &Rational::ONE);
        rows[j][c].add_scaled(&other, &Rational::MINUS_ONE);
    }
}

fn transpose(rows: &mut [Vec<Polynomial>]) {
    for i in 0..rows.len() {
        for j in 0..i {
            let lower = rows[i][j].clone();
            rows[i][j] = std::mem::replace(&mut rows[j][i], lower);
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::completed;
    use crate::algebra::{Arena, Polynomial, Rational};

    /// Small integers, a third of them zero, from a linear congruence.
    fn next(state: &mut u64) -> Rational {
        *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let value = i64::try_from((*state >> 33) % 9).unwrap() - 4;
        if value.rem_euclid(3) == 0 { Rational::ZERO } else { Rational::from(value) }
    }

    /// A weight that no double holds is a weight.
    #[test]
    fn no_square_is_too_small() {
        let tiny = Rational::from(10).pow(-400).unwrap();
        let entry = |number: Rational| Polynomial::constant(number);
        let zero = Polynomial::zero;
        let form = vec![vec![entry(tiny.clone()), zero()], vec![zero(), entry(Rational::ONE)]];
        let squares = completed(&mut Arena::new(), form).unwrap();
        let weights: Vec<_> = squares.into_iter().map(|(weight, _)| weight.as_constant().unwrap()).collect();
        assert_eq!(weights, [Rational::ONE, tiny]);
    }

    #[test]
    fn squares_add_up_to_the_form() {
        let (mut arena, mut state, mut indefinite) = (Arena::new(), 1, 0);
        for trial in 0..300 {
            let size = 1 + trial % 6;
            let mut form = vec![vec![Polynomial::zero(); size]; size];
            for i in 0..size {
                // Every third form has nothing but products.
                for j in 0..i + usize::from(trial % 3 != 0) {
                    let entry = Polynomial::constant(next(&mut state));
                    (form[i][j], form[j][i]) = (entry.clone(), entry);
                }
            }
            let Some(squares) = completed(&mut arena, form.clone()) else { continue };
            indefinite += usize::from(form[0][0].is_zero());
            for i in 0..size {
                for j in 0..size {
                    let sum: Polynomial =
                        squares.iter().map(|(weight, row)| row[i].mul(&row[j]).mul(weight)).sum();
                    assert_eq!(sum, form[i][j], "{form:?}");
                }
            }
        }
        assert!(indefinite > 20, "{indefinite}");
    }
}
