//! Matrices that are made of others: sums, products and powers, each of them once.

use crate::algebra::ring::{Square, table};
use crate::algebra::vanishing::vanishes;
use crate::algebra::{Arena, Expr, Rational};
use crate::lower::constant::integer;
use crate::lower::{Lowered, NoValue, zero_divisor};
use crate::mechanics::potential::Base;
use crate::spec::{Expression, ExpressionKind, MatrixName, Operator};

/// The values of parts without matrices.
pub(super) type Scalars<'a> = &'a dyn Fn(&mut Arena, &Expression) -> Lowered;

/// Matrices in the order in which they are computed.
pub(super) struct Tape<'a> {
    pub(super) arena: &'a mut Arena,
    pub(super) n: usize,
    pub(super) scalars: Scalars<'a>,
    pub(super) nodes: Vec<Node>,
}

pub(super) struct Node {
    pub(super) value: Square<Expr>,
    pub(super) made: Made,
    /// The matrix that it is a power of, and the exponent.
    pub(super) power: (usize, u32),
}

/// How a matrix is made of those before.
#[derive(Clone)]
pub(super) enum Made {
    Named(MatrixName),
    /// That multiple of the unit matrix.
    Scalar(Expr),
    Sum(Vec<(usize, Rational)>),
    Product(usize, usize),
}

impl Tape<'_> {
    /// A part of a polynomial.
    pub(super) fn read(&mut self, part: &Expression) -> Result<usize, NoValue> {
        let one = Rational::ONE;
        Ok(match &part.kind {
            ExpressionKind::Matrix(matrix) => self.named(*matrix),
            _ if !has_matrix(part) => {
                let value = (self.scalars)(self.arena, part)?;
                self.scalar(value)
            }
            ExpressionKind::Negate(a) => {
                let a = self.read(a)?;
                self.sum(vec![(a, -&one)])
            }
            ExpressionKind::Binary(operator @ (Operator::Add | Operator::Subtract), a, b) => {
                let (a, b) = (self.read(a)?, self.read(b)?);
                let sign = if *operator == Operator::Add { one.clone() } else { -&one };
                self.sum(vec![(a, one), (b, sign)])
            }
            ExpressionKind::Binary(Operator::Multiply, a, b) => {
                let (a, b) = (self.read(a)?, self.read(b)?);
                self.product(a, b)
            }
            ExpressionKind::Binary(Operator::Divide, a, b) => {
                let a = self.read(a)?;
                let divisor = (self.scalars)(self.arena, b)?;
                let inverse = self.arena.pow(divisor, -1).ok_or_else(|| zero_divisor(b))?;
                let inverse = self.scalar(inverse);
                self.product(inverse, a)
            }
            ExpressionKind::Binary(Operator::Power, a, exponent) => {
                let a = self.read(a)?;
                let exponent = integer(exponent, self.n).and_then(|exponent| u32::try_from(exponent).ok());
                self.power(a, exponent.ok_or(NoValue::Malformed)?)
            }
            _ => return Err(NoValue::Malformed),
        })
    }

    /// The place of a matrix; one that is there already stays where it is.
    fn put(&mut self, value: Square<Expr>, made: Made, power: Option<(usize, u32)>) -> usize {
        if let Some(known) = self.nodes.iter().position(|node| node.value == value) {
            return known;
        }
        let place = self.nodes.len();
        self.nodes.push(Node { value, made, power: power.unwrap_or((place, 1)) });
        place
    }

    pub(super) fn named(&mut self, matrix: MatrixName) -> usize {
        let n = self.n;
        let value = table(n, |a, b| entry(matrix, a, b).symbol(self.arena));
        self.put(value, Made::Named(matrix), None)
    }

    pub(super) fn scalar(&mut self, value: Expr) -> usize {
        let zero = self.arena.constant(Rational::ZERO);
        let matrix = table(self.n, |a, b| if a == b { value } else { zero });
        self.put(matrix, Made::Scalar(value), None)
    }

    fn sum(&mut self, terms: Vec<(usize, Rational)>) -> usize {
        let n = self.n;
        let entry = |arena: &mut Arena, nodes: &[Node], a: usize, b: usize| {
            let terms: Vec<_> = terms.iter().map(|(k, c)| (nodes[*k].value[a][b], c.clone())).collect();
            arena.linear(&terms)
        };
        let value = table(n, |a, b| entry(self.arena, &self.nodes, a, b));
        self.put(value, Made::Sum(terms), None)
    }

    /// The product; of two powers of one matrix a power.
    pub(super) fn product(&mut self, a: usize, b: usize) -> usize {
        let ((base, k), (other, l)) = (self.nodes[a].power, self.nodes[b].power);
        match [a, b].map(|k| self.as_scalar(k)) {
            [Some(one), _] if self.is_one(one) => b,
            [_, Some(one)] if self.is_one(one) => a,
            [None, None] if base == other => self.power(base, k + l),
            _ => self.multiplied(a, b, None),
        }
    }

    fn multiplied(&mut self, a: usize, b: usize, power: Option<(usize, u32)>) -> usize {
        let value = match [a, b].map(|k| self.as_scalar(k)) {
            [Some(scalar), _] => self.times_scalar(scalar, b),
            [_, Some(scalar)] => self.times_scalar(scalar, a),
            _ => times(self.arena, &self.nodes[a].value, &self.nodes[b].value),
        };
        self.put(value, Made::Product(a, b), power)
    }

    fn times_scalar(&mut self, scalar: Expr, of: usize) -> Square<Expr> {
        let entries = self.nodes[of].value.iter();
        entries.map(|row| row.iter().map(|entry| self.arena.mul(scalar, *entry)).collect()).collect()
    }

    /// A power by squares.
    pub(super) fn power(&mut self, of: usize, exponent: u32) -> usize {
        let (base, own) = self.nodes[of].power;
        match own * exponent {
            0 => {
                let one = self.arena.constant(Rational::ONE);
                self.scalar(one)
            }
            1 => base,
            exponent => {
                let half = self.power(base, exponent / 2);
                let square = self.multiplied(half, half, Some((base, exponent / 2 * 2)));
                match exponent % 2 {
                    0 => square,
                    _ => self.multiplied(square, base, Some((base, exponent))),
                }
            }
        }
    }

    fn as_scalar(&self, place: usize) -> Option<Expr> {
        match self.nodes[place].made {
            Made::Scalar(value) => Some(value),
            _ => None,
        }
    }

    fn is_one(&self, value: Expr) -> bool {
        self.arena.as_constant(value).is_some_and(|value| value.is_one())
    }
}

/// The base function that an entry is.
pub(in crate::lower) fn entry(matrix: MatrixName, row: usize, column: usize) -> Base {
    match matrix {
        MatrixName::Green => Base::Green(row.min(column), row.max(column)),
        MatrixName::Finger => Base::Finger(row.min(column), row.max(column)),
        MatrixName::Placement => Base::Placement(row, column),
    }
}

/// Does a matrix stand in the part, other than in a trace within it?
fn has_matrix(part: &Expression) -> bool {
    match &part.kind {
        ExpressionKind::Matrix(_) => true,
        ExpressionKind::PolynomialTrace(_) => false,
        _ => part.operands().into_iter().any(has_matrix),
    }
}

/// The product of two matrices, whose entries stay sums of products; of a symmetric one each pair is one entry.
pub(super) fn times(arena: &mut Arena, left: &Square<Expr>, right: &Square<Expr>) -> Square<Expr> {
    let n = left.len();
    let entry = |i: usize, j: usize| {
        let products: Vec<(Expr, Rational)> =
            (0..n).map(|k| (arena.mul(left[i][k], right[k][j]), Rational::ONE)).collect();
        arena.linear(&products)
    };
    let mut product: Square<Expr> = table(n, entry);
    for (i, j) in (0..n).flat_map(|j| (0..j).map(move |i| (i, j))) {
        if product[i][j] != product[j][i] {
            let difference = arena.sub(product[i][j], product[j][i]);
            if vanishes(arena, difference) {
                product[j][i] = product[i][j];
            }
        }
    }
    product
}
