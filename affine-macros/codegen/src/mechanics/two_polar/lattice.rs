//! The phase space of the lattice: its coordinates, their symbols and their brackets.

use crate::algebra::fault::never_missing;
use crate::algebra::ring::above_diagonal;
use crate::algebra::{Arena, Expr, Polynomial, Rational};
use crate::mechanics::hamiltonian::Hamiltonian;
use crate::mechanics::term::Frame;
use crate::symbol::Quantity;

/// What is written on the diagonal of `D`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Variables {
    /// `q_a`, `D_aa = exp(q_a)`: affine models, (6.2) to (6.4).
    LogStretches,
    /// `Q_a = D_aa`: d'Alembert's model, (6.5).
    Stretches,
    /// `q_a`, `D_aa = exp(i q_a)`: U(n), (89).
    Angles,
}

/// The phase space of the lattice and its symbols.
#[derive(Clone, Debug)]
pub struct Lattice {
    /// `n`.
    pub dim: usize,
    /// What the places are.
    pub variables: Variables,
    /// `q_a` or `Q_a`.
    pub q: Vec<Expr>,
    /// The conjugate momenta.
    pub p: Vec<Expr>,
    /// `M_ab`, `a < b`, in the order of [`Lattice::pairs`].
    pub m: Vec<Expr>,
    /// `N_ab`, likewise.
    pub n: Vec<Expr>,
}

/// One coordinate, indices from 0, those of skew matrices ascending.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coordinate {
    /// `q_a` or `Q_a`.
    Q(usize),
    /// Its momentum.
    P(usize),
    /// `M_ab`.
    M(usize, usize),
    /// `N_ab`.
    N(usize, usize),
}

impl Lattice {
    /// The lattice of a model: stretches for energies with constant coefficients in `phi_dot`, their logarithms for those
    /// in an affine velocity, angles for U(n).
    pub fn of(arena: &mut Arena, h: &Hamiltonian, unitary: bool) -> Self {
        let (variables, place) = match h.frame {
            _ if unitary => (Variables::Angles, Quantity::LogStretches),
            Frame::Flat => (Variables::Stretches, Quantity::Stretches),
            Frame::Body | Frame::Space => (Variables::LogStretches, Quantity::LogStretches),
        };
        let (q, p) = (arena.components(place, h.dim), arena.components(Quantity::LinearMomentum, h.dim));
        let mut skew = |of: Quantity| -> Vec<Expr> {
            above_diagonal(h.dim).map(|(a, b)| arena.symbol(of.at([a + 1, b + 1]))).collect()
        };
        let (m, n) = (skew(Quantity::SumCouplings), skew(Quantity::DifferenceCouplings));
        Self { dim: h.dim, variables, q, p, m, n }
    }

    /// `(a, b)` with `a < b`.
    pub fn pairs(&self) -> impl Iterator<Item = (usize, usize)> + use<> {
        above_diagonal(self.dim)
    }

    /// All coordinates, group after group.
    pub fn coordinates(&self) -> Vec<Coordinate> {
        let mut all: Vec<Coordinate> = (0..self.dim).map(Coordinate::Q).collect();
        all.extend((0..self.dim).map(Coordinate::P));
        all.extend(self.pairs().map(|(a, b)| Coordinate::M(a, b)));
        all.extend(self.pairs().map(|(a, b)| Coordinate::N(a, b)));
        all
    }

    /// Symbol of a coordinate.
    pub fn symbol(&self, coordinate: Coordinate) -> Expr {
        let place = |a: usize, b: usize| {
            never_missing(self.pairs().position(|pair| pair == (a, b)), "the axes of a pair come in order", 0)
        };
        match coordinate {
            Coordinate::Q(a) => self.q[a],
            Coordinate::P(a) => self.p[a],
            Coordinate::M(a, b) => self.m[place(a, b)],
            Coordinate::N(a, b) => self.n[place(a, b)],
        }
    }

    /// Entry of a skew matrix, any indices.
    pub(super) fn skew(&self, entry: fn(usize, usize) -> Coordinate, a: usize, b: usize) -> Polynomial {
        match a.cmp(&b) {
            std::cmp::Ordering::Less => Polynomial::atom(self.symbol(entry(a, b))),
            std::cmp::Ordering::Equal => Polynomial::zero(),
            std::cmp::Ordering::Greater => {
                Polynomial::term(vec![self.symbol(entry(b, a))], Rational::MINUS_ONE)
            }
        }
    }

    /// `{z, y}`: `{q_a, p_b} = d_ab`; `{M, M} = {N, N} = -f(M)`, `{M, N} = -f(N)` with
    /// `f(X)_ab,cd = X_ad d_cb - X_cb d_ad + X_db d_ac - X_ac d_db`; all others vanish.
    pub fn bracket(&self, z: Coordinate, y: Coordinate) -> Polynomial {
        use Coordinate::{M, N, P, Q};
        match (z, y) {
            (Q(a), P(b)) if a == b => Polynomial::constant(Rational::ONE),
            (P(a), Q(b)) if a == b => Polynomial::constant(Rational::MINUS_ONE),
            (M(a, b), M(c, d)) | (N(a, b), N(c, d)) => self.minus_f(M, [a, b, c, d]),
            (M(a, b), N(c, d)) | (N(a, b), M(c, d)) => self.minus_f(N, [a, b, c, d]),
            _ => Polynomial::zero(),
        }
    }

    fn minus_f(&self, entry: fn(usize, usize) -> Coordinate, [a, b, c, d]: [usize; 4]) -> Polynomial {
        let mut sum = Polynomial::zero();
        let mut add = |holds: bool, i: usize, j: usize, sign: i64| {
            if holds {
                sum.add_scaled(&self.skew(entry, i, j), &Rational::from(sign));
            }
        };
        add(a == d, c, b, 1);
        add(c == b, a, d, -1);
        add(a == c, d, b, -1);
        add(d == b, a, c, 1);
        sum
    }
}
