//! The internal motion of a sum of energies that is confined to a group.
//!
//! Velocities `phi_dot = phi Oh` have `Oh` in the Lie algebra `g`; of `Oh`, `Om = phi Oh phi^-1` and `phi_dot` each energy
//! has constant coefficients in one. On a basis of `g` their sum is a mass matrix that depends on `phi` in the group alone,
//! where `phi^-1` and `phi^T phi` are short. Momenta are `P Sigma_hat`, with `Sigma_hat = (dT/dOh)^T` at fixed `phi`, and
//!
//! ```text
//! dSigma_hat/dt = P([Sigma_hat, Oh] + (dT/dphi)^T phi),   dT/dphi at fixed Oh.
//! ```
//!
//! Of the energy in `Om` the two summands cancel, of that in `Oh` the first is left, and of that in `phi_dot`, with
//! `X = (dT/dphi_dot)^T phi`, it is `[X, Oh] + Oh X = X Oh`.

use crate::algebra::ring::{Square, adjugate, product, table, transpose};
use crate::algebra::{Arena, Expr, Matrix, Polynomial, Rational};
use crate::mechanics::charts::{Chart, Coordinate, Momentum};
use crate::mechanics::constraint::Constraint;
use crate::mechanics::direction::{BasisVector, invariant};
use crate::mechanics::equations::System;
use crate::mechanics::kinetic::Kinetic;
use crate::mechanics::metric::{Definitions, same_blocks};
use crate::mechanics::potential::Base;
use crate::mechanics::term::Frame;
use crate::mechanics::weight::Weight;

use super::Mixed;
use super::factorisation::Factorisation;
use super::motion::{Legendre, add, atoms, named};
use super::sample::Sample;

/// The inverse Legendre transformation and the equations of the internal motion.
#[derive(Clone, Debug)]
pub struct Confined {
    /// The group.
    pub group: Constraint,
    /// Quantities on the way from `phi` and `P Sigma_hat` to `Oh`, all entries of that included.
    pub shared: Definitions,
    /// `Oh` as symbols, defined among the shared quantities.
    pub velocity: Matrix,
    /// Momenta and velocities along a basis of the Lie algebra.
    components: Vec<(Polynomial, Expr)>,
    /// The factorised mass matrix on a basis of the Lie algebra.
    pub factorisation: Factorisation,
}

impl Confined {
    /// Inverts the Legendre transformation; `None` where the mass matrix is singular at every placement of the group.
    pub fn new(arena: &mut Arena, mixed: &Mixed, group: Constraint) -> Option<Self> {
        let n = mixed.dim;
        // The first basis that there is: its vectors have the fewest entries.
        let basis = group.bases(n, invariant(n)).swap_remove(0);
        let mut placed = Placed::new(arena, n, group);
        let mut matrix = vec![vec![Polynomial::zero(); basis.len()]; basis.len()];
        for part in &mixed.internal {
            add(&mut matrix, &placed.mass_matrix(arena, part, &basis), &Rational::ONE);
        }
        let mut shared = placed.shared;
        let chart = Chart::new(arena, n, Momentum::Body, None).under(Some(group));
        let points = [Sample::on_the_group(arena, &chart, group, 0), Sample::undeformed()];
        let factorisation = Factorisation::at(arena, "", &matrix, &mut shared, points)?;
        let dependent = chart.dependent();
        let value = |atom: Expr| dependent.iter().find(|(s, _)| *s == atom).map(|(_, value)| value.clone());
        // The momentum conjugate to Oh_ab is Sigma_hat_ba.
        let conjugate = chart.m.transpose().0.concat();
        let momenta: Vec<Polynomial> =
            basis.iter().map(|e| along(e, |k| Polynomial::atom(conjugate[k])).substitute(&value)).collect();
        let speeds: Vec<Expr> = (1..=basis.len()).map(|k| arena.symbol(&format!("speed_{k}"))).collect();
        factorisation.solve(arena, "", &momenta, &speeds, &mut shared);
        let velocity = Matrix::symbols(arena, Frame::Body.velocity_name(), n);
        for (k, symbol) in velocity.0.concat().into_iter().enumerate() {
            let mut entry = Polynomial::zero();
            for (e, speed) in basis.iter().zip(&speeds) {
                e.entries
                    .iter()
                    .filter(|(place, _)| *place == k)
                    .for_each(|(_, weight)| entry.add_term(vec![*speed], weight));
            }
            shared.push((symbol, entry));
        }
        let components = momenta.into_iter().zip(speeds).collect();
        Some(Self { group, shared, velocity, components, factorisation })
    }

    /// Hamilton's equations of the internal motion.
    pub fn system(&self, arena: &mut Arena, mixed: &Mixed, chart: &Chart) -> System {
        let (phi, oh) = (atoms(&chart.phi), atoms(&self.velocity));
        let mut shared = self.shared.clone();
        let momentum_rate = self.momentum_rate(arena, mixed, &mut shared);
        let phi_rate = product(&phi, &oh);
        let rates = chart.coordinates().into_iter().filter_map(|z| match z {
            Coordinate::Phi(i, a) => Some((z, chart.symbol(z), phi_rate[i][a].clone())),
            Coordinate::M(a, b) => Some((z, chart.symbol(z), momentum_rate[a][b].clone())),
            Coordinate::X(_) | Coordinate::P(_) => Some((z, chart.symbol(z), Polynomial::zero())),
            Coordinate::Carried(_) => None,
        });
        let system = System { rates: rates.collect(), shared, ..System::default() };
        system.confined(chart, &self.velocity)
    }

    /// `[X_body, Oh] + X_flat Oh`, before it is projected.
    fn momentum_rate(
        &self,
        arena: &mut Arena,
        mixed: &Mixed,
        shared: &mut Definitions,
    ) -> Square<Polynomial> {
        let n = mixed.dim;
        let oh = atoms(&self.velocity);
        let mut rates = vec![vec![Polynomial::zero(); n]; n];
        for part in &mixed.internal {
            match part.frame {
                Frame::Space => {}
                Frame::Body => {
                    let x = named(arena, shared, "body_sigma", conjugate(part));
                    add(&mut rates, &product(&x, &oh), &Rational::ONE);
                    add(&mut rates, &product(&oh, &x), &Rational::MINUS_ONE);
                }
                Frame::Flat => {
                    let placed = Placed::new(arena, n, self.group);
                    let x = placed.flat_momentum(arena, part, shared);
                    let x = named(arena, shared, "flat_sigma", x);
                    add(&mut rates, &product(&x, &oh), &Rational::ONE);
                }
            }
        }
        rates
    }

    /// The derivatives of `H` in the chart: `dH/dSigma_hat = Oh^T`, and along `phi` at fixed `Sigma_hat` what the brackets
    /// make of it, up to forces that no velocity of the group sees; with what they share.
    pub fn slopes(
        &self,
        arena: &mut Arena,
        mixed: &Mixed,
        chart: &Chart,
    ) -> (Vec<(Coordinate, Polynomial)>, Definitions) {
        let n = mixed.dim;
        let (oh, spin) = (atoms(&self.velocity), atoms(&chart.m));
        let mut shared = self.shared.clone();
        let mut force = self.momentum_rate(arena, mixed, &mut shared);
        add(&mut force, &product(&spin, &oh), &Rational::MINUS_ONE);
        add(&mut force, &product(&oh, &spin), &Rational::ONE);
        let force = named(arena, &mut shared, "force_hat", force);
        let placed = Placed::new(arena, n, self.group);
        let push = product(&force, &placed.inverse);
        shared.extend(placed.shared.into_iter().filter(|(s, _)| !self.shared.iter().any(|(t, _)| t == s)));
        let pairs = || (0..n).flat_map(move |a| (0..n).map(move |b| (a, b)));
        let mut list: Vec<(Coordinate, Polynomial)> =
            pairs().map(|(a, b)| (Coordinate::M(a, b), oh[b][a].clone())).collect();
        list.extend(pairs().map(|(i, a)| (Coordinate::Phi(i, a), push[a][i].scaled(&Rational::MINUS_ONE))));
        (list, shared)
    }

    /// `tr(Sigma_hat Oh)/2`.
    #[must_use]
    pub fn energy(&self) -> Polynomial {
        let half = Rational::ratio(1, 2).unwrap_or(Rational::ONE);
        let mut sum = Polynomial::zero();
        for (momentum, speed) in &self.components {
            sum.add_product(momentum, &Polynomial::atom(*speed), &half);
        }
        sum
    }

    /// The Legendre transformation `P (dT/dOh)^T = P (X_body + phi^-1 X_space phi + X_flat)` and `T_int`, from `phi` and
    /// `Oh`.
    pub fn legendre(arena: &mut Arena, mixed: &Mixed, group: Constraint) -> Legendre {
        let n = mixed.dim;
        let placed = Placed::new(arena, n, group);
        let (phi, psi) = (placed.phi.clone(), placed.inverse.clone());
        let oh = atoms(&Matrix::symbols(arena, Frame::Body.velocity_name(), n));
        let mut shared = placed.shared.clone();
        let mut momentum = vec![vec![Polynomial::zero(); n]; n];
        let mut energy = Polynomial::zero();
        for part in &mixed.internal {
            energy.add_scaled(&part.internal_energy(), &Rational::ONE);
            let x = conjugate(part);
            let pulled = match part.frame {
                Frame::Body => x,
                Frame::Space => {
                    define(&mut shared, part, product(&product(&phi, &oh), &psi));
                    product(&product(&psi, &named(arena, &mut shared, "space_sigma", x)), &phi)
                }
                Frame::Flat => {
                    define(&mut shared, part, product(&phi, &oh));
                    product(&named(arena, &mut shared, "flat_pi", x), &phi)
                }
            };
            add(&mut momentum, &pulled, &Rational::ONE);
        }
        // Of the entries of Oh those that determine the others.
        let dependent = group.dependent(&Matrix::symbols(arena, Frame::Body.velocity_name(), n));
        let value = |atom: Expr| dependent.iter().find(|(s, _)| *s == atom).map(|(_, value)| value.clone());
        let projected = group.projected(&momentum);
        Legendre {
            shared: shared.into_iter().map(|(symbol, p)| (symbol, p.substitute(&value))).collect(),
            momentum: table(n, |a, b| projected[a][b].substitute(&value)),
            energy: energy.substitute(&value),
        }
    }
}

/// Gives the velocity of an energy its value.
fn define(shared: &mut Definitions, part: &Kinetic, values: Square<Polynomial>) {
    shared.extend(part.velocity.0.concat().into_iter().zip(values.concat()));
}

/// `X_ab = dT/dO_ba`.
fn conjugate(part: &Kinetic) -> Square<Polynomial> {
    let energy = part.internal_energy();
    table(part.dim, |a, b| energy.derivative(part.velocity.0[b][a]))
}

/// `sum over the entries of e of weight value(place)`.
fn along(e: &BasisVector, value: impl Fn(usize) -> Polynomial) -> Polynomial {
    let mut sum = Polynomial::zero();
    e.entries.iter().for_each(|(k, weight)| sum.add_scaled(&value(*k), weight));
    sum
}

/// What is known of a placement of the group.
struct Placed {
    phi: Square<Polynomial>,
    /// `phi^-1`.
    inverse: Square<Polynomial>,
    /// `phi^T phi`.
    green: Square<Polynomial>,
    /// `D^-2` on R+ SO(n), where `phi^-1 = D^-2 phi^T`; 1 on SO(n).
    inverse_square: Option<Polynomial>,
    shared: Definitions,
}

impl Placed {
    fn new(arena: &mut Arena, n: usize, group: Constraint) -> Self {
        let symbols = Matrix::symbols(arena, "phi", n);
        let phi = atoms(&symbols);
        let unit =
            |value: &Polynomial| table(n, |a, b| if a == b { value.clone() } else { Polynomial::zero() });
        let one = Polynomial::constant(Rational::ONE);
        match group {
            Constraint::Rigid => Self {
                inverse: transpose(&phi),
                green: unit(&one),
                inverse_square: Some(one),
                shared: Vec::new(),
                phi,
            },
            Constraint::Conformal => {
                let Weight { square, inverse, definitions } = Weight::squares(arena, n);
                let (square, inverse_square) = (Polynomial::atom(square), Polynomial::atom(inverse));
                let mut shared = definitions;
                let inverse = table(n, |a, i| phi[i][a].mul(&inverse_square));
                let inverse = named(arena, &mut shared, "inverse_phi", inverse);
                let green = unit(&square);
                Self { inverse, green, inverse_square: Some(inverse_square), shared, phi }
            }
            Constraint::Isochoric => {
                let mut shared = Vec::new();
                // det phi = 1
                let inverse = match n {
                    2 => adjugate(&phi),
                    _ => named(arena, &mut shared, "inverse_phi", adjugate(&phi)),
                };
                let mut green = vec![vec![Polynomial::zero(); n]; n];
                for (a, b) in (0..n).flat_map(|a| (0..n).map(move |b| (a, b))) {
                    green[a][b] = Polynomial::atom(Base::Green(a, b).symbol(arena));
                }
                for (a, b) in (0..n).flat_map(|a| (a..n).map(move |b| (a, b))) {
                    let mut value = Polynomial::zero();
                    symbols.0.iter().for_each(|row| value.add_term(vec![row[a], row[b]], &Rational::ONE));
                    shared.push((Base::Green(a, b).symbol(arena), value));
                }
                Self { inverse, green, inverse_square: None, shared, phi }
            }
        }
    }

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
                    velocities.push(named(arena, &mut self.shared, &format!("turned_{}", k + 1), value));
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
            let symbol = arena.symbol(&format!("space_inertia_{}{}", a + 1, b + 1));
            self.shared.push((symbol, upper[a][b].clone()));
            result[a][b] = Polynomial::atom(symbol);
            result[b][a] = Polynomial::atom(symbol);
        }
        result
    }

    /// `X = (dT/dphi_dot)^T phi`: `J Oh^T G` of d'Alembert's energy.
    fn flat_momentum(
        &self,
        arena: &mut Arena,
        part: &Kinetic,
        shared: &mut Definitions,
    ) -> Square<Polynomial> {
        let n = part.dim;
        let form = hessian(part);
        let oh = atoms(&Matrix::symbols(arena, Frame::Body.velocity_name(), n));
        let fresh: Definitions = self
            .shared
            .iter()
            .filter(|(s, _)| !shared.iter().any(|(known, _)| known == s))
            .cloned()
            .collect();
        shared.extend(fresh);
        if same_blocks(&form, n) {
            let j = table(n, |a, b| form[a][b].clone());
            return product(&product(&j, &transpose(&oh)), &self.green);
        }
        define(shared, part, product(&self.phi, &oh));
        let pi = named(arena, shared, "flat_pi", conjugate(part));
        product(&pi, &self.phi)
    }
}

/// The Hessian of an energy in the velocity of its frame.
fn hessian(part: &Kinetic) -> Square<Polynomial> {
    let velocities = part.velocity.0.concat();
    let slopes = part.internal_energy().gradient(&velocities);
    slopes.iter().map(|slope| slope.gradient(&velocities)).collect()
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
