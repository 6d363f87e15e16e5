//! The mass matrix over `(x_dot, phi_dot)` of any kinetic energy: the configuration metric `Gamma` (end of section 4).
//!
//! A term is a constant form in the velocity of its frame, `Oh = phi^-1 phi_dot`, `Om = phi_dot phi^-1` or `phi_dot`;
//! its matrix over `phi_dot` is the pull-back by that linear map, a polynomial in `phi^-1`.

use crate::algebra::ring::{Square, adjugate, table};
use crate::algebra::{Arena, Expr, Matrix, Polynomial, Rational};
use crate::symbol::{Quantity, Symbol};

use super::kinetic::Kinetic;
use super::term::Frame;

/// Quantities with their definitions, each in earlier ones.
pub type Definitions = Vec<(Expr, Polynomial)>;

/// The mass matrix in blocks: centre of mass and internal motion do not mix.
#[derive(Clone, Debug)]
pub struct Metric {
    /// `phi^-1` and what else the entries share.
    pub shared: Definitions,
    /// Over `phi_dot`, row and column `n i + A`.
    pub internal: Square<Polynomial>,
    /// Over `x_dot`; empty without translation.
    pub centre: Square<Polynomial>,
}

/// `phi^-1 = adj(phi)/det phi`, entry `[A][i]`, as quantities with their definitions.
pub fn inverse_placement(arena: &mut Arena, dim: usize) -> (Matrix, Definitions) {
    let phi = Matrix::symbols(arena, Quantity::Placement, dim);
    let phi: Square<Polynomial> = table(dim, |i, a| Polynomial::atom(phi.0[i][a]));
    let (det, inverse_det) =
        (arena.symbol(Quantity::Determinant), arena.symbol(Quantity::InverseDeterminant));
    let cofactors = adjugate(&phi);
    let mut determinant = Polynomial::zero();
    for (entry, row) in phi[0].iter().zip(&cofactors) {
        determinant.add_product(entry, &row[0], &Rational::ONE);
    }
    // A symbol is not the number zero.
    let reciprocal = Polynomial::atom(arena.reciprocal(det));
    let mut shared = vec![(det, determinant), (inverse_det, reciprocal)];
    let inverse = Matrix::symbols(arena, Quantity::InversePlacement, dim);
    for (symbol, cofactor) in inverse.0.iter().flatten().zip(cofactors.iter().flatten()) {
        shared.push((*symbol, cofactor.mul(&Polynomial::atom(inverse_det))));
    }
    (inverse, shared)
}

impl Metric {
    /// The mass matrix of a sum of energies, each in a frame of its own.
    pub fn new(arena: &mut Arena, dim: usize, parts: &[Kinetic]) -> Self {
        let (inverse, shared) = inverse_placement(arena, dim);
        let mut pull_back = PullBack { arena, dim, inverse, shared };
        let mut internal = vec![vec![Polynomial::zero(); dim * dim]; dim * dim];
        for part in parts {
            let velocities = part.velocity.0.concat();
            for (_, energy) in &part.internal {
                let slopes = energy.gradient(&velocities);
                let form = slopes.iter().map(|slope| slope.gradient(&velocities)).collect();
                pull_back.add(&mut internal, part.frame, &form);
            }
        }
        let centre = pull_back.centre(parts);
        Self { shared: pull_back.shared, internal, centre }
    }
}

/// Pulls forms back to `phi_dot` and `x_dot`, and keeps what several entries share.
struct PullBack<'a> {
    arena: &'a mut Arena,
    dim: usize,
    /// `phi^-1`.
    inverse: Matrix,
    shared: Definitions,
}

impl PullBack<'_> {
    /// Adds the matrix of a form over the velocity of `frame`.
    fn add(&mut self, sum: &mut Square<Polynomial>, frame: Frame, form: &Square<Polynomial>) {
        let n = self.dim;
        let pairs = move || (0..n).flat_map(move |a| (0..n).map(move |b| (a, b)));
        for (i, a) in pairs() {
            for (j, b) in pairs() {
                let entry = match frame {
                    Frame::Flat => form[n * i + a][n * j + b].clone(),
                    // Oh_CA = psi_Ci phi_dot_iA
                    Frame::Body => {
                        let block = table(n, |c, d| form[n * c + a][n * d + b].clone());
                        self.left(&block, i, j)
                    }
                    // Om_ik = phi_dot_iA psi_Ak
                    Frame::Space => {
                        let block = table(n, |k, l| form[n * i + k][n * j + l].clone());
                        let alike = same_blocks(form, n);
                        self.right(&block, alike, (i, j), (a, b))
                    }
                };
                sum[n * i + a][n * j + b].add_scaled(&entry, &Rational::ONE);
            }
        }
    }

    /// `psi_Ci h_CD psi_Dj`, through `C = phi^-T phi^-1` where `h` is a multiple of the identity.
    fn left(&mut self, h: &Square<Polynomial>, i: usize, j: usize) -> Polynomial {
        let n = self.dim;
        let scalar = table(n, |c, d| if c == d { h[0][0].clone() } else { Polynomial::zero() });
        if *h == scalar && !h[0][0].is_zero() {
            return h[0][0].mul(&self.cauchy(i, j));
        }
        let psi = &self.inverse.0;
        let mut sum = Polynomial::zero();
        for (c, d) in (0..n).flat_map(|c| (0..n).map(move |d| (c, d))) {
            sum.add_product(
                &h[c][d],
                &Polynomial::term(vec![psi[c][i], psi[d][j]], Rational::ONE),
                &Rational::ONE,
            );
        }
        sum
    }

    /// `psi_Ak h_kl psi_Bl`; named where the form is the same for every row of `phi_dot`, `i = j`, and zero else.
    fn right(
        &mut self,
        h: &Square<Polynomial>,
        alike: bool,
        (i, j): (usize, usize),
        (a, b): (usize, usize),
    ) -> Polynomial {
        let (n, psi) = (self.dim, &self.inverse.0);
        let named = alike && i == j;
        let (a, b) = if named { (a.min(b), a.max(b)) } else { (a, b) };
        let mut sum = Polynomial::zero();
        for (k, l) in (0..n).flat_map(|k| (0..n).map(move |l| (k, l))) {
            sum.add_product(
                &h[k][l],
                &Polynomial::term(vec![psi[a][k], psi[b][l]], Rational::ONE),
                &Rational::ONE,
            );
        }
        match named {
            true => self.named(Quantity::SpaceInertia.at([a + 1, b + 1]), sum),
            false => sum,
        }
    }

    /// `C_ij = psi_Ai psi_Aj`.
    fn cauchy(&mut self, i: usize, j: usize) -> Polynomial {
        let (i, j) = (i.min(j), i.max(j));
        let mut sum = Polynomial::zero();
        self.inverse.0.iter().for_each(|row| sum.add_term(vec![row[i], row[j]], &Rational::ONE));
        self.named(Quantity::Cauchy.at([i + 1, j + 1]), sum)
    }

    /// A quantity that is defined once.
    fn named(&mut self, symbol: Symbol, value: Polynomial) -> Polynomial {
        let symbol = self.arena.symbol(symbol);
        if !self.shared.iter().any(|(known, _)| *known == symbol) {
            self.shared.push((symbol, value));
        }
        Polynomial::atom(symbol)
    }

    /// `m_space 1 + m_body C`.
    fn centre(&mut self, parts: &[Kinetic]) -> Square<Polynomial> {
        let n = self.dim;
        let translations: Vec<_> = parts.iter().filter_map(|part| part.translation).collect();
        if translations.is_empty() {
            return Vec::new();
        }
        let mut form = vec![vec![Polynomial::zero(); n]; n];
        for translation in translations {
            let mass = Polynomial::normal_form(self.arena, translation.mass);
            for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
                let entry = match translation.frame {
                    Frame::Body => self.cauchy(i, j),
                    _ if i == j => Polynomial::constant(Rational::ONE),
                    _ => Polynomial::zero(),
                };
                form[i][j].add_product(&mass, &entry, &Rational::ONE);
            }
        }
        form
    }
}

/// Is a form over `Om` the same for every row of `Om`, and free of products of two rows: `1/2 tr(Om J Om^T)`?
pub(super) fn same_blocks(form: &Square<Polynomial>, n: usize) -> bool {
    let entry = |i: usize, k: usize, j: usize, l: usize| &form[n * i + k][n * j + l];
    let indices = || (0..n).flat_map(|k| (0..n).map(move |l| (k, l)));
    indices().all(|(i, j)| {
        indices().all(|(k, l)| match i == j {
            true => entry(i, k, i, l) == entry(0, k, 0, l),
            false => entry(i, k, j, l).is_zero(),
        })
    })
}
