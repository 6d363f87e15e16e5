//! Random points and parameters, reproducible from a seed.
//!
//! All numbers are short binary fractions, so they are `f64` exactly and exact arithmetic with them stays short.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use crate::matrix::Matrix;
use crate::ring::rational;
use crate::state::State;

/// Coefficients of the isotropic energy `I/2 tr(O^T O) + A/2 tr O^2 + B/2 (tr O)^2` and of the translational
/// energy with mass `m`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Isotropic {
    /// `I`.
    pub i: BigRational,
    /// `A`.
    pub a: BigRational,
    /// `B`.
    pub b: BigRational,
    /// `m`.
    pub m: BigRational,
}

/// The generator splitmix64 (Steele, Lea, Flood, OOPSLA 2014).
#[derive(Clone, Debug)]
pub struct Random {
    word: u64,
}

impl Random {
    /// The generator with this seed.
    pub fn new(seed: u64) -> Self {
        Random { word: seed }
    }

    /// The next 64 bits.
    pub fn bits(&mut self) -> u64 {
        self.word = self.word.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.word ^ (self.word >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ (mixed >> 31)
    }

    /// An integer in `low..=high`, uniform but for a bias below `(high - low)/2^32`.
    pub fn integer(&mut self, low: i64, high: i64) -> i64 {
        let span = (high - low + 1).unsigned_abs();
        let scaled = ((self.bits() >> 32) * span) >> 32;
        low + scaled.cast_signed()
    }

    /// A multiple of 1/64 in `[-2, 2]`.
    pub fn entry(&mut self) -> BigRational {
        rational(self.integer(-128, 128), 64)
    }

    /// A matrix of such entries.
    pub fn matrix(&mut self, rows: usize, columns: usize) -> Matrix {
        let entries: Vec<_> = (0..rows * columns).map(|_| self.entry()).collect();
        Matrix::from_rationals(rows, columns, &entries)
    }

    /// A placement with `det phi > 3/10`, entries within 3/4 of those of the unit matrix.
    pub fn placement(&mut self, n: usize) -> Matrix {
        loop {
            let displacement = Matrix::from_rationals(
                n,
                n,
                &(0..n * n).map(|_| rational(self.integer(-24, 24), 32)).collect::<Vec<_>>(),
            );
            let phi = &Matrix::identity(n) + &displacement;
            if phi.determinant() > rational(3, 10) {
                return phi;
            }
        }
    }

    /// A state with such a placement; `x`, `p`, `Pi` random.
    pub fn state(&mut self, n: usize) -> State {
        State { x: self.matrix(n, 1), phi: self.placement(n), p: self.matrix(n, 1), pi: self.matrix(n, n) }
    }

    /// A symmetric positive definite `n x n` matrix: diagonal in `[1, 2]`, off-diagonal at most 3/8.
    pub fn inertia(&mut self, n: usize) -> Matrix {
        self.dominated(n, |random, _| rational(random.integer(32, 64), 32), rational(3, 8))
    }

    /// A symmetric regular `n^2 x n^2` matrix for the tensor terms, in half of the cases positive definite, in the
    /// others with random signs on the diagonal; condition below 25 (Gershgorin).
    pub fn tensor(&mut self, n: usize) -> Matrix {
        let definite = self.bits() & 1 == 0;
        let diagonal = |random: &mut Random, _| {
            let sign = if definite || random.bits() & 1 == 0 { 1 } else { -1 };
            rational(sign * random.integer(32, 64), 32)
        };
        self.dominated(n * n, diagonal, rational(7, 64))
    }

    /// A symmetric matrix with the given diagonal and off-diagonal entries up to `bound` in size.
    fn dominated(
        &mut self,
        size: usize,
        diagonal: impl Fn(&mut Random, usize) -> BigRational,
        bound: BigRational,
    ) -> Matrix {
        let mut entries = vec![BigRational::zero(); size * size];
        for i in 0..size {
            entries[i * size + i] = diagonal(self, i);
            for j in 0..i {
                let entry = &bound * rational(self.integer(-8, 8), 8);
                entries[j * size + i] = entry.clone();
                entries[i * size + j] = entry;
            }
        }
        Matrix::from_rationals(size, size, &entries)
    }

    /// Isotropic coefficients whose energy is regular: half of them positive definite, half indefinite; the ratio of
    /// the extreme |eigenvalues| `I+A`, `I-A`, `I+A+nB`, `m` is at most 1e4, their common scale `2^-10 ..= 2^10`.
    pub fn isotropic(&mut self, n: usize) -> Isotropic {
        let count = BigRational::from_integer(n.into());
        let spread = self.integer(0, 12);
        let scale = self.integer(-10, 10);
        let signs = self.signs();
        let [symmetric, skew, trace, m] = signs.map(|sign| {
            let exponent = scale + spread / 2 - self.integer(0, spread);
            let mantissa = rational(sign * self.integer(64, 127), 64);
            mantissa * power_of_two(exponent)
        });
        let half = rational(1, 2);
        // B is rounded to a grid 2^10 finer than the smallest eigenvalue, so that it is short and I+A+nB stays put.
        let grid = power_of_two(scale - spread / 2 - 12);
        let b = ((trace - &symmetric) / count / &grid).round() * grid;
        Isotropic { i: (&symmetric + &skew) * &half, a: (&symmetric - &skew) * half, b, m }
    }

    /// Signs of the four eigenvalues: all positive, or the first three of both signs.
    fn signs(&mut self) -> [i64; 4] {
        if self.bits() & 1 == 0 {
            return [1; 4];
        }
        // The patterns 1 ..= 6 of three bits are those with both signs.
        let pattern = self.integer(1, 6);
        let sign = |bit: i64| if pattern >> bit & 1 == 0 { 1 } else { -1 };
        [sign(0), sign(1), sign(2), if self.bits() & 1 == 0 { 1 } else { -1 }]
    }
}

impl Isotropic {
    /// The eigenvalues `I+A` (symmetric traceless), `I-A` (skew), `I+A+nB` (trace) of the internal form at `phi = 1`.
    pub fn eigenvalues(&self, n: usize) -> [BigRational; 3] {
        let count = BigRational::from_integer(n.into());
        let symmetric = &self.i + &self.a;
        let trace = &symmetric + count * &self.b;
        [symmetric, &self.i - &self.a, trace]
    }

    /// The internal form takes both signs.
    pub fn is_indefinite(&self, n: usize) -> bool {
        let eigenvalues = self.eigenvalues(n);
        eigenvalues.iter().any(Signed::is_positive) && eigenvalues.iter().any(Signed::is_negative)
    }
}

fn power_of_two(exponent: i64) -> BigRational {
    let power = BigRational::from_integer(BigInt::one() << exponent.unsigned_abs());
    if exponent < 0 { power.recip() } else { power }
}
