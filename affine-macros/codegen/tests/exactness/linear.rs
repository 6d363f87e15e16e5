//! Exact linear algebra against determinants and signs of minors.

use affine_codegen::algebra::Rational;
use affine_codegen::algebra::linear::{Square, inertia, inverse};
use affine_oracle::{Matrix, Random, rational};
use num_traits::{Signed, Zero};

use super::models::symmetric;
use super::points::{fraction, own};

fn square(matrix: &Matrix) -> Square {
    let n = matrix.shape().0;
    (0..n).map(|i| (0..n).map(|j| own(&matrix.entry(i, j))).collect()).collect()
}

fn times(a: &Square, b: &[Vec<Rational>]) -> Square {
    let dot = |row: &Vec<Rational>, j: usize| {
        row.iter().zip(b).fold(Rational::ZERO, |sum, (left, right)| &sum + &(left * &right[j]))
    };
    a.iter().map(|row| (0..b[0].len()).map(|j| dot(row, j)).collect()).collect()
}

fn identity(n: usize) -> Square {
    square(&Matrix::identity(n))
}

/// A symmetric matrix with zero diagonal: no pivot without a change of basis.
fn hollow(random: &mut Random, size: usize) -> Matrix {
    let full = symmetric(random, size);
    let entries: Vec<_> = (0..size * size)
        .map(|k| if k % (size + 1) == 0 { rational(0, 1) } else { full.entry(k / size, k % size) })
        .collect();
    Matrix::from_rationals(size, size, &entries)
}

/// `G^T diag G` of low rank.
fn degenerate(random: &mut Random, size: usize, rank: usize) -> Matrix {
    let g: Vec<_> = (0..rank * size).map(|_| fraction(random)).collect();
    let g = Matrix::from_rationals(rank, size, &g);
    let mut d = vec![rational(0, 1); rank * rank];
    (0..rank).for_each(|k| d[k * (rank + 1)] = fraction(random));
    &(&g.transpose() * &Matrix::from_rationals(rank, rank, &d)) * &g
}

#[test]
fn inverses() {
    let mut random = Random::new(41);
    let mut singular = 0;
    for size in 1..=9 {
        for k in 0..6 {
            let entries: Vec<_> = (0..size * size)
                .map(|_| if random.integer(0, 3) == 0 { rational(0, 1) } else { fraction(&mut random) })
                .collect();
            let matrix = match k {
                0 => hollow(&mut random, size),
                1 if size > 1 => degenerate(&mut random, size, size - 1),
                _ => Matrix::from_rationals(size, size, &entries),
            };
            let own = square(&matrix);
            match inverse(&own) {
                None => {
                    singular += 1;
                    assert!(matrix.determinant().is_zero());
                }
                Some(inverse) => {
                    assert_eq!(times(&own, &inverse), identity(size));
                    assert_eq!(times(&inverse, &own), identity(size));
                }
            }
        }
    }
    assert!(singular >= 8);
}

/// Jacobi: where no leading minor vanishes, the negative squares are the changes of sign in their sequence.
fn by_minors(matrix: &Matrix) -> Option<(usize, usize)> {
    let size = matrix.shape().0;
    let (mut count, mut previous) = ((0, 0), rational(1, 1));
    for k in 1..=size {
        let entries: Vec<_> = (0..k * k).map(|place| matrix.entry(place / k, place % k)).collect();
        let minor = Matrix::from_rationals(k, k, &entries).determinant();
        if minor.is_zero() {
            return None;
        }
        if minor.is_negative() == previous.is_negative() {
            count.0 += 1
        } else {
            count.1 += 1
        }
        previous = minor;
    }
    Some(count)
}

#[test]
fn inertia_is_sylvesters() {
    let mut random = Random::new(42);
    let (mut by_minor, mut without_pivot, mut indefinite) = (0, 0, 0);
    for size in 1..=9 {
        for k in 0..10 {
            let matrix = if k < 4 { hollow(&mut random, size) } else { symmetric(&mut random, size) };
            let found = inertia(&square(&matrix));
            let expected = matrix.signature();
            if expected.zero > 0 {
                in_the_kernel(&square(&matrix), found.kernel);
                continue;
            }
            assert_eq!(found.kernel, None);
            assert_eq!((found.positive, found.negative), (expected.positive, expected.negative));
            indefinite += usize::from(found.positive > 0 && found.negative > 0);
            match by_minors(&matrix) {
                Some(minors) => {
                    by_minor += 1;
                    assert_eq!((found.positive, found.negative), minors);
                }
                None => without_pivot += 1,
            }
        }
    }
    assert!(by_minor > 20 && without_pivot > 10 && indefinite > 20);
}

/// Neither the kernel of a form nor its inertia depends on the order of the coordinates or on their basis.
#[test]
fn degenerate_forms_show_their_kernel() {
    let mut random = Random::new(43);
    for size in 2..=9 {
        for rank in 0..size {
            let matrix =
                if rank == 0 { Matrix::zeros(size, size) } else { degenerate(&mut random, size, rank) };
            let form = square(&matrix);
            in_the_kernel(&form, inertia(&form).kernel);
        }
    }
}

fn in_the_kernel(form: &Square, kernel: Option<Vec<Rational>>) {
    let kernel = kernel.expect("a kernel");
    assert!(kernel.iter().any(|entry| !entry.is_zero()));
    let column: Square = kernel.into_iter().map(|entry| vec![entry]).collect();
    assert!(times(form, &column).concat().iter().all(Rational::is_zero));
}
