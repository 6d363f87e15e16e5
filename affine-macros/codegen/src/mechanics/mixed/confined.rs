//! The mass matrix of a sum of energies on the Lie algebra of a group, and its inverse.
//!
//! Velocities `phi_dot = phi Oh` have `Oh` in the Lie algebra `g`; of `Oh`, `Om = phi Oh phi^-1` and `phi_dot` each energy
//! has constant coefficients in one. On a basis of `g` their sum is a mass matrix that depends on `phi` in the group alone,
//! where `phi^-1` and `phi^T phi` are short.

use crate::algebra::ring::{Square, product, sum, table, transpose};
use crate::algebra::{Arena, Expr, Matrix, Polynomial, Rational};
use crate::mechanics::charts::Chart;
use crate::mechanics::constraint::Constraint;
use crate::mechanics::direction::{BasisVector, invariant};
use crate::mechanics::kinetic::Kinetic;
use crate::mechanics::metric::{Definitions, same_blocks};
use crate::mechanics::term::Frame;
use crate::symbol::{Factorised, Quantity};

use super::Mixed;
use super::factorisation::Factorisation;
use super::parts::hessian;
use super::placed::{Placed, matrix};

/// An inverse Legendre transformation.
pub(super) struct Solved {
    /// Quantities on the way from placement and momentum to the velocity, all of its entries included.
    pub(super) shared: Definitions,
    /// Momenta and velocities along a basis.
    pub(super) components: Vec<(Polynomial, Expr)>,
    /// The factorised mass matrix on that basis.
    pub(super) factorisation: Factorisation,
}

/// The velocity `Oh` in the Lie algebra; `None` where the mass matrix is singular at every placement of the group.
pub(super) fn on_the_algebra(
    arena: &mut Arena,
    mixed: &Mixed,
    chart: &Chart,
    group: Constraint,
) -> Option<Solved> {
    let n = mixed.dim;
    // The first basis that there is: its vectors have the fewest entries.
    let basis = group.bases(n, invariant(n)).swap_remove(0);
    let mut placed = Placed::new(arena, n, Some(group));
    let mut matrix = table(basis.len(), |_, _| Polynomial::zero());
    for part in &mixed.internal {
        matrix = sum(&matrix, &placed.mass_matrix(arena, part, &basis));
    }
    let mut shared = placed.shared;
    let factorisation = Factorisation::new(arena, Factorised::Internal, &matrix, &mut shared, chart)?;
    let dependent = chart.dependent();
    let value = |atom: Expr| dependent.iter().find(|(s, _)| *s == atom).map(|(_, value)| value.clone());
    // The momentum conjugate to Oh_ab is Sigma_hat_ba.
    let conjugate = chart.m.transpose().0.concat();
    let momenta: Vec<Polynomial> =
        basis.iter().map(|e| along(e, |k| Polynomial::atom(conjugate[k])).substitute(&value)).collect();
    let speeds = arena.components(Quantity::Speed, basis.len());
    factorisation.solve(arena, Factorised::Internal, &momenta, &speeds, &mut shared);
    let velocity = Matrix::symbols(arena, Frame::Body.velocity(), n);
    for (k, symbol) in velocity.0.concat().into_iter().enumerate() {
        let mut entry = Polynomial::zero();
        for (e, speed) in basis.iter().zip(&speeds) {
            let here = e.entries.iter().filter(|(place, _)| *place == k);
            here.for_each(|(_, weight)| entry.add_term(vec![*speed], weight));
        }
        shared.push((symbol, entry));
    }
    Some(Solved { shared, components: momenta.into_iter().zip(speeds).collect(), factorisation })
}

/// `sum over the entries of e of weight value(place)`.
fn along(e: &BasisVector, value: impl Fn(usize) -> Polynomial) -> Polynomial {
    let mut sum = Polynomial::zero();
    e.entries.iter().for_each(|(k, weight)| sum.add_scaled(&value(*k), weight));
    sum
}

impl Placed {
    /// The matrix of an energy on a basis of the Lie algebra.
    fn mass_matrix(
        &mut self,
        arena: &mut Arena,
        part: &Kinetic,
        basis: &[BasisVector],
    ) -> Square<Polynomial> {
        let form = hessian(part);
        let n = part.dim;
        match part.frame {
            Frame::Body => {
                table(basis.len(), |k, l| along(&basis[k], |a| along(&basis[l], |b| form[a][b].clone())))
            }
            Frame::Flat if same_blocks(&form, n) => {
                let inertia = table(n, |a, b| form[a][b].clone());
                self.by_rows(&inertia, true, basis)
            }
            Frame::Space if same_blocks(&form, n) => {
                let inertia = self.turned_inertia(arena, &form);
                self.by_rows(&inertia, self.inverse_square.is_none(), basis)
            }
            Frame::Flat => {
                let velocities: Vec<Square<Polynomial>> =
                    basis.iter().map(|e| product(&self.phi, &square(e, n))).collect();
                paired(&form, &velocities)
            }
            Frame::Space => {
                let mut velocities = Vec::with_capacity(basis.len());
                for (k, e) in basis.iter().enumerate() {
                    let value = product(&product(&self.phi, &square(e, n)), &self.inverse);
                    velocities.push(matrix(
                        arena,
                        &mut self.shared,
                        Quantity::TurnedVelocity.at([k + 1]),
                        &value,
                    ));
                }
                paired(&form, &velocities)
            }
        }
    }

    /// `tr(e_k M e_l^T G)`, of an energy `tr(phi e M e^T phi^T)/2`; with 1 for `G` where `M` contains its trace.
    fn by_rows(
        &self,
        inertia: &Square<Polynomial>,
        with_green: bool,
        basis: &[BasisVector],
    ) -> Square<Polynomial> {
        let n = inertia.len();
        let one = |a: usize, b: usize| Polynomial::constant(Rational::from(i64::from(a == b)));
        let green = if with_green { self.green.clone() } else { table(n, one) };
        table(basis.len(), |k, l| {
            along(&basis[k], |left| {
                along(&basis[l], |right| {
                    // Entries (C, A) and (D, B).
                    green[left / n][right / n].mul(&inertia[left % n][right % n])
                })
            })
        })
    }

    /// `phi^-1 J phi^-T` of an energy `tr(Om J Om^T)/2`; on SO(n) and R+ SO(n) times `D^2`.
    fn turned_inertia(&mut self, arena: &mut Arena, form: &Square<Polynomial>) -> Square<Polynomial> {
        let n = self.phi.len();
        let j = table(n, |a, b| form[a][b].clone());
        let value = match &self.inverse_square {
            None => product(&product(&self.inverse, &j), &transpose(&self.inverse)),
            Some(factor) => {
                let turned = product(&product(&transpose(&self.phi), &j), &self.phi);
                table(n, |a, b| turned[a][b].mul(factor))
            }
        };
        // One name for both triangles.
        let upper = table(n, |a, b| value[a.min(b)][a.max(b)].clone());
        let mut result = upper.clone();
        for (a, b) in (0..n).flat_map(|a| (a..n).map(move |b| (a, b))) {
            let symbol = arena.symbol(Quantity::SpaceInertia.at([a + 1, b + 1]));
            self.shared.push((symbol, upper[a][b].clone()));
            result[a][b] = Polynomial::atom(symbol);
            result[b][a] = Polynomial::atom(symbol);
        }
        result
    }
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
