//! Small matrices over any commutative ring: polynomials, and numbers modulo a prime.

use super::evaluate::Field;
use super::fault;
use super::polynomial::Polynomial;
use super::rational::Rational;
use super::residue::Residue;

/// A commutative ring.
pub trait Ring: Clone {
    /// The zero of the ring.
    fn zero() -> Self;
    /// The ring element of an exact number.
    fn number(value: &Rational) -> Self;
    /// Not proved to be different from 0?
    fn vanishes(&self) -> bool;
    /// Adds `weight * a * b`.
    fn plus_product(&mut self, a: &Self, b: &Self, weight: &Rational);
    /// Adds `weight * a`.
    fn plus(&mut self, a: &Self, weight: &Rational);
}

impl Ring for Polynomial {
    fn zero() -> Self {
        Polynomial::zero()
    }
    fn number(value: &Rational) -> Self {
        Polynomial::constant(value.clone())
    }
    fn vanishes(&self) -> bool {
        self.is_zero()
    }
    fn plus_product(&mut self, a: &Self, b: &Self, weight: &Rational) {
        self.add_product(a, b, weight);
    }
    fn plus(&mut self, a: &Self, weight: &Rational) {
        self.add_scaled(a, weight);
    }
}

impl Ring for Residue {
    fn zero() -> Self {
        Residue::ZERO
    }
    fn number(value: &Rational) -> Self {
        Residue::from_rational(value)
    }
    fn vanishes(&self) -> bool {
        !self.is_nonzero()
    }
    fn plus_product(&mut self, a: &Self, b: &Self, weight: &Rational) {
        self.plus(&a.mul(b), weight);
    }
    fn plus(&mut self, a: &Self, weight: &Rational) {
        *self = match weight.is_one() {
            true => self.add(a),
            false => self.add(&a.mul(&Residue::from_rational(weight))),
        };
    }
}

/// A square matrix, row after row.
pub type Square<R> = Vec<Vec<R>>;

/// The matrix with the given entries.
pub fn table<R>(n: usize, mut entry: impl FnMut(usize, usize) -> R) -> Square<R> {
    (0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect()
}

/// `value 1`.
pub fn scalar<R: Ring>(n: usize, value: &R) -> Square<R> {
    table(n, |i, j| if i == j { value.clone() } else { R::zero() })
}

/// All places of a square matrix, row after row.
pub fn pairs(n: usize) -> impl Iterator<Item = (usize, usize)> + Clone {
    (0..n).flat_map(move |a| (0..n).map(move |b| (a, b)))
}

/// The places on and above its diagonal.
pub fn upper(n: usize) -> impl Iterator<Item = (usize, usize)> + Clone {
    (0..n).flat_map(move |a| (a..n).map(move |b| (a, b)))
}

/// The places above its diagonal.
pub fn above_diagonal(n: usize) -> impl Iterator<Item = (usize, usize)> + Clone {
    (0..n).flat_map(move |a| (a + 1..n).map(move |b| (a, b)))
}

/// The sum of products `a b`.
pub fn dot<'r, R: Ring + 'r>(factors: impl IntoIterator<Item = (&'r R, &'r R)>) -> R {
    let mut sum = R::zero();
    factors.into_iter().for_each(|(a, b)| sum.plus_product(a, b, &Rational::ONE));
    sum
}

/// `a b`.
pub fn product<R: Ring>(a: &Square<R>, b: &Square<R>) -> Square<R> {
    table(a.len(), |i, j| dot(a[i].iter().zip(b.iter().map(|row| &row[j]))))
}

/// `a + b`.
pub fn sum<R: Ring>(a: &Square<R>, b: &Square<R>) -> Square<R> {
    table(a.len(), |i, j| combined(&a[i][j], &b[i][j], &Rational::ONE))
}

/// `factor m`.
pub fn multiple<R: Ring>(m: &Square<R>, factor: &R) -> Square<R> {
    table(m.len(), |i, j| dot([(&m[i][j], factor)]))
}

/// Adds `factor m`.
pub fn add_multiple<R: Ring>(sum: &mut Square<R>, factor: &R, m: &Square<R>) {
    pairs(m.len()).for_each(|(i, j)| sum[i][j].plus_product(factor, &m[i][j], &Rational::ONE));
}

/// Adds `factor 1`.
pub fn add_scalar<R: Ring>(sum: &mut Square<R>, factor: &R) {
    (0..sum.len()).for_each(|i| sum[i][i].plus(factor, &Rational::ONE));
}

/// `a + weight b`.
fn combined<R: Ring>(a: &R, b: &R, weight: &Rational) -> R {
    let mut value = a.clone();
    value.plus(b, weight);
    value
}

/// Entries above the diagonal of `m - m^T`.
pub fn skew<R: Ring>(m: &Square<R>) -> Vec<R> {
    above_diagonal(m.len()).map(|(a, b)| combined(&m[a][b], &m[b][a], &Rational::MINUS_ONE)).collect()
}

/// `tr m`.
pub fn trace<R: Ring>(m: &Square<R>) -> R {
    let mut sum = R::zero();
    (0..m.len()).for_each(|a| sum.plus(&m[a][a], &Rational::ONE));
    sum
}

/// `tr(a b)`.
pub fn trace_of_product<R: Ring>(a: &Square<R>, b: &Square<R>) -> R {
    dot(pairs(a.len()).map(|(i, j)| (&a[i][j], &b[j][i])))
}

/// `m - (tr m / n) 1`.
pub fn deviator<R: Ring>(m: &Square<R>) -> Square<R> {
    let (trace, nth) = (trace(m), -&Rational::one_over(m.len()));
    table(m.len(), |i, j| {
        let mut value = m[i][j].clone();
        if i == j {
            value.plus(&trace, &nth);
        }
        value
    })
}

/// The transposed cofactors: `m adjugate(m) = det m`.
pub fn adjugate<R: Ring>(m: &Square<R>) -> Square<R> {
    let n = m.len();
    table(n, |i, j| {
        let rows: Vec<usize> = (0..n).filter(|r| *r != j).collect();
        let columns: Vec<usize> = (0..n).filter(|c| *c != i).collect();
        let sign = if (i + j) % 2 == 0 { Rational::ONE } else { Rational::MINUS_ONE };
        let mut minor = R::zero();
        match (rows.as_slice(), columns.as_slice()) {
            ([r], [c]) => minor.plus(&m[*r][*c], &sign),
            ([r, s], [c, d]) => {
                minor.plus_product(&m[*r][*c], &m[*s][*d], &sign);
                minor.plus_product(&m[*r][*d], &m[*s][*c], &-&sign);
            }
            _ => fault::record("a matrix has two or three rows"),
        }
        minor
    })
}

/// The determinant, expanded along the first row.
pub fn determinant<R: Ring>(m: &Square<R>) -> R {
    dot(m[0].iter().zip(adjugate(m).iter().map(|row| &row[0])))
}

/// The rows that a symmetric matrix connects by entries other than zero.
pub fn components<R: Ring>(matrix: &Square<R>) -> Vec<Vec<usize>> {
    let size = matrix.len();
    let mut component: Vec<usize> = (0..size).collect();
    for (j, i) in above_diagonal(size).filter(|(j, i)| !matrix[*i][*j].vanishes()) {
        let (keep, drop) = (component[i].min(component[j]), component[i].max(component[j]));
        component.iter_mut().filter(|c| **c == drop).for_each(|c| *c = keep);
    }
    let members = (0..size).map(|root| (0..size).filter(|i| component[*i] == root).collect::<Vec<_>>());
    members.filter(|members| !members.is_empty()).collect()
}

/// The bilinear form of a matrix at two vectors, which are given by their entries other than zero.
pub fn pairing<R: Ring>(matrix: &Square<R>, a: &[(usize, Rational)], b: &[(usize, Rational)]) -> R {
    let mut sum = R::zero();
    for (k, wk) in a {
        b.iter().for_each(|(l, wl)| sum.plus(&matrix[*k][*l], &(wk * wl)));
    }
    sum
}

/// `a - b`.
pub fn difference<R: Ring>(a: &Square<R>, b: &Square<R>) -> Square<R> {
    table(a.len(), |i, j| combined(&a[i][j], &b[i][j], &Rational::MINUS_ONE))
}

/// The transpose.
pub fn transpose<R: Clone>(a: &Square<R>) -> Square<R> {
    table(a.len(), |i, j| a[j][i].clone())
}

/// `a v`.
pub fn times<R: Ring>(a: &Square<R>, v: &[R]) -> Vec<R> {
    a.iter().map(|row| dot(row.iter().zip(v))).collect()
}

/// `a b^T`.
pub fn outer<R: Ring>(a: &[R], b: &[R]) -> Square<R> {
    table(a.len(), |i, j| dot([(&a[i], &b[j])]))
}
