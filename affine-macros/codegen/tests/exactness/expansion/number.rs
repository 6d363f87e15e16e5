//! Numbers modulo a prime with their derivatives along a motion, and elementary functions of them.
//!
//! A function is a table: the same argument has the same value, and where the arguments are the logarithms of the point,
//! `q = ln D` and `q_a = ln Q_a`, the values are powers of `D` and `Q_a`. Logarithms are independent of what they are
//! logarithms of, so that an identity between them that holds here at random holds.

use std::cell::RefCell;
use std::collections::HashMap;
use std::ops::{Add, Mul, Neg, Sub};

use affine_codegen::algebra::evaluate::Field;
use affine_codegen::algebra::{Function, Rational};
use affine_oracle::Random;

const PRIME: u64 = (1 << 61) - 1;

/// A residue modulo `2^61 - 1`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct Number(u64);

impl Number {
    pub(super) const ZERO: Self = Self(0);
    pub(super) const ONE: Self = Self(1);

    pub(super) fn integer(value: i64) -> Self {
        let size = Self(value.unsigned_abs() % PRIME);
        if value < 0 { -size } else { size }
    }

    pub(super) fn random(random: &mut Random) -> Self {
        Self(random.bits() % PRIME)
    }

    /// A value that depends on these alone (FNV-1a over their bytes).
    pub(super) fn hash(of: &[u64]) -> Self {
        let bytes = of.iter().flat_map(|word| word.to_le_bytes());
        let hash = bytes.fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
        });
        Self(Random::new(hash).bits() % PRIME)
    }

    pub(super) fn word(self) -> u64 {
        self.0
    }

    pub(super) fn power(self, exponent: i64) -> Self {
        let base = if exponent < 0 { self.inverse() } else { self };
        base.raised(exponent.unsigned_abs())
    }

    fn raised(self, mut exponent: u64) -> Self {
        let (mut square, mut power) = (self, Self::ONE);
        while exponent > 0 {
            if exponent & 1 == 1 {
                power = power * square;
            }
            square = square * square;
            exponent >>= 1;
        }
        power
    }

    /// Fermat: `a^(p-2) = 1/a`.
    pub(super) fn inverse(self) -> Self {
        assert!(self.0 != 0, "1/0 at a random point");
        self.raised(PRIME - 2)
    }

    /// A square root, the same of the two for the same number; `p = 3 modulo 4`.
    pub(super) fn root(self) -> Option<Self> {
        let root = self.raised(PRIME.div_ceil(4));
        (root * root == self).then(|| Self(root.0.min(PRIME - root.0)))
    }
}

impl Add for Number {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self((self.0 + other.0) % PRIME)
    }
}

impl Neg for Number {
    type Output = Self;
    fn neg(self) -> Self {
        Self((PRIME - self.0) % PRIME)
    }
}

impl Sub for Number {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Number {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let wide = u128::from(self.0) * u128::from(other.0);
        // 2^61 = 1 modulo the prime.
        let (low, high) = ((wide as u64) & PRIME, (wide >> 61) as u64);
        Self((low + high) % PRIME)
    }
}

impl Field for Number {
    fn from_rational(value: &Rational) -> Self {
        let (above, below) = value.residues(PRIME);
        if below == 1 { Self(above) } else { Self(above) * Self(below).inverse() }
    }
    fn add(&self, other: &Self) -> Self {
        *self + *other
    }
    fn mul(&self, other: &Self) -> Self {
        *self * *other
    }
    fn recip(&self) -> Option<Self> {
        (self.0 != 0).then(|| self.inverse())
    }
    fn apply(&self, function: Function) -> Option<Self> {
        let known = KNOWN.with_borrow(|known| known.get(&(function, *self)).copied());
        let half = Self::integer(2).inverse();
        let exponential = |x: Self| x.apply(Function::Exp);
        // The tangent of half an angle.
        let tangent = |x: Self| x.odd(Function::Tan);
        known.or_else(|| match function {
            Function::Sqrt => self.root(),
            // A function of its own, but 1/exp(x) = exp(-x).
            Function::Exp if self.0 == 0 => Some(Self::ONE),
            Function::Exp if self.0 > PRIME / 2 => Some(exponential(-*self)?.inverse()),
            Function::Exp | Function::Ln => Some(Self::hash(&[function as u64, self.0])),
            Function::ExpM1 => Some(exponential(*self)? - Self::ONE),
            Function::Sinh => Some((exponential(*self)? - exponential(-*self)?) * half),
            Function::Cosh => Some((exponential(*self)? + exponential(-*self)?) * half),
            Function::Tanh => Some(self.apply(Function::Sinh)? * self.apply(Function::Cosh)?.inverse()),
            Function::Sin => {
                let u = tangent(*self);
                Some(Self::integer(2) * u * (Self::ONE + u * u).inverse())
            }
            Function::Cos => {
                let u = tangent(*self);
                Some((Self::ONE - u * u) * (Self::ONE + u * u).inverse())
            }
            Function::Tan => Some(self.apply(Function::Sin)? * self.apply(Function::Cos)?.inverse()),
            Function::InverseCbrt => Some(self.apply(Function::Cbrt)?.inverse()),
            // Of what is no power of D there is none, and residues have no sign.
            Function::Cbrt | Function::Abs | Function::Sign | Function::Asinh => None,
        })
    }
}

impl Number {
    /// A value with the sign of the argument.
    fn odd(self, function: Function) -> Self {
        match self.0 {
            0 => Self::ZERO,
            word if word > PRIME / 2 => -Self::hash(&[function as u64, PRIME - word]),
            word => Self::hash(&[function as u64, word]),
        }
    }
}

thread_local! {
    /// What is known of functions at the point.
    static KNOWN: RefCell<HashMap<(Function, Number), Number>> = RefCell::default();
}

/// The stretches of a placement, `D` with `D^n` their product, and logarithms of all of them.
#[derive(Clone, Debug)]
pub(super) struct Stretches {
    pub(super) each: Vec<Number>,
    pub(super) logarithms: Vec<Number>,
    /// `D`.
    pub(super) mean: Number,
    /// `q`.
    pub(super) mean_logarithm: Number,
}

impl Stretches {
    /// Fills the table of functions; with the single stretches, where a model reads them.
    pub(super) fn install(&self, single: bool) {
        let n = self.each.len();
        let mut known: HashMap<(Function, Number), Number> = HashMap::new();
        let mut learn = |logarithm: Number, value: Number| {
            known.insert((Function::Exp, logarithm), value);
            known.insert((Function::Ln, value), logarithm);
            // arsinh((x - 1/x)/2) = ln x
            let argument = (value - value.inverse()) * Number::integer(2).inverse();
            known.insert((Function::Asinh, argument), logarithm);
        };
        powers(self.mean_logarithm, self.mean, 12).into_iter().for_each(|(q, d)| learn(q, d));
        if single {
            let each: Vec<_> =
                self.logarithms.iter().zip(&self.each).map(|(q, value)| powers(*q, *value, 3)).collect();
            let products = each.iter().fold(vec![(Number::ZERO, Number::ONE)], |products, powers| {
                let with = |(q, d): &(Number, Number)| {
                    powers.iter().map(|(p, e)| (*q + *p, *d * *e)).collect::<Vec<_>>()
                };
                products.iter().flat_map(with).collect()
            });
            products.into_iter().for_each(|(q, d)| learn(q, d));
        }
        let root = if n == 2 { Function::Sqrt } else { Function::Cbrt };
        known.insert((root, self.mean.power(n as i64)), self.mean);
        KNOWN.set(known);
    }
}

/// Multiples of a logarithm and the powers that belong to them, up to a size of the exponent.
fn powers(logarithm: Number, value: Number, most: usize) -> Vec<(Number, Number)> {
    let both = [(logarithm, value), (-logarithm, value.inverse())];
    let side = |(q, d): (Number, Number)| {
        std::iter::successors(Some((q, d)), move |(p, e)| Some((*p + q, *e * d))).take(most)
    };
    std::iter::once((Number::ZERO, Number::ONE)).chain(both.into_iter().flat_map(side)).collect()
}

/// A number and its rate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Jet {
    pub(super) value: Number,
    pub(super) rate: Number,
}

impl Jet {
    pub(super) fn constant(value: Number) -> Self {
        Self { value, rate: Number::ZERO }
    }

    fn inverse(self) -> Self {
        let value = self.value.inverse();
        Self { value, rate: -(self.rate * value * value) }
    }
}

impl Add for Jet {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { value: self.value + other.value, rate: self.rate + other.rate }
    }
}

impl Sub for Jet {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self { value: self.value - other.value, rate: self.rate - other.rate }
    }
}

impl Mul for Jet {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self { value: self.value * other.value, rate: self.value * other.rate + self.rate * other.value }
    }
}

/// A matrix of jets, row after row.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Table(pub(super) Vec<Vec<Jet>>);

impl Table {
    pub(super) fn new(n: usize, entry: impl Fn(usize, usize) -> Jet) -> Self {
        Self((0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect())
    }

    pub(super) fn constant(values: &[Vec<Number>]) -> Self {
        Self(values.iter().map(|row| row.iter().copied().map(Jet::constant).collect()).collect())
    }

    pub(super) fn identity(n: usize) -> Self {
        Self::new(n, |i, j| Jet::constant(if i == j { Number::ONE } else { Number::ZERO }))
    }

    pub(super) fn zero(n: usize) -> Self {
        Self::new(n, |_, _| Jet::constant(Number::ZERO))
    }

    pub(super) fn random(random: &mut Random, n: usize) -> Self {
        Self((0..n).map(|_| (0..n).map(|_| Jet::constant(Number::random(random))).collect()).collect())
    }

    /// Cayley's rotation `(1 - W)^-1 (1 + W)` of a skew `W`.
    pub(super) fn rotation(skew: &Self) -> Self {
        let one = Self::identity(skew.size());
        &(&one - skew).inverse() * &(&one + skew)
    }

    pub(super) fn random_rotation(random: &mut Random, n: usize) -> Self {
        Self::rotation(&Self::random(random, n).skew())
    }

    pub(super) fn size(&self) -> usize {
        self.0.len()
    }

    pub(super) fn values(&self) -> Vec<Vec<Number>> {
        self.0.iter().map(|row| row.iter().map(|jet| jet.value).collect()).collect()
    }

    /// The rates as constants.
    pub(super) fn rates(&self) -> Self {
        Self::new(self.size(), |i, j| Jet::constant(self.0[i][j].rate))
    }

    pub(super) fn transpose(&self) -> Self {
        Self::new(self.size(), |i, j| self.0[j][i])
    }

    /// `M - M^T`
    pub(super) fn skew(&self) -> Self {
        self - &self.transpose()
    }

    pub(super) fn scaled(&self, factor: Jet) -> Self {
        Self::new(self.size(), |i, j| factor * self.0[i][j])
    }

    pub(super) fn trace(&self) -> Jet {
        (0..self.size()).fold(Jet::constant(Number::ZERO), |sum, a| sum + self.0[a][a])
    }

    /// The same with these rates.
    pub(super) fn moving(&self, rates: &Self) -> Self {
        Self::new(self.size(), |i, j| Jet { value: self.0[i][j].value, rate: rates.0[i][j].value })
    }

    /// Gauss and Jordan.
    pub(super) fn inverse(&self) -> Self {
        let n = self.size();
        let (mut left, mut right) = (self.0.clone(), Self::identity(n).0);
        for k in 0..n {
            let pivot = (k..n).find(|row| left[*row][k].value != Number::ZERO).expect("a regular matrix");
            left.swap(k, pivot);
            right.swap(k, pivot);
            let factor = left[k][k].inverse();
            for side in [&mut left, &mut right] {
                side[k].iter_mut().for_each(|entry| *entry = factor * *entry);
            }
            for row in (0..n).filter(|row| *row != k) {
                let factor = left[row][k];
                for side in [&mut left, &mut right] {
                    let above = side[k].clone();
                    side[row]
                        .iter_mut()
                        .zip(above)
                        .for_each(|(entry, above)| *entry = *entry - factor * above);
                }
            }
        }
        Self(right)
    }

    pub(super) fn times(&self, vector: &[Jet]) -> Vec<Jet> {
        let dot = |row: &Vec<Jet>| {
            row.iter().zip(vector).fold(Jet::constant(Number::ZERO), |sum, (a, b)| sum + *a * *b)
        };
        self.0.iter().map(dot).collect()
    }
}

impl Add for &Table {
    type Output = Table;
    fn add(self, other: Self) -> Table {
        Table::new(self.size(), |i, j| self.0[i][j] + other.0[i][j])
    }
}

impl Sub for &Table {
    type Output = Table;
    fn sub(self, other: Self) -> Table {
        Table::new(self.size(), |i, j| self.0[i][j] - other.0[i][j])
    }
}

impl Mul for &Table {
    type Output = Table;
    fn mul(self, other: Self) -> Table {
        Table::new(self.size(), |i, j| {
            (0..self.size()).fold(Jet::constant(Number::ZERO), |sum, k| sum + self.0[i][k] * other.0[k][j])
        })
    }
}
