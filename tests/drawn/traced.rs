//! What stands in a trace: polynomials in matrices, in which a number is that multiple of the identity.

use qd::Quad;

use super::energy::{ALONE, Chosen, Energy, POWER, PRODUCT, SUM};
use super::number::Dual;
use super::place::{Measures, Square, determinant, dual_product, square};

/// A matrix that traces and entries are taken of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Tensor {
    Green,
    Finger,
    Placement,
}

impl Tensor {
    pub(crate) fn name(self) -> &'static str {
        ["G", "Ct", "phi"][self as usize]
    }

    pub(crate) fn of(self, at: &Measures) -> &Square<Dual> {
        match self {
            Self::Green => &at.green,
            Self::Finger => &at.finger,
            Self::Placement => &at.phi,
        }
    }
}

/// A polynomial in matrices.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Traced {
    Matrix(Tensor),
    /// `G^-1`.
    Inverse(Tensor),
    Number(Box<Energy>),
    Power(Box<Traced>, usize),
    Add(Box<Traced>, Box<Traced>),
    Subtract(Box<Traced>, Box<Traced>),
    Multiply(Box<Traced>, Box<Traced>),
}

impl Traced {
    /// As written, in brackets where it is not bound as tightly as this.
    pub(crate) fn bound(&self, n: usize, chosen: Chosen, least: u8) -> String {
        let of = |one: &Self, least: u8| one.bound(n, chosen, least);
        let (text, level) = match self {
            Self::Matrix(tensor) => (tensor.name().to_owned(), ALONE),
            Self::Inverse(tensor) => (format!("{}^-1", tensor.name()), POWER),
            Self::Number(number) => return number.bound(n, chosen, least),
            Self::Power(base, power) => (format!("{}^{power}", of(base, ALONE)), POWER),
            Self::Add(a, b) => (format!("{} + {}", of(a, SUM), of(b, PRODUCT)), SUM),
            Self::Subtract(a, b) => (format!("{} - {}", of(a, SUM), of(b, PRODUCT)), SUM),
            Self::Multiply(a, b) => (format!("{}*{}", of(a, PRODUCT), of(b, POWER)), PRODUCT),
        };
        if level < least { format!("({text})") } else { text }
    }

    pub(crate) fn of(&self, at: &Measures, chosen: Chosen) -> Square<Dual> {
        let n = at.phi.len();
        let value = |one: &Self| one.of(at, chosen);
        match self {
            Self::Matrix(tensor) => tensor.of(at).clone(),
            Self::Inverse(tensor) => inverse(tensor.of(at)),
            Self::Number(number) => multiple(n, &number.of(at, chosen)),
            Self::Power(base, power) => {
                let base = value(base);
                (0..*power)
                    .fold(multiple(n, &Dual::constant(Quad::ONE)), |power, _| dual_product(&power, &base))
            }
            Self::Add(a, b) => {
                let (a, b) = (value(a), value(b));
                square(n, |i, j| a[i][j].plus(&b[i][j]))
            }
            Self::Subtract(a, b) => {
                let (a, b) = (value(a), value(b));
                square(n, |i, j| a[i][j].plus(&b[i][j].negated()))
            }
            Self::Multiply(a, b) => dual_product(&value(a), &value(b)),
        }
    }
}

fn multiple(n: usize, number: &Dual) -> Square<Dual> {
    square(n, |i, j| if i == j { *number } else { Dual::constant(Quad::ZERO) })
}

/// Cofactors over the determinant.
fn inverse(a: &Square<Dual>) -> Square<Dual> {
    let n = a.len();
    let below = determinant(a).power(-1, 1);
    square(n, |i, j| {
        let rows = (0..n).filter(|row| *row != j);
        let minor: Square<Dual> =
            rows.map(|row| (0..n).filter(|k| *k != i).map(|k| a[row][k]).collect()).collect();
        let cofactor = determinant(&minor).times(&below);
        if (i + j).is_multiple_of(2) { cofactor } else { cofactor.negated() }
    })
}
