//! Is an expression zero whatever its symbols are? By its values modulo primes in which exponentials turn sums into products.
//!
//! Of three primes each is twice the next and 1, so that `exp(x) = 4^x` modulo one has `x` modulo the next (a Cunningham chain).
//! Any other function has any value for each argument, and the sign that it changes by: what is zero here is zero for every such
//! function. Nothing is multiplied out.

use std::array::from_fn;

use super::arena::{Arena, Expr};
use super::evaluate::{Field, evaluate};
use super::function::Function;
use super::rational::Rational;
use super::residue::{POINTS, hash};

const PRIMES: [u64; 3] = [4_611_686_018_427_369_527, 2_305_843_009_213_684_763, 1_152_921_504_606_842_381];

/// Is it zero at two points? Not where it has no value.
pub fn vanishes(arena: &Arena, expr: Expr) -> bool {
    is_zero(arena, expr) == Some(true)
}

/// Is it zero at two points? `None` where it has no value at one, since a divisor is zero there.
pub fn is_zero(arena: &Arena, expr: Expr) -> Option<bool> {
    let mut all = true;
    for point in POINTS {
        let sample =
            |symbol: &_| Some(Value::new(PRIMES.map(|prime| hash(&format!("{symbol}{point}")) % prime)));
        all &= evaluate(arena, expr, &sample)?.is_zero();
    }
    Some(all)
}

/// A number modulo each prime.
#[derive(Clone, Copy)]
struct Value {
    of: [u64; 3],
    /// What it is known to be the exponential of.
    logarithm: Option<[u64; 3]>,
}

impl Value {
    fn new(of: [u64; 3]) -> Self {
        Self { of, logarithm: (of == [1; 3]).then_some([0; 3]) }
    }

    fn is_zero(&self) -> bool {
        self.of[0] == 0
    }

    fn exponential(x: [u64; 3]) -> Self {
        let of = from_fn(|k| match x.get(k + 1) {
            Some(exponent) => power(4, *exponent, PRIMES[k]),
            None => any(Function::Exp, x[k], PRIMES[k]),
        });
        Self { of, logarithm: Some(x) }
    }

    /// `exp(x) + sign exp(-x)`
    fn sum_of_exponentials(&self, sign: i64) -> Self {
        let [minus, sign] = [-1, sign].map(|number| Self::from_rational(&Rational::from(number)));
        Self::exponential(self.of).add(&Self::exponential(self.mul(&minus).of).mul(&sign))
    }
}

fn product(a: u64, b: u64, prime: u64) -> u64 {
    (u128::from(a) * u128::from(b) % u128::from(prime)) as u64
}

fn power(base: u64, exponent: u64, prime: u64) -> u64 {
    let square = |power| product(power, power, prime);
    (0..u64::BITS).rev().fold(1, |power, bit| match exponent >> bit & 1 {
        0 => square(power),
        _ => product(square(power), base, prime),
    })
}

/// Fermat: `a^(p-2) = 1/a`.
fn inverse(a: u64, prime: u64) -> u64 {
    power(a, prime - 2, prime)
}

/// A value for a function and its argument together.
fn any(function: Function, argument: u64, prime: u64) -> u64 {
    let opposite = prime - argument;
    let turned = (function.is_even() || function.is_odd()) && opposite < argument;
    let size = if turned { opposite } else { argument };
    let value = hash(&format!("{}({size})", function.name())) % prime;
    if turned && function.is_odd() { prime - value } else { value }
}

impl Field for Value {
    fn from_rational(value: &Rational) -> Self {
        Self::new(PRIMES.map(|prime| {
            let (numerator, denominator) = value.residues(prime);
            // A multiple of the prime is not zero: any other number will do.
            let [above, below] = [numerator, denominator].map(|part| if part == 0 { 2 } else { part });
            if value.is_zero() { 0 } else { product(above, inverse(below, prime), prime) }
        }))
    }

    fn add(&self, other: &Self) -> Self {
        Self::new(from_fn(|k| (self.of[k] + other.of[k]) % PRIMES[k]))
    }

    fn mul(&self, other: &Self) -> Self {
        let logarithm = self.logarithm.zip(other.logarithm);
        let logarithm = logarithm.map(|(a, b)| from_fn(|k| (a[k] + b[k]) % PRIMES[k]));
        let of = from_fn(|k| product(self.of[k], other.of[k], PRIMES[k]));
        Self { logarithm, ..Self::new(of) }
    }

    fn recip(&self) -> Option<Self> {
        let of = from_fn(|k| inverse(self.of[k], PRIMES[k]));
        let logarithm = self.logarithm.map(|x| from_fn(|k| (PRIMES[k] - x[k]) % PRIMES[k]));
        (!self.is_zero()).then_some(Self { of, logarithm })
    }

    fn apply(&self, function: Function) -> Option<Self> {
        let half = Self::from_rational(&Rational::HALF);
        Some(match (function, self.logarithm) {
            (Function::Exp, _) => Self::exponential(self.of),
            (Function::Sinh, _) => self.sum_of_exponentials(-1).mul(&half),
            (Function::Cosh, _) => self.sum_of_exponentials(1).mul(&half),
            (Function::Tanh, _) => self.sum_of_exponentials(-1).mul(&self.sum_of_exponentials(1).recip()?),
            (Function::Ln, Some(x)) => Self::new(x),
            (Function::Sqrt, Some(x)) => Self::exponential(Self::new(x).mul(&half).of),
            (Function::Abs, Some(_)) => *self,
            (Function::Ln, _) if self.is_zero() => return None,
            (Function::Cos, _) if self.is_zero() => Self::from_rational(&Rational::ONE),
            _ if self.is_zero() => *self,
            _ => Self::new(from_fn(|k| any(function, self.of[k], PRIMES[k]))),
        })
    }
}
