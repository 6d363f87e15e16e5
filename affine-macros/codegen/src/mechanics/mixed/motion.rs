//! The internal motion of a mixed energy over `phi_dot` and `Pi`.

use crate::algebra::ring::{Square, product, table, transpose};
use crate::algebra::{Arena, Matrix, Polynomial, Rational};
use crate::mechanics::charts::{Chart, Coordinate};
use crate::mechanics::equations::System;
use crate::mechanics::metric::{Definitions, Metric, inverse_placement};
use crate::mechanics::term::Frame;

use super::Mixed;
use super::factorisation::Factorisation;

/// The Legendre transformation of the internal motion.
#[derive(Clone, Debug)]
pub struct Legendre {
    /// Quantities on the way from `phi` and `phi_dot`.
    pub shared: Definitions,
    /// `Pi = (dT/dphi_dot)^T`.
    pub momentum: Square<Polynomial>,
    /// `T_int`.
    pub energy: Polynomial,
}

/// The inverse Legendre transformation and the equations of the internal motion.
#[derive(Clone, Debug)]
pub struct Internal {
    /// Quantities on the way from `phi` and `Pi` to `phi_dot`.
    pub shared: Definitions,
    /// `phi_dot` as symbols, defined among the shared quantities.
    pub velocity: Matrix,
    /// The factorised mass matrix.
    pub factorisation: Factorisation,
}

impl Legendre {
    /// `Pi = X_hat phi^-1 + phi^-1 X + (dT_flat/dphi_dot)^T`, with `X_hat`, `X` the momenta of the energies in `Oh`, `Om`.
    pub fn new(arena: &mut Arena, mixed: &Mixed) -> Self {
        let n = mixed.dim;
        let (inverse, mut shared) = inverse_placement(arena, n);
        let velocity = Matrix::symbols(arena, Frame::Flat.velocity_name(), n);
        let (psi, v) = (atoms(&inverse), atoms(&velocity));
        let mut momentum = vec![vec![Polynomial::zero(); n]; n];
        let mut energy = Polynomial::zero();
        for part in &mixed.internal {
            let sum = part.internal_energy();
            // X_ab = dT/dO_ba
            let x = table(n, |a, b| sum.derivative(part.velocity.0[b][a]));
            let (velocity, pulled) = match part.frame {
                Frame::Body => (Some(product(&psi, &v)), product(&x, &psi)),
                Frame::Space => (Some(product(&v, &psi)), product(&psi, &x)),
                Frame::Flat => (None, x),
            };
            for (symbols, values) in part.velocity.0.iter().zip(velocity.iter().flatten()) {
                shared.extend(symbols.iter().copied().zip(values.iter().cloned()));
            }
            add(&mut momentum, &pulled, &Rational::ONE);
            energy.add_scaled(&sum, &Rational::ONE);
        }
        Self { shared, momentum, energy }
    }
}

impl Internal {
    /// Inverts the Legendre transformation; `None` where the mass matrix is singular at every placement.
    pub fn new(arena: &mut Arena, mixed: &Mixed) -> Option<Self> {
        let n = mixed.dim;
        let Metric { mut shared, internal, .. } = Metric::new(arena, n, &mixed.internal);
        let factorisation = Factorisation::new(arena, "", &internal, &mut shared)?;
        // The momentum conjugate to phi_dot_iA is Pi_Ai.
        let momentum = Matrix::symbols(arena, Frame::Flat.momentum_name(), n).transpose();
        let right: Vec<Polynomial> = momentum.0.concat().into_iter().map(Polynomial::atom).collect();
        let velocity = Matrix::symbols(arena, Frame::Flat.velocity_name(), n);
        factorisation.solve(arena, "", &right, &velocity.0.concat(), &mut shared);
        Some(Self { shared, velocity, factorisation })
    }

    /// `dphi/dt = phi_dot`, `dPi/dt = (dT/dphi)^T` at fixed `phi_dot`: `dH/dphi` at fixed momentum is `-dT/dphi` at
    /// fixed velocity. With `d(phi^-1) = -phi^-1 dphi phi^-1`, the energies in `Oh` and `Om` give
    /// `(dT/dphi)^T = -(Oh X_hat phi^-1 + phi^-1 X Om)`, and of the three summands of `Pi` the one that is longest to
    /// form is what the others leave of it.
    pub fn system(&self, arena: &mut Arena, mixed: &Mixed, chart: &Chart) -> System {
        let n = mixed.dim;
        let (inverse, _) = inverse_placement(arena, n);
        let (psi, v) = (atoms(&inverse), atoms(&self.velocity));
        let mut shared = self.shared.clone();
        let mut rest = atoms(&chart.m);
        let part = |frame: Frame| mixed.internal.iter().find(|part| part.frame == frame);
        if let Some(flat) = part(Frame::Flat) {
            let energy = flat.internal_energy();
            let momentum = table(n, |a, i| energy.derivative(flat.velocity.0[i][a]));
            add(&mut rest, &momentum, &Rational::MINUS_ONE);
        }
        let mut rates = vec![vec![Polynomial::zero(); n]; n];
        if let Some(space) = part(Frame::Space) {
            let om = define_all(&mut shared, &space.velocity, product(&v, &psi));
            let pulled = match part(Frame::Body) {
                None => rest.clone(),
                Some(_) => {
                    let energy = space.internal_energy();
                    let x = table(n, |i, j| energy.derivative(space.velocity.0[j][i]));
                    let x = named(arena, &mut shared, "space_sigma", x);
                    let pulled = named(arena, &mut shared, "space_pi", product(&psi, &x));
                    add(&mut rest, &pulled, &Rational::MINUS_ONE);
                    pulled
                }
            };
            let pulled = named(arena, &mut shared, "space_pi", pulled);
            add(&mut rates, &product(&pulled, &om), &Rational::MINUS_ONE);
        }
        if let Some(body) = part(Frame::Body) {
            let oh = define_all(&mut shared, &body.velocity, product(&psi, &v));
            let pulled = named(arena, &mut shared, "body_pi", rest);
            add(&mut rates, &product(&oh, &pulled), &Rational::MINUS_ONE);
        }
        let rate = |z: Coordinate| match z {
            Coordinate::Phi(i, a) => v[i][a].clone(),
            Coordinate::M(a, i) => rates[a][i].clone(),
            Coordinate::X(_) | Coordinate::P(_) | Coordinate::Carried(_) => Polynomial::zero(),
        };
        let rates = chart.coordinates().into_iter().map(|z| (z, chart.symbol(z), rate(z))).collect();
        System { shared, rates, ..System::default() }
    }

    /// `tr(Pi phi_dot)/2`.
    #[must_use]
    pub fn energy(&self, chart: &Chart) -> Polynomial {
        let half = Rational::ratio(1, 2).unwrap_or(Rational::ONE);
        let mut sum = Polynomial::zero();
        for (row, column) in self.velocity.0.iter().zip(transpose(&atoms(&chart.m))) {
            for (velocity, momentum) in row.iter().zip(&column) {
                sum.add_product(&Polynomial::atom(*velocity), momentum, &half);
            }
        }
        sum
    }
}

/// The derivatives of `H` that make a system what it is, in canonical coordinates: `dH/dPi`, `dH/dp` and
/// `-dH/dphi`, `-dH/dx` are its rates.
#[must_use]
pub fn slopes_of(system: &System) -> Vec<(Coordinate, Polynomial)> {
    let conjugate = |z: &Coordinate, rate: &Polynomial| match *z {
        Coordinate::X(i) => Some((Coordinate::P(i), rate.clone())),
        Coordinate::Phi(i, a) => Some((Coordinate::M(a, i), rate.clone())),
        Coordinate::P(i) => Some((Coordinate::X(i), rate.scaled(&Rational::MINUS_ONE))),
        Coordinate::M(a, i) => Some((Coordinate::Phi(i, a), rate.scaled(&Rational::MINUS_ONE))),
        // A function of the others has no conjugate.
        Coordinate::Carried(_) => None,
    };
    let list = system.rates.iter().filter_map(|(z, _, rate)| conjugate(z, rate));
    list.filter(|(_, slope)| !slope.is_zero()).collect()
}

pub(super) fn atoms(symbols: &Matrix) -> Square<Polynomial> {
    symbols.0.iter().map(|row| row.iter().map(|symbol| Polynomial::atom(*symbol)).collect()).collect()
}

pub(super) fn add(sum: &mut Square<Polynomial>, other: &Square<Polynomial>, weight: &Rational) {
    for (row, others) in sum.iter_mut().zip(other) {
        row.iter_mut().zip(others).for_each(|(value, more)| value.add_scaled(more, weight));
    }
}

/// Defines symbols, and gives them as polynomials.
fn define_all(shared: &mut Definitions, symbols: &Matrix, values: Square<Polynomial>) -> Square<Polynomial> {
    shared.extend(symbols.0.concat().into_iter().zip(values.concat()));
    atoms(symbols)
}

/// A matrix of quantities `stem_11`, `stem_12`, ...; one whose entries are symbols already stays as it is.
pub(super) fn named(
    arena: &mut Arena,
    shared: &mut Definitions,
    stem: &str,
    values: Square<Polynomial>,
) -> Square<Polynomial> {
    let is_symbol =
        |p: &Polynomial| p.terms().len() == 1 && p.terms().all(|(m, c)| m.len() == 1 && c.is_one());
    if values.iter().flatten().all(is_symbol) {
        return values;
    }
    let symbols = Matrix::symbols(arena, stem, values.len());
    define_all(shared, &symbols, values)
}
