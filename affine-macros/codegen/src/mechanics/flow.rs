//! Motions at one point modulo a prime: placement and momenta with their rates.
//!
//! One point where a rate is not zero is a proof that it is no identity, and costs next to nothing; a rate that is no identity
//! vanishes at a random point with a chance of its degree over `2^61` (Schwartz, J. ACM 27 (1980) 701), at several of them
//! with that to the power of their number.

use crate::algebra::Polynomial;
use crate::algebra::evaluate::Field;
use crate::algebra::residue::Residue;
use crate::algebra::ring::{Square, difference, outer, product, sum, table, times, trace, transpose};

use super::charts::{Chart, Coordinate, Momentum};
use super::conserved::Momenta;
use super::equations::Load;
use super::group_point::inverse;

/// A value and its rate.
pub(super) type Moving<T> = [T; 2];

/// A phase point in canonical coordinates and its velocity.
pub(super) struct Flow {
    x: Moving<Vec<Residue>>,
    p: Moving<Vec<Residue>>,
    phi: Moving<Square<Residue>>,
    pi: Moving<Square<Residue>>,
    /// `Sigma = phi Pi`.
    pub(super) sigma: Moving<Square<Residue>>,
    /// `Sigma_hat = Pi phi`.
    pub(super) sigma_hat: Moving<Square<Residue>>,
}

impl Flow {
    /// The flow that moves the coordinates of a chart with spatial `p` by the sum of the loads, `value` giving values to
    /// their polynomials. Under a constraint the rates of the affine momentum are projected.
    pub(super) fn new(chart: &Chart, loads: &[Load], value: &dyn Fn(&Polynomial) -> Residue) -> Self {
        let n = chart.dim;
        let moving = |z: Coordinate| {
            let forces = loads.iter().flat_map(|load| &load.forces).filter(|(known, _)| *known == z);
            let rate = forces.fold(Residue::ZERO, |sum, (_, force)| sum.add(&value(force)));
            [value(&Polynomial::atom(chart.symbol(z))), rate]
        };
        let vector = |z: fn(usize) -> Coordinate| -> Moving<Vec<Residue>> {
            let list: Vec<_> = (0..chart.p.len()).map(|i| moving(z(i))).collect();
            [0, 1].map(|k| list.iter().map(|both| both[k]).collect())
        };
        let matrix = |z: fn(usize, usize) -> Coordinate| -> Moving<Square<Residue>> {
            let list = table(n, |a, b| moving(z(a, b)));
            [0, 1].map(|k| table(n, |a, b| list[a][b][k]))
        };
        let phi = matrix(Coordinate::Phi);
        let [m, m_dot] = matrix(Coordinate::M);
        let m_dot = chart.confined.map_or_else(|| m_dot.clone(), |group| group.projected(&m_dot));
        let psi = inverse(&phi[0]);
        // Sigma_hat = Pi phi, Sigma = phi Pi.
        let pi = match chart.momentum {
            Momentum::Canonical => [m, m_dot],
            Momentum::Body => {
                let pi = product(&m, &psi);
                let lost = product(&pi, &phi[1]);
                [pi, product(&difference(&m_dot, &lost), &psi)]
            }
            Momentum::Space | Momentum::Total => {
                let pi = product(&psi, &m);
                let lost = product(&phi[1], &pi);
                [pi, product(&psi, &difference(&m_dot, &lost))]
            }
        };
        // Momenta that differ by what no velocity of the group sees are one.
        let projected = |both: Moving<Square<Residue>>| match chart.confined {
            Some(group) => both.map(|m| group.projected(&m)),
            None => both,
        };
        Self {
            x: vector(Coordinate::X),
            p: vector(Coordinate::P),
            sigma: projected(moving_product(&phi, &pi)),
            sigma_hat: projected(moving_product(&pi, &phi)),
            phi,
            pi,
        }
    }

    /// The momenta that are linear in `p` and `Pi`, and their rates.
    pub(super) fn momenta(&self) -> [Momenta; 2] {
        let [p, p_dot] = &self.p;
        let ([x, x_dot], [phi, phi_dot]) = (&self.x, &self.phi);
        let p_hat = times(&transpose(phi), p);
        let turned = [times(&transpose(phi), p_dot), times(&transpose(phi_dot), p)];
        let p_hat_dot: Vec<Residue> = turned[0].iter().zip(&turned[1]).map(|(a, b)| a.add(b)).collect();
        let orbital = outer(x, p);
        let orbital_dot = sum(&outer(x_dot, p), &outer(x, p_dot));
        let moves = !p.is_empty();
        let centre = [(p.as_slice(), p_hat.as_slice(), &orbital), (p_dot, &p_hat_dot, &orbital_dot)];
        [0, 1].map(|k| {
            Momenta::new(moves.then_some(centre[k]), [&self.sigma[k], &self.sigma_hat[k], &self.pi[k]])
        })
    }
}

fn moving_product(a: &Moving<Square<Residue>>, b: &Moving<Square<Residue>>) -> Moving<Square<Residue>> {
    [product(&a[0], &b[0]), sum(&product(&a[1], &b[0]), &product(&a[0], &b[1]))]
}

/// `tr(m^(k-1) m_dot)`, the rate of `tr m^k / k`.
pub(super) fn power_rate(k: usize, [m, m_dot]: &Moving<Square<Residue>>) -> Residue {
    let mut power = m_dot.clone();
    for _ in 1..k {
        power = product(m, &power);
    }
    trace(&power)
}
