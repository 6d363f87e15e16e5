//! Exact matrices with one common denominator.

use std::ops::{Add, Mul, Sub};

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use crate::error::Error;
use crate::ring::{Dual, Ring, common_multiple, exact, gcd, rounded};

/// A matrix of rational numbers `numerators[i][j]/denominator`, row-major; scalars are `1 x 1`, vectors `n x 1`.
///
/// Over [`Dual`] the matrix carries its derivative in one direction.
///
/// # Panics
/// Sums and products of matrices whose shapes do not fit panic, as does an index out of range.
#[derive(Clone, Debug)]
pub struct Matrix<R = BigInt> {
    rows: usize,
    columns: usize,
    numerators: Vec<R>,
    denominator: BigInt,
}

impl<R: Ring> Matrix<R> {
    /// The matrix of `rows x columns` integer numerators over a positive denominator. Common powers of two are
    /// taken out: with coordinates from `f64` they are most of what could be cancelled, and cost nothing to find.
    pub(crate) fn new(rows: usize, columns: usize, numerators: Vec<R>, denominator: BigInt) -> Self {
        assert_eq!(numerators.len(), rows * columns, "{rows} x {columns} matrix");
        let mut common = denominator.trailing_zeros().unwrap_or(0);
        for twos in numerators.iter().filter_map(Ring::twos) {
            common = common.min(twos);
        }
        if common == 0 {
            return Self { rows, columns, numerators, denominator };
        }
        let numerators = numerators.iter().map(|number| number.halved(common)).collect();
        Self { rows, columns, numerators, denominator: denominator >> common }
    }

    /// Rows and columns.
    pub fn shape(&self) -> (usize, usize) {
        (self.rows, self.columns)
    }

    /// The same constants in the ring `R`.
    pub fn constant(matrix: &Matrix) -> Self {
        let numerators = matrix.numerators.iter().cloned().map(R::constant).collect();
        Self::new(matrix.rows, matrix.columns, numerators, matrix.denominator.clone())
    }

    /// The zero matrix.
    pub fn zeros(rows: usize, columns: usize) -> Self {
        Self::new(rows, columns, vec![R::constant(BigInt::zero()); rows * columns], BigInt::one())
    }

    /// The same entries, row-major, in another shape.
    ///
    /// # Panics
    /// Where the numbers of entries differ.
    pub fn reshaped(self, rows: usize, columns: usize) -> Self {
        Self::new(rows, columns, self.numerators, self.denominator)
    }

    /// The rows `from .. from + count`.
    pub fn rows(&self, from: usize, count: usize) -> Self {
        let range = from * self.columns..(from + count) * self.columns;
        Self::new(count, self.columns, self.numerators[range].to_vec(), self.denominator.clone())
    }

    /// This matrix with the rows of `other` below its own.
    pub fn above(&self, other: &Self) -> Self {
        assert_eq!(self.columns, other.columns, "columns of stacked matrices");
        Self::collected(self.rows + other.rows, self.columns, &[self, other])
    }

    /// The matrix whose row-major entries are those of the parts, one part after the other.
    ///
    /// # Panics
    /// Where the number of entries is not `rows * columns`.
    pub(crate) fn collected(rows: usize, columns: usize, parts: &[&Self]) -> Self {
        let denominator = common_multiple(parts.iter().map(|part| &part.denominator));
        let numerators = parts.iter().flat_map(|part| part.over(&denominator)).collect();
        Self::new(rows, columns, numerators, denominator)
    }

    /// The numerators over a multiple of the denominator.
    fn over(&self, denominator: &BigInt) -> Vec<R> {
        let factor = denominator / &self.denominator;
        if factor.is_one() {
            return self.numerators.clone();
        }
        self.numerators.iter().map(|number| number.scaled(&factor)).collect()
    }

    /// Every entry is exactly 0, derivatives included.
    pub fn is_zero(&self) -> bool {
        self.numerators.iter().all(|number| number.twos().is_none())
    }

    /// `X^T`.
    pub fn transpose(&self) -> Self {
        let places = (0..self.columns).flat_map(|j| (0..self.rows).map(move |i| i * self.columns + j));
        let numerators = places.map(|place| self.numerators[place].clone()).collect();
        Self::new(self.columns, self.rows, numerators, self.denominator.clone())
    }

    /// `tr X`, as a `1 x 1` matrix.
    pub fn trace(&self) -> Self {
        let zero = R::constant(BigInt::zero());
        let diagonal = (0..self.rows).map(|i| &self.numerators[i * self.columns + i]);
        Self::new(1, 1, vec![diagonal.fold(zero, |sum, entry| sum.plus(entry))], self.denominator.clone())
    }

    /// `c X`.
    pub fn scaled(&self, c: &BigRational) -> Self {
        let numerators = self.numerators.iter().map(|number| number.scaled(c.numer())).collect();
        Self::new(self.rows, self.columns, numerators, &self.denominator * c.denom())
    }

    /// `X - X^T`.
    pub fn skew(&self) -> Self {
        self - &self.transpose()
    }

    /// `X - (tr X/n) 1`.
    pub fn deviator(&self) -> Self {
        let trace = self.trace();
        let identity = Matrix::<R>::constant(&Matrix::identity(self.rows));
        let numerators = identity.numerators.iter().map(|entry| entry.times(&trace.numerators[0])).collect();
        let count = BigInt::from(self.rows);
        self - &Self::new(self.rows, self.rows, numerators, trace.denominator * count)
    }

    /// `X^-1 = adj X/det X`; `None` where `det X = 0`. Meant for the small matrices of the body.
    pub fn inverse(&self) -> Option<Self> {
        let n = self.rows;
        let every: Vec<usize> = (0..n).collect();
        let (numerator, denominator) = self.minor(&every, &every).reciprocal()?;
        let mut numerators = Vec::with_capacity(n * n);
        for i in 0..n {
            for j in 0..n {
                let without = |k: usize| every.iter().copied().filter(|&l| l != k).collect::<Vec<_>>();
                let minor = self.minor(&without(j), &without(i));
                let cofactor = if (i + j) % 2 == 0 { minor } else { minor.scaled(&BigInt::from(-1)) };
                numerators.push(cofactor.times(&numerator).scaled(&self.denominator));
            }
        }
        Some(Self::new(n, n, numerators, denominator))
    }

    /// The determinant of the numerators in the given rows and columns, expanded along the first row.
    fn minor(&self, rows: &[usize], columns: &[usize]) -> R {
        let Some((&row, below)) = rows.split_first() else { return R::constant(BigInt::one()) };
        let mut sum = R::constant(BigInt::zero());
        for (position, &column) in columns.iter().enumerate() {
            let others: Vec<usize> = columns.iter().copied().filter(|&other| other != column).collect();
            let part = self.numerators[row * self.columns + column].times(&self.minor(below, &others));
            sum = if position % 2 == 0 { sum.plus(&part) } else { sum.minus(&part) };
        }
        sum
    }

    fn combined(&self, other: &Self, combine: impl Fn(&R, &R) -> R) -> Self {
        assert_eq!(self.shape(), other.shape(), "shapes of a sum");
        let denominator = common_multiple([&self.denominator, &other.denominator].into_iter());
        let (left, right) = (self.over(&denominator), other.over(&denominator));
        let numerators = left.iter().zip(&right).map(|(a, b)| combine(a, b)).collect();
        Self::new(self.rows, self.columns, numerators, denominator)
    }
}

impl Matrix {
    /// The unit matrix.
    pub fn identity(n: usize) -> Self {
        let numerators = (0..n * n).map(|place| BigInt::from(i32::from(place % (n + 1) == 0))).collect();
        Self::new(n, n, numerators, BigInt::one())
    }

    /// The `n x n` matrix with 1 in row `i`, column `j`, and 0 elsewhere.
    pub fn unit(n: usize, i: usize, j: usize) -> Self {
        let numerators = (0..n * n).map(|place| BigInt::from(i32::from(place == i * n + j))).collect();
        Self::new(n, n, numerators, BigInt::one())
    }

    /// The matrix with these row-major entries.
    ///
    /// # Panics
    /// Where the number of entries is not `rows * columns`.
    pub fn from_rationals(rows: usize, columns: usize, entries: &[BigRational]) -> Self {
        let denominator = common_multiple(entries.iter().map(BigRational::denom));
        let numerators = entries.iter().map(|entry| entry.numer() * (&denominator / entry.denom())).collect();
        Self::new(rows, columns, numerators, denominator)
    }

    /// The matrix with these row-major entries, taken exactly.
    ///
    /// # Errors
    /// [`Error::Shape`] where the number of entries is not `rows * columns`, [`Error::NotFinite`] where an entry
    /// is no number; both name the `quantity`.
    pub fn from_f64(
        quantity: &'static str,
        rows: usize,
        columns: usize,
        entries: &[f64],
    ) -> Result<Self, Error> {
        if entries.len() != rows * columns {
            return Err(Error::Shape { quantity, expected: (rows, columns), found: (entries.len(), 1) });
        }
        let entries: Option<Vec<BigRational>> = entries.iter().map(|&entry| exact(entry)).collect();
        Ok(Self::from_rationals(rows, columns, &entries.ok_or(Error::NotFinite { quantity })?))
    }

    /// The entry in row `i`, column `j`, counted from 0.
    pub fn entry(&self, i: usize, j: usize) -> BigRational {
        BigRational::new(self.numerators[i * self.columns + j].clone(), self.denominator.clone())
    }

    /// All entries, row-major.
    pub fn entries(&self) -> Vec<BigRational> {
        let entry = |number: &BigInt| BigRational::new(number.clone(), self.denominator.clone());
        self.numerators.iter().map(entry).collect()
    }

    /// All entries, row-major, each rounded once.
    pub fn to_f64(&self) -> Vec<f64> {
        self.entries().iter().map(rounded).collect()
    }

    /// The same matrix over its least denominator.
    pub(crate) fn reduced(self) -> Self {
        let common = self.numerators.iter().fold(self.denominator.clone(), |common, number| {
            if (number % &common).is_zero() { common } else { gcd(&common, number).abs() }
        });
        let numerators = self.numerators.iter().map(|number| number / &common).collect();
        Self::new(self.rows, self.columns, numerators, self.denominator / common)
    }

    pub(crate) fn numerators(&self) -> &[BigInt] {
        &self.numerators
    }

    pub(crate) fn denominator(&self) -> &BigInt {
        &self.denominator
    }
}

impl Matrix<Dual> {
    /// `value + epsilon slope`.
    pub fn along(value: &Matrix, slope: &Matrix) -> Self {
        assert_eq!(value.shape(), slope.shape(), "shapes of value and slope");
        let denominator = common_multiple([&value.denominator, &slope.denominator].into_iter());
        let parts = value.over(&denominator).into_iter().zip(slope.over(&denominator));
        let numerators = parts.map(|(value, slope)| Dual { value, slope }).collect();
        Self::new(value.rows, value.columns, numerators, denominator)
    }

    /// The part without `epsilon`.
    pub fn value(&self) -> Matrix {
        let numerators = self.numerators.iter().map(|number| number.value.clone()).collect();
        Matrix::new(self.rows, self.columns, numerators, self.denominator.clone())
    }

    /// The coefficient of `epsilon`: the derivative.
    pub fn slope(&self) -> Matrix {
        let numerators = self.numerators.iter().map(|number| number.slope.clone()).collect();
        Matrix::new(self.rows, self.columns, numerators, self.denominator.clone())
    }
}

impl PartialEq for Matrix {
    fn eq(&self, other: &Self) -> bool {
        self.shape() == other.shape() && (self - other).is_zero()
    }
}

impl<R: Ring> Add for &Matrix<R> {
    type Output = Matrix<R>;
    fn add(self, other: Self) -> Matrix<R> {
        self.combined(other, R::plus)
    }
}

impl<R: Ring> Sub for &Matrix<R> {
    type Output = Matrix<R>;
    fn sub(self, other: Self) -> Matrix<R> {
        self.combined(other, R::minus)
    }
}

impl<R: Ring> Mul for &Matrix<R> {
    type Output = Matrix<R>;
    fn mul(self, other: Self) -> Matrix<R> {
        assert_eq!(self.columns, other.rows, "inner dimensions of a product");
        let mut numerators = Vec::with_capacity(self.rows * other.columns);
        for i in 0..self.rows {
            for j in 0..other.columns {
                let zero = R::constant(BigInt::zero());
                numerators.push((0..self.columns).fold(zero, |sum, k| {
                    let left = &self.numerators[i * self.columns + k];
                    sum.plus(&left.times(&other.numerators[k * other.columns + j]))
                }));
            }
        }
        Matrix::new(self.rows, other.columns, numerators, &self.denominator * &other.denominator)
    }
}
