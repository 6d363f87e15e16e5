//! The mass matrix of a sum of energies on a basis of the admissible velocities.
//!
//! An energy is a constant form in the velocity of its frame, `Oh = phi^-1 phi_dot`, `Om = phi_dot phi^-1` or `phi_dot`. On
//! velocities of another frame its matrix is the pull-back by that linear map, a polynomial in what is known of the
//! placement: on `phi_dot` in `phi^-1`, on a basis of the Lie algebra of a group in `phi` as well, which is short there.

use crate::algebra::ring::{self, Square, pairs, product, sum, table, transpose};
use crate::algebra::{Arena, Polynomial, Rational};
use crate::mechanics::direction::{BasisVector, entries};
use crate::mechanics::kinetic::Kinetic;
use crate::mechanics::metric::Definitions;
use crate::mechanics::term::Frame;
use crate::mechanics::transport;
use crate::symbol::Quantity;

use super::placed::{Placed, matrix};

/// The mass matrix over `(x_dot, phi_dot)` in blocks: centre of mass and internal motion do not mix. It is the configuration
/// metric `Gamma` (end of section 4).
#[derive(Clone, Debug)]
pub struct Metric {
    /// `phi^-1` and what else the entries share.
    pub shared: Definitions,
    /// Over `phi_dot`, row and column `n i + A`.
    pub internal: Square<Polynomial>,
    /// Over `x_dot`; empty without translation.
    pub centre: Square<Polynomial>,
}

impl Metric {
    /// That of a sum of energies.
    pub fn new(arena: &mut Arena, dim: usize, parts: &[Kinetic]) -> Self {
        let mut placed = Placed::new(arena, dim, None);
        let internal = mass_matrix(arena, &mut placed, parts, Frame::Flat, &entries(dim * dim));
        let mut centre = Vec::new();
        for translation in parts.iter().filter_map(|part| part.translation) {
            let mass = Polynomial::normal_form(arena, translation.mass);
            let entry = |i: usize, j: usize| match translation.frame {
                Frame::Body => placed.cauchy(arena, i, j).mul(&mass),
                _ if i == j => mass.clone(),
                _ => Polynomial::zero(),
            };
            let form = table(dim, entry);
            centre = if centre.is_empty() { form } else { sum(&centre, &form) };
        }
        Self { shared: placed.shared, internal, centre }
    }
}

/// The matrix of a sum of energies on a basis of velocities of `frame`.
pub(super) fn mass_matrix(
    arena: &mut Arena,
    placed: &mut Placed,
    parts: &[Kinetic],
    frame: Frame,
    basis: &[BasisVector],
) -> Square<Polynomial> {
    let mut matrix = table(basis.len(), |_, _| Polynomial::zero());
    for part in parts {
        for form in forms(part, frame) {
            matrix = sum(&matrix, &placed.pulled_back(arena, (&form, part.frame), frame, basis));
        }
    }
    matrix
}

/// The forms of an energy that are pulled back each for itself. On `phi_dot` those of its terms, since products of rows are
/// short by themselves; on a Lie algebra all together, since they share the velocities of their frame.
fn forms(part: &Kinetic, frame: Frame) -> Vec<Square<Polynomial>> {
    if frame != Frame::Flat || part.frame == frame {
        return vec![part.form()];
    }
    let term = |(place, energy): &(usize, Polynomial)| part.only(*place, energy).form();
    let (by_rows, others): (Vec<_>, Vec<_>) = part
        .internal
        .iter()
        .map(term)
        .partition(|form| part.frame == Frame::Space && same_blocks(form, part.dim));
    let by_rows = by_rows.into_iter().reduce(|left, right| sum(&left, &right));
    by_rows.into_iter().chain(others).collect()
}

impl Placed {
    /// The matrix of a form in the velocity of `own` on a basis of velocities of `frame`.
    fn pulled_back(
        &mut self,
        arena: &mut Arena,
        (form, own): (&Square<Polynomial>, Frame),
        frame: Frame,
        basis: &[BasisVector],
    ) -> Square<Polynomial> {
        let n = self.phi.len();
        match (own, frame) {
            _ if own == frame => {
                table(basis.len(), |k, l| along(&basis[k], |a| along(&basis[l], |b| form[a][b].clone())))
            }
            (Frame::Flat, _) if same_blocks(form, n) => {
                let inertia = table(n, |a, b| form[a][b].clone());
                by_rows(&inertia, &self.green, basis)
            }
            (Frame::Space, _) if same_blocks(form, n) => {
                let inertia = self.turned_inertia(arena, form);
                let unit = ring::scalar(n, &Polynomial::constant(Rational::ONE));
                // On phi_dot no G comes in; where G is a multiple of 1, the inertia contains it.
                let is_plain = frame == Frame::Flat || self.inverse_square.is_some();
                by_rows(&inertia, if is_plain { &unit } else { &self.green }, basis)
            }
            (Frame::Body, Frame::Flat) => {
                // Oh_CA = psi_Ci phi_dot_iA
                let mut entry = |(i, a): (usize, usize), (j, b): (usize, usize)| {
                    let block = table(n, |c, d| form[n * c + a][n * d + b].clone());
                    self.between_columns(arena, &block, i, j)
                };
                let places = || pairs(n);
                places().map(|row| places().map(|column| entry(row, column)).collect()).collect()
            }
            _ => {
                let velocities: Vec<Square<Polynomial>> = basis
                    .iter()
                    .enumerate()
                    .map(|(k, e)| self.seen_from(arena, own, frame, (k, &square(e, n))))
                    .collect();
                paired(form, &velocities)
            }
        }
    }

    /// The velocity in the frame `own` that a velocity of `frame` is.
    fn seen_from(
        &mut self,
        arena: &mut Arena,
        own: Frame,
        frame: Frame,
        (k, e): (usize, &Square<Polynomial>),
    ) -> Square<Polynomial> {
        let phi_dot = transport::velocity(frame, e, &self.phi);
        let value = transport::velocity(own, &phi_dot, &self.inverse);
        match (own, frame) {
            (Frame::Flat, _) | (_, Frame::Flat) => value,
            _ => matrix(arena, &mut self.shared, Quantity::TurnedVelocity.at([k + 1]), &value),
        }
    }

    /// `psi_Ci h_CD psi_Dj`, through `C = phi^-T phi^-1` where `h` is a multiple of the identity.
    fn between_columns(
        &mut self,
        arena: &mut Arena,
        h: &Square<Polynomial>,
        i: usize,
        j: usize,
    ) -> Polynomial {
        let n = h.len();
        if *h == ring::scalar(n, &h[0][0]) && !h[0][0].is_zero() {
            return h[0][0].mul(&self.cauchy(arena, i, j));
        }
        pairs(n).map(|(c, d)| h[c][d].mul(&self.inverse[c][i].mul(&self.inverse[d][j]))).sum()
    }

    /// `C_ij = psi_Ai psi_Aj`, by a name that is defined once.
    fn cauchy(&mut self, arena: &mut Arena, i: usize, j: usize) -> Polynomial {
        let (i, j) = (i.min(j), i.max(j));
        let symbol = arena.symbol(Quantity::Cauchy.at([i + 1, j + 1]));
        if !self.shared.iter().any(|(known, _)| *known == symbol) {
            let value: Polynomial = self.inverse.iter().map(|row| row[i].mul(&row[j])).sum();
            self.shared.push((symbol, value));
        }
        Polynomial::atom(symbol)
    }

    /// `phi^-1 J phi^-T` of an energy `tr(Om J Om^T)/2`; on SO(n) and R+ SO(n) times `D^2`.
    fn turned_inertia(&mut self, arena: &mut Arena, form: &Square<Polynomial>) -> Square<Polynomial> {
        let n = self.phi.len();
        let j = table(n, |a, b| form[a][b].clone());
        let value = match &self.inverse_square {
            None => product(&product(&self.inverse, &j), &transpose(&self.inverse)),
            Some(factor) => {
                let turned = product(&product(&transpose(&self.phi), &j), &self.phi);
                ring::multiple(&turned, factor)
            }
        };
        // One name for both triangles.
        let upper = table(n, |a, b| value[a.min(b)][a.max(b)].clone());
        let mut result = upper.clone();
        for (a, b) in ring::upper(n) {
            let symbol = arena.symbol(Quantity::SpaceInertia.at([a + 1, b + 1]));
            self.shared.push((symbol, upper[a][b].clone()));
            result[a][b] = Polynomial::atom(symbol);
            result[b][a] = Polynomial::atom(symbol);
        }
        result
    }
}

/// `tr(e_k M e_l^T G)`, of an energy `tr(phi e M e^T phi^T)/2`.
fn by_rows(
    inertia: &Square<Polynomial>,
    green: &Square<Polynomial>,
    basis: &[BasisVector],
) -> Square<Polynomial> {
    let n = inertia.len();
    table(basis.len(), |k, l| {
        along(&basis[k], |left| {
            along(&basis[l], |right| {
                // Entries (C, A) and (D, B).
                green[left / n][right / n].mul(&inertia[left % n][right % n])
            })
        })
    })
}

/// `sum over the entries of e of weight value(place)`.
pub(super) fn along(e: &BasisVector, value: impl Fn(usize) -> Polynomial) -> Polynomial {
    e.entries.iter().map(|(k, weight)| value(*k).scaled(weight)).sum()
}

/// A direction as a matrix.
fn square(e: &BasisVector, n: usize) -> Square<Polynomial> {
    table(n, |a, b| along(e, |k| Polynomial::constant(Rational::from(i64::from(k == n * a + b)))))
}

/// A form at pairs of velocities.
fn paired(form: &Square<Polynomial>, velocities: &[Square<Polynomial>]) -> Square<Polynomial> {
    let flat: Vec<Vec<Polynomial>> = velocities.iter().map(|v| v.concat()).collect();
    table(flat.len(), |k, l| {
        let mut sum = Polynomial::zero();
        for (row, left) in form.iter().zip(&flat[k]).filter(|(_, left)| !left.is_zero()) {
            for (value, right) in row.iter().zip(&flat[l]).filter(|(value, _)| !value.is_zero()) {
                sum.add_product(&left.mul(right), value, &Rational::ONE);
            }
        }
        sum
    })
}

/// Is a form over `Om` the same for every row of `Om`, and free of products of two rows: `1/2 tr(Om J Om^T)`?
pub(super) fn same_blocks(form: &Square<Polynomial>, n: usize) -> bool {
    let entry = |i: usize, k: usize, j: usize, l: usize| &form[n * i + k][n * j + l];
    let indices = || pairs(n);
    indices().all(|(i, j)| {
        indices().all(|(k, l)| match i == j {
            true => entry(i, k, i, l) == entry(0, k, 0, l),
            false => entry(i, k, j, l).is_zero(),
        })
    })
}
