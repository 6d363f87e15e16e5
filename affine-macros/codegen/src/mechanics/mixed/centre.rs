//! The motion of the centre of mass with energies in body and space.
//!
//! With `v_hat = phi^-1 x_dot` and `p_hat = phi^T p = (m_body 1 + m_space G) v_hat` the Hamiltonian is
//! `1/2 p_hat^T (m_body 1 + m_space G)^-1 p_hat`.

use crate::algebra::ring::{Square, add_multiple, scalar, times, transpose};
use crate::algebra::{Arena, Expr, Matrix, Polynomial, Rational};
use crate::mechanics::charts::{Chart, Coordinate, Linear, Momentum};
use crate::mechanics::kinetic::Kinetic;
use crate::mechanics::kinetics::{Kinetics, Lagrangian, Part};
use crate::mechanics::metric::Definitions;
use crate::mechanics::shared::inverse_placement;
use crate::mechanics::term::Frame;
use crate::symbol::{Aspect, Factorised, Quantity};

use super::factorisation::Factorisation;
use super::parts::shares;
use super::placed::{Placed, green, green_definitions};

/// The masses of the translational energies.
#[derive(Clone, Debug)]
pub struct Masses {
    dim: usize,
    /// Of `m/2 |phi^-1 x_dot|^2`.
    pub body: Option<Expr>,
    /// Of `m/2 |x_dot|^2`.
    pub space: Option<Expr>,
}

impl Masses {
    /// The masses of some energies.
    pub fn of(parts: &[Kinetic]) -> Self {
        let mass = |frame: Frame| {
            let translation = |part: &Kinetic| part.translation.filter(|t| t.frame == frame);
            parts.iter().find_map(translation).map(|t| t.mass)
        };
        let dim = parts.first().map_or(0, |part| part.dim);
        Self { dim, body: mass(Frame::Body), space: mass(Frame::Space) }
    }

    /// Both frames have a mass: the matrix depends on the placement.
    pub fn are_mixed(&self) -> bool {
        self.body.is_some() && self.space.is_some()
    }

    /// There is no translation.
    pub fn are_none(&self) -> bool {
        self.body.is_none() && self.space.is_none()
    }

    /// The masses, that of the body first.
    pub fn list(&self) -> Vec<Expr> {
        self.body.into_iter().chain(self.space).collect()
    }

    /// The frame of the energy, of `x_dot` where there are two.
    pub fn frame(&self) -> Option<Frame> {
        let body = self.body.map(|_| Frame::Body);
        self.space.map(|_| Frame::Space).or(body)
    }

    /// The mass, where there is one.
    pub fn single(&self) -> Option<Expr> {
        self.body.xor(self.space)
    }

    /// `m_body` and `m_space`, zero where there is none.
    pub(super) fn of_body_and_space(&self, arena: &mut Arena) -> [Polynomial; 2] {
        [self.body, self.space]
            .map(|mass| mass.map_or_else(Polynomial::zero, |mass| Polynomial::normal_form(arena, mass)))
    }

    /// `m_body 1 + m_space G`.
    fn matrix(&self, arena: &mut Arena) -> Square<Polynomial> {
        let green = green(arena, self.dim);
        let [body, space] = self.of_body_and_space(arena);
        let mut matrix = scalar(self.dim, &body);
        add_multiple(&mut matrix, &space, &green);
        matrix
    }

    /// Its factorisation, with the definitions that lead there. `None` where it is singular at every placement.
    pub fn factorised(&self, arena: &mut Arena) -> Option<(Factorisation, Definitions)> {
        let mut shared = green_definitions(arena, self.dim);
        let matrix = self.matrix(arena);
        let chart = Chart::new(arena, self.dim, Momentum::Canonical, None);
        let factorisation = Factorisation::new(arena, Factorised::Centre, &matrix, &mut shared, &chart)?;
        Some((factorisation, shared))
    }

    /// `x_dot` as symbols, and the definitions that lead from `(phi, p)` to them and to `v_hat`. `None` where the mass
    /// matrix is singular at every placement, or without translation.
    pub fn velocity(&self, arena: &mut Arena) -> Option<(Vec<Expr>, Definitions)> {
        let n = self.dim;
        let [x_dot, v_hat, p, p_hat] = [
            Quantity::CentreVelocity,
            Quantity::ComovingCentreVelocity,
            Quantity::LinearMomentum,
            Quantity::ComovingLinearMomentum,
        ]
        .map(|of| arena.components(of, n));
        let mut shared = Definitions::new();
        if self.body.is_none() {
            let reciprocal = Polynomial::reciprocal(arena, self.space?)?;
            shared.extend(x_dot.iter().zip(&p).map(|(x, p)| (*x, reciprocal.mul(&Polynomial::atom(*p)))));
            return Some((x_dot, shared));
        }
        let phi = Matrix::symbols(arena, Quantity::Placement, n).atoms();
        shared.extend(p_hat.iter().copied().zip(times(&transpose(&phi), &Polynomial::vector(&p))));
        let p_hat = Polynomial::vector(&p_hat);
        match self.single() {
            Some(mass) => {
                let reciprocal = Polynomial::reciprocal(arena, mass)?;
                shared.extend(v_hat.iter().zip(&p_hat).map(|(v, p)| (*v, p.mul(&reciprocal))));
            }
            None => {
                let (factorisation, definitions) = self.factorised(arena)?;
                shared.extend(definitions);
                factorisation.solve(arena, Factorised::Centre, &p_hat, &v_hat, &mut shared);
            }
        }
        shared.extend(x_dot.iter().copied().zip(times(&phi, &Polynomial::vector(&v_hat))));
        Some((x_dot, shared))
    }

    /// The translational energy in a chart with spatial `p`. `None` as in [`Masses::velocity`].
    pub fn kinetics(&self, arena: &mut Arena, chart: &Chart) -> Option<Kinetics> {
        let (x_dot, inverse) = self.velocity(arena)?;
        let lagrangian = self.lagrangian(arena, chart, &x_dot);
        let velocity = chart.velocity(arena);
        lagrangian.kinetics(arena, &velocity, &inverse).into_iter().next()
    }

    /// What `p` and the energy share, `p`, and the energy, from `phi` and `x_dot` under any names.
    pub fn legendre(&self, arena: &mut Arena, x_dot: &[Expr]) -> (Definitions, Vec<Polynomial>, Polynomial) {
        let chart = Chart::new(arena, self.dim, Momentum::Canonical, Some(Linear::Space));
        let (_, mut shared) = inverse_placement(arena, &chart.placement());
        let (definitions, momentum, energy) = self.lagrangian(arena, &chart, x_dot).legendre(false);
        shared.extend(definitions);
        (shared, momentum, energy)
    }

    /// `m_space/2 |x_dot|^2 + m_body/2 |v_hat|^2`, `v_hat = phi^-1 x_dot`.
    fn lagrangian(&self, arena: &mut Arena, chart: &Chart, x_dot: &[Expr]) -> Lagrangian {
        let n = self.dim;
        let half = Rational::HALF;
        let part = |arena: &mut Arena, mass: Expr, velocities: Vec<Expr>| {
            let energy: Polynomial =
                velocities.iter().map(|v| Polynomial::term(vec![*v, *v], half.clone())).sum();
            let energy = energy.mul(&Polynomial::normal_form(arena, mass));
            Part { velocities, definitions: None, energy, slopes: Vec::new(), momenta: Vec::new() }
        };
        let mut parts = Vec::new();
        parts.extend(self.space.map(|mass| part(arena, mass, x_dot.to_vec())));
        if let Some(mass) = self.body {
            let psi = Matrix::symbols(arena, Quantity::InversePlacement, n).atoms();
            let v_hat: Vec<Expr> = arena.components(Quantity::ComovingCentreVelocity, n);
            let definitions = times(&psi, &Polynomial::vector(x_dot));
            let momenta = shares(arena, Aspect::InTheBody, &chart.p);
            parts.push(Part { definitions: Some(definitions), momenta, ..part(arena, mass, v_hat) });
        }
        let conjugate = x_dot.iter().enumerate().map(|(i, v)| (Coordinate::P(i), *v)).collect();
        let on_the_group = Placed::new(arena, n, chart.confined).values(arena);
        Lagrangian { chart: chart.clone(), conjugate, parts, on_the_group }
    }

    /// `p . x_dot/2`.
    pub fn energy(&self, arena: &mut Arena, chart: &Chart) -> Polynomial {
        let x_dot = arena.components(Quantity::CentreVelocity, chart.p.len());
        let products = x_dot.iter().zip(&chart.p).map(|(v, p)| Polynomial::monomial([*v, *p]));
        products.sum::<Polynomial>().scaled(&Rational::HALF)
    }
}
