//! The two-polar form `phi = L D R^T` (section 6): a lattice of stretches, coupled by `M` and `N`.
//!
//! ```text
//! rho_hat = L^T S L,  tau_hat = -R^T Vort R,  M = -rho_hat - tau_hat,  N = rho_hat - tau_hat
//! Z_aa = p_a,  Z_ab = (N_ab/ch x_ab - M_ab/sh x_ab)/4,  x_ab = (q_a - q_b)/2,  C(k) = tr Z^k           (6.1)
//! ```
//!
//! From these and the brackets of `q, p, M, N` everything else is derived. The paper prints the last two terms of
//! `{M, M}` and `{M, N}` with the opposite sign, which is not antisymmetric in the indices, and calls `tau_hat` the
//! vorticity, which is `-tau_hat`.

mod describe;
mod frames;
mod lattice;
mod pieces;
mod ratios;
mod stable;

use crate::algebra::fault::never_missing;
use crate::algebra::substitute::listed;
use crate::algebra::{Arena, Expr, Function, Polynomial, Rational};

use super::hamiltonian::Hamiltonian;
use super::potential::OnAxes;
use super::term::Frame;

pub use describe::formulas;
pub use frames::Frames;
pub use lattice::{Coordinate, Lattice, Variables};
pub use pieces::{Piece, Pieces, Turn};
pub use ratios::Ratios;
pub use stable::Stable;

/// The equations of the lattice.
#[derive(Clone, Debug)]
pub struct Equations {
    /// `H`, the potential apart.
    pub kinetic: Polynomial,
    /// Coordinates and their kinetic rates.
    pub rates: Vec<(Coordinate, Expr, Polynomial)>,
    /// `chi_hat_ab`, `a < b`, of `dL/dt = L chi_hat`.
    pub chi: Vec<Polynomial>,
    /// `theta_hat_ab`, `a < b`, of `dR/dt = R theta_hat`.
    pub theta: Vec<Polynomial>,
}

impl Lattice {
    /// The kinetic Hamiltonian: of isotropic affine models from `tr Z^k` and `rho_hat` or `tau_hat`, of d'Alembert's from
    /// `P = R^T Pi L`, `P_ab = (M_ab/(Q_b - Q_a) + N_ab/(Q_a + Q_b))/2`. Both are functions of `R^T .. L` alone since the
    /// energy is invariant under rotations of space and body.
    pub fn hamiltonian(&self, arena: &mut Arena, h: &Hamiltonian) -> Polynomial {
        match &h.isotropic {
            // (89): Z is Hermitian, Z_ab = (M_ab/sin x_ab + i N_ab/cos x_ab)/4.
            Some(iso) if self.variables == Variables::Angles => {
                let mut places = vec![vec![Polynomial::zero(); self.dim]; self.dim];
                (0..self.dim).for_each(|a| places[a][a] = Polynomial::atom(self.p[a]));
                let mut sum = iso.casimirs(&places);
                for (a, b) in self.pairs() {
                    let [m, n] = self.coupled(arena, a, b);
                    for z in [m, n] {
                        sum.add_product(
                            &z.mul(&z),
                            &iso.casimir2,
                            &(&Rational::QUARTER * &Rational::QUARTER),
                        );
                    }
                }
                sum
            }
            Some(iso) => {
                let z = self.momentum_on_axes(arena, &Rational::QUARTER);
                let mut sum = iso.casimirs(&z);
                sum.add_scaled(&iso.skew_norm(&self.conserved_spin(h.frame)), &Rational::ONE);
                sum
            }
            None => {
                let p = self.momentum_on_axes(arena, &Rational::HALF);
                let entry = |atom: Expr| {
                    let place = h.momentum.0.iter().flatten().position(|entry| *entry == atom)?;
                    Some(p[place / self.dim][place % self.dim].clone())
                };
                h.internal().substitute(&entry)
            }
        }
    }

    /// `p_a` on the diagonal, `weight (N_ab/even_ab - M_ab/odd_ab)` beside it, with the even and the odd function of the
    /// places of `a` and `b`.
    fn momentum_on_axes(&self, arena: &mut Arena, weight: &Rational) -> Vec<Vec<Polynomial>> {
        let mut rows = vec![vec![Polynomial::zero(); self.dim]; self.dim];
        for (a, b) in self.pairs() {
            let [m, n] = self.coupled(arena, a, b);
            rows[a][b].add_scaled(&n, weight);
            rows[a][b].add_scaled(&m, &-weight);
            // M and the odd function change their signs, N alone changes its own.
            rows[b][a].add_scaled(&n, &-weight);
            rows[b][a].add_scaled(&m, &-weight);
        }
        for (a, p) in self.p.iter().enumerate() {
            rows[a][a] = Polynomial::atom(*p);
        }
        rows
    }

    /// `M_ab/odd_ab` and `N_ab/even_ab`.
    fn coupled(&self, arena: &mut Arena, a: usize, b: usize) -> [Polynomial; 2] {
        // Functions of symbols are not the number zero.
        let [odd, even] = self.couplings(arena, a, b).map(|e| Polynomial::atom(arena.reciprocal(e)));
        [self.skew(Coordinate::M, a, b).mul(&odd), self.skew(Coordinate::N, a, b).mul(&even)]
    }

    /// `sh x_ab` and `ch x_ab`, `sin x_ab` and `cos x_ab`, or `Q_a - Q_b` and `Q_a + Q_b`, `a < b`.
    fn couplings(&self, arena: &mut Arena, a: usize, b: usize) -> [Expr; 2] {
        let (qa, qb) = (self.q[a], self.q[b]);
        let mut of_half = |functions: [Function; 2]| {
            let x = arena.linear(&[(qa, Rational::HALF), (qb, -&Rational::HALF)]);
            functions.map(|function| arena.apply(function, x))
        };
        match self.variables {
            Variables::LogStretches => of_half([Function::Sinh, Function::Cosh]),
            Variables::Angles => of_half([Function::Sin, Function::Cos]),
            Variables::Stretches => [arena.sub(qa, qb), arena.add(qa, qb)],
        }
    }

    /// A matrix `X` with `X - X^T = tau_hat` (body) or `rho_hat` (space): `|Vort|^2` and `|S|^2` in the energy.
    fn conserved_spin(&self, frame: Frame) -> Vec<Vec<Polynomial>> {
        let mut rows = vec![vec![Polynomial::zero(); self.dim]; self.dim];
        let sign = if frame == Frame::Body { Rational::HALF } else { -&Rational::HALF };
        for (a, b) in self.pairs() {
            // tau_hat = -(N + M)/2, rho_hat = (N - M)/2; the norm is even.
            rows[a][b].add_scaled(&self.skew(Coordinate::N, a, b), &Rational::HALF);
            rows[a][b].add_scaled(&self.skew(Coordinate::M, a, b), &sign);
        }
        rows
    }

    /// `dz/dt = sum over y of {z, y} dH/dy`, and the rotation of the frames: with `rho_hat_ab` and `tau_hat_ab`, `a < b`,
    /// as independent momenta, `chi_hat_ab = -dH/drho_hat_ab = dH/dM_ab - dH/dN_ab` and
    /// `theta_hat_ab = -dH/dtau_hat_ab = dH/dM_ab + dH/dN_ab`.
    pub fn equations(&self, arena: &mut Arena, h: &Hamiltonian) -> Equations {
        let kinetic = self.hamiltonian(arena, h);
        self.equations_of(arena, kinetic)
    }

    /// The same of a part of the energy.
    fn equations_of(&self, arena: &mut Arena, kinetic: Polynomial) -> Equations {
        let energy = kinetic.expression(arena);
        let coordinates = self.coordinates();
        let mut slope = |z: Coordinate| {
            let slope = arena.derivative(energy, self.symbol(z));
            Polynomial::normal_form(arena, slope)
        };
        let slopes: Vec<(Coordinate, Polynomial)> = coordinates.iter().map(|z| (*z, slope(*z))).collect();
        let rate = |z: Coordinate| slopes.iter().map(|(y, slope)| self.bracket(z, *y).mul(slope)).sum();
        let rates = coordinates.iter().map(|z| (*z, self.symbol(*z), rate(*z))).collect();
        let of = |z: Coordinate| {
            never_missing(listed(&slopes)(z), "there is a slope along every coordinate", Polynomial::zero())
        };
        let angular = |sign: Rational| {
            let one = |(a, b)| {
                let mut sum = of(Coordinate::M(a, b));
                sum.add_scaled(&of(Coordinate::N(a, b)), &sign);
                sum
            };
            self.pairs().map(one).collect()
        };
        Equations { kinetic, rates, chi: angular(Rational::MINUS_ONE), theta: angular(Rational::ONE) }
    }
}

impl Equations {
    /// Adds the forces of a potential to the rates of the momenta.
    pub fn add(&mut self, potential: &OnAxes) {
        for (z, _, rate) in &mut self.rates {
            if let Coordinate::P(a) = z {
                rate.add_scaled(&potential.forces[*a], &Rational::ONE);
            }
        }
    }
}
