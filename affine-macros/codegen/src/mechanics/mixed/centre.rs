//! The motion of the centre of mass with energies in body and space, as what it adds to the equations of a chart.
//!
//! With `v_hat = phi^-1 x_dot` and `p_hat = phi^T p = (m_body 1 + m_space G) v_hat` the Hamiltonian is
//! `1/2 p_hat^T (m_body 1 + m_space G)^-1 p_hat`; its derivative along `phi` at fixed `p` is
//! `dH = (p - m_space x_dot)^T dphi v_hat`, and `p - m_space x_dot = m_body phi^-T v_hat`.

use crate::algebra::ring::{Square, table};
use crate::algebra::{Arena, Expr, Polynomial, Rational};
use crate::mechanics::charts::{Chart, Coordinate, Momentum};
use crate::mechanics::equations::Load;
use crate::mechanics::kinetic::Kinetic;
use crate::mechanics::metric::Definitions;
use crate::mechanics::potential::Base;
use crate::mechanics::term::Frame;

use super::Mixed;
use super::factorisation::Factorisation;

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
    /// The masses of a mixed energy.
    #[must_use]
    pub fn of(mixed: &Mixed) -> Self {
        let mass = |frame: Frame| {
            let translation = |part: &Kinetic| part.translation.filter(|t| t.frame == frame);
            mixed.translations.iter().find_map(translation).map(|t| t.mass)
        };
        Self { dim: mixed.dim, body: mass(Frame::Body), space: mass(Frame::Space) }
    }

    /// Both frames have a mass: the matrix depends on the placement.
    #[must_use]
    pub fn are_mixed(&self) -> bool {
        self.body.is_some() && self.space.is_some()
    }

    /// There is no translation.
    #[must_use]
    pub fn are_none(&self) -> bool {
        self.body.is_none() && self.space.is_none()
    }

    /// `m_body 1 + m_space G`.
    fn matrix(&self, arena: &mut Arena) -> Square<Polynomial> {
        let green = green(arena, self.dim);
        let mut mass =
            |mass: Option<Expr>| mass.map_or_else(Polynomial::zero, |m| Polynomial::normal_form(arena, m));
        let (body, space) = (mass(self.body), mass(self.space));
        table(self.dim, |a, b| {
            let mut entry = if a == b { body.clone() } else { Polynomial::zero() };
            entry.add_product(&space, &Polynomial::atom(green[a][b]), &Rational::ONE);
            entry
        })
    }

    /// Its factorisation, with the definitions that lead there. `None` where it is singular at every placement.
    pub fn factorised(&self, arena: &mut Arena) -> Option<(Factorisation, Definitions)> {
        let mut shared = green_definitions(arena, self.dim);
        let matrix = self.matrix(arena);
        let factorisation = Factorisation::new(arena, "centre_", &matrix, &mut shared)?;
        Some((factorisation, shared))
    }

    /// `x_dot` as symbols, and the definitions that lead from `(phi, p)` to them and to `v_hat`. `None` where the mass
    /// matrix is singular at every placement, or without translation.
    pub fn velocity(&self, arena: &mut Arena) -> Option<(Vec<Expr>, Definitions)> {
        let n = self.dim;
        let [x_dot, v_hat, p, p_hat] = ["x_dot", "v_hat", "p", "p_hat"]
            .map(|name| (1..=n).map(|i| arena.symbol(&format!("{name}_{i}"))).collect::<Vec<_>>());
        let mut shared = Definitions::new();
        let reciprocal = |arena: &mut Arena, mass: Expr| {
            let reciprocal = arena.pow(mass, -1)?;
            Some(Polynomial::normal_form(arena, reciprocal))
        };
        match (self.body, self.space) {
            (None, None) => return None,
            (None, Some(mass)) => {
                let reciprocal = reciprocal(arena, mass)?;
                shared.extend(x_dot.iter().zip(&p).map(|(x, p)| (*x, reciprocal.mul(&Polynomial::atom(*p)))));
                return Some((x_dot, shared));
            }
            (Some(_), _) => {}
        }
        for (a, symbol) in p_hat.iter().enumerate() {
            shared.push((*symbol, along(arena, n, |i| ((i, a), p[i]))));
        }
        let p_hat: Vec<Polynomial> = p_hat.into_iter().map(Polynomial::atom).collect();
        match (self.body, self.are_mixed()) {
            (Some(mass), false) => {
                let reciprocal = reciprocal(arena, mass)?;
                shared.extend(v_hat.iter().zip(&p_hat).map(|(v, p)| (*v, p.mul(&reciprocal))));
            }
            _ => {
                let (factorisation, definitions) = self.factorised(arena)?;
                shared.extend(definitions);
                factorisation.solve(arena, "centre_", &p_hat, &v_hat, &mut shared);
            }
        }
        for (i, symbol) in x_dot.iter().enumerate() {
            shared.push((*symbol, along(arena, n, |a| ((i, a), v_hat[a]))));
        }
        Some((x_dot, shared))
    }

    /// What the translation adds to Hamilton's equations of a chart with spatial `p`, whose affine momentum is that of
    /// a frame. `None` as in [`Masses::velocity`].
    pub fn load(&self, arena: &mut Arena, chart: &Chart) -> Option<Load> {
        let n = self.dim;
        let (x_dot, mut shared) = self.velocity(arena)?;
        let mut forces: Vec<(Coordinate, Polynomial)> =
            (0..n).map(|i| (Coordinate::X(i), Polynomial::atom(x_dot[i]))).collect();
        let Some(body) = self.body else { return Some(Load { shared, forces, ..Load::default() }) };
        let mut numbered =
            |name: &str| (1..=n).map(|i| arena.symbol(&format!("{name}_{i}"))).collect::<Vec<Expr>>();
        let (v_hat, rest) = (numbered("v_hat"), numbered("body_p"));
        let body = Polynomial::normal_form(arena, body);
        let space = self.space.map_or_else(Polynomial::zero, |m| Polynomial::normal_form(arena, m));
        for i in 0..n {
            let mut value = Polynomial::atom(chart.p[i]);
            value.add_product(&space, &Polynomial::atom(x_dot[i]), &Rational::MINUS_ONE);
            shared.push((rest[i], value));
        }
        let minus = |left: Expr, right: Expr| Polynomial::term(vec![left, right], Rational::MINUS_ONE);
        for (a, b) in (0..n).flat_map(|a| (0..n).map(move |b| (a, b))) {
            // {M, H} = {M_ab, phi_kC} dH/dphi_kC with the brackets of phi and the momentum of the chart.
            let force = match chart.momentum {
                // -phi_kB dH/dphi_kA = -m_body v_hat_A v_hat_B
                Momentum::Body => body.mul(&minus(v_hat[a], v_hat[b])),
                // -phi_iC dH/dphi_jC
                Momentum::Space | Momentum::Total => minus(x_dot[a], rest[b]),
                // -dH/dphi_iA, i = b
                Momentum::Canonical => minus(v_hat[a], rest[b]),
            };
            forces.push((Coordinate::M(a, b), force));
        }
        Some(Load { shared, forces, ..Load::default() })
    }

    /// The derivatives of the translational energy in such a chart: `dH/dp = x_dot`,
    /// `dH/dphi = (p - m_space x_dot) v_hat^T`.
    pub fn slopes(&self, arena: &mut Arena) -> Vec<(Coordinate, Polynomial)> {
        let n = self.dim;
        let [x_dot, v_hat, rest] = ["x_dot", "v_hat", "body_p"]
            .map(|name| (1..=n).map(|i| arena.symbol(&format!("{name}_{i}"))).collect::<Vec<_>>());
        let mut list: Vec<(Coordinate, Polynomial)> =
            (0..n).map(|i| (Coordinate::P(i), Polynomial::atom(x_dot[i]))).collect();
        if self.body.is_some() {
            for (i, a) in (0..n).flat_map(|i| (0..n).map(move |a| (i, a))) {
                let slope = Polynomial::term(vec![rest[i], v_hat[a]], Rational::ONE);
                list.push((Coordinate::Phi(i, a), slope));
            }
        }
        list
    }

    /// `p . x_dot/2`.
    pub fn energy(&self, arena: &mut Arena, chart: &Chart) -> Polynomial {
        let half = Rational::ratio(1, 2).unwrap_or(Rational::ONE);
        let mut sum = Polynomial::zero();
        for (i, p) in chart.p.iter().enumerate() {
            let x_dot = arena.symbol(&format!("x_dot_{}", i + 1));
            sum.add_term(vec![x_dot, *p], &half);
        }
        sum
    }
}

/// `sum over k of phi[place] * symbol`.
fn along(arena: &mut Arena, n: usize, factor: impl Fn(usize) -> ((usize, usize), Expr)) -> Polynomial {
    let mut sum = Polynomial::zero();
    for k in 0..n {
        let ((i, a), symbol) = factor(k);
        let phi = arena.symbol(&format!("phi_{}{}", i + 1, a + 1));
        sum.add_term(vec![phi, symbol], &Rational::ONE);
    }
    sum
}

fn green(arena: &mut Arena, n: usize) -> Vec<Vec<Expr>> {
    (0..n).map(|a| (0..n).map(|b| Base::Green(a, b).symbol(arena)).collect()).collect()
}

fn green_definitions(arena: &mut Arena, n: usize) -> Definitions {
    let mut list = Definitions::new();
    for (a, b) in (0..n).flat_map(|a| (a..n).map(move |b| (a, b))) {
        let symbol = Base::Green(a, b).symbol(arena);
        let mut value = Polynomial::zero();
        for i in 1..=n {
            let pair = [a, b].map(|c| arena.symbol(&format!("phi_{i}{}", c + 1)));
            value.add_term(pair.to_vec(), &Rational::ONE);
        }
        list.push((symbol, value));
    }
    list
}
