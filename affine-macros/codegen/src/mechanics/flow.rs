//! Motions at one point modulo a prime: placement and momenta with their rates.
//!
//! One point where a rate is not zero is a proof that it is no identity, and costs next to nothing; a rate that is no identity
//! vanishes at a random point with a chance of its degree over `2^61` (Schwartz, J. ACM 27 (1980) 701), at several of them
//! with that to the power of their number.

use crate::algebra::Polynomial;
use crate::algebra::evaluate::Field;
use crate::algebra::residue::Residue;
use crate::algebra::ring::{Square, difference, outer, product, sum, table, times, transpose};

use super::charts::{Chart, Coordinate, Momentum};
use super::equations::Load;
use super::group_point::inverse;

/// A value and its rate.
pub(super) type Moving<T> = [T; 2];

/// A phase point in canonical coordinates and its velocity.
pub(super) struct Flow {
    x: Moving<Vec<Residue>>,
    pub(super) p: Moving<Vec<Residue>>,
    phi: Moving<Square<Residue>>,
    pub(super) pi: Moving<Square<Residue>>,
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

    /// `d(phi^T p)/dt`.
    pub(super) fn comoving_momentum_rate(&self) -> Vec<Residue> {
        let [kept, turned] = [(0, 1), (1, 0)].map(|(k, l)| times(&transpose(&self.phi[k]), &self.p[l]));
        kept.iter().zip(&turned).map(|(a, b)| a.add(b)).collect()
    }

    /// `d(x p^T)/dt`.
    pub(super) fn orbital_rate(&self) -> Square<Residue> {
        match self.p[0].is_empty() {
            true => table(self.phi[0].len(), |_, _| Residue::ZERO),
            false => sum(&outer(&self.x[1], &self.p[0]), &outer(&self.x[0], &self.p[1])),
        }
    }
}

fn moving_product(a: &Moving<Square<Residue>>, b: &Moving<Square<Residue>>) -> Moving<Square<Residue>> {
    [product(&a[0], &b[0]), sum(&product(&a[1], &b[0]), &product(&a[0], &b[1]))]
}

/// `tr(m^(k-1) m_dot)`, the rate of `tr m^k / k`.
pub(super) fn power_rate(k: usize, [m, m_dot]: &Moving<Square<Residue>>) -> Vec<Residue> {
    let mut power = m_dot.clone();
    for _ in 1..k {
        power = product(m, &power);
    }
    vec![(0..m.len()).fold(Residue::ZERO, |trace, a| trace.add(&power[a][a]))]
}
