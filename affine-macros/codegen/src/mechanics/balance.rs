//! The balance laws of an energy of `phi_dot` (section 3), in the kinematical spin `K` instead of the momentum `Pi`.
//!
//! `K = phi (dT/dphi_dot)^T = phi Pi`, which is `phi J phi_dot^T` for the energy (2.1). Its rate along Hamilton's equations
//! is `phi_dot Pi + phi (T_Pi + N_Pi)` with the force `N_Pi` on `Pi`, and `T_Pi = dT/dphi` where the energy depends on `phi`:
//! (3.6), and with `phi_dot = Om phi` (3.8). Seen from the body as a tensor with two upper indices,
//! `K_hat = phi^-1 K phi^-T = Pi phi^-T`, which is not `Sigma_hat = Pi phi`; the same product rule gives (3.9).

use crate::algebra::ring::{Square, difference, product, sum, table, times, transpose};
use crate::algebra::{Arena, Expr, Kernel, Polynomial};
use crate::symbol::Quantity;

use super::charts::{Chart, Coordinate};
use super::equations::{Load, System};
use super::hamiltonian::Hamiltonian;
use super::kinetics::Kinetics;
use super::shared::Shared;
use super::term::Frame;

/// Quantities of the internal motion: `K`, `phi_dot Pi + phi T_Pi`, `N`, and in the body `K_hat`, `T_Pi phi^-T - K_hat Oh^T`,
/// `N_hat`.
pub const INTERNAL: [(Quantity, Frame); 6] = [
    (Quantity::Spin, Frame::Space),
    (Quantity::Inertia, Frame::Space),
    (Quantity::Moment, Frame::Space),
    (Quantity::ComovingSpin, Frame::Body),
    (Quantity::ComovingInertia, Frame::Body),
    (Quantity::ComovingMoment, Frame::Body),
];

/// Quantities of the centre of mass: `k = m x_dot`, `F`, and in the body `k_hat`, `-Oh k_hat`, `F_hat`.
pub const CENTRE: [(Quantity, Frame); 5] = [
    (Quantity::MomentumOfCentre, Frame::Space),
    (Quantity::ForceOnCentre, Frame::Space),
    (Quantity::ComovingMomentumOfCentre, Frame::Body),
    (Quantity::ComovingInertia, Frame::Body),
    (Quantity::ComovingForceOnCentre, Frame::Body),
];

/// The two sides of the balance laws.
pub struct Laws {
    /// Quantities that several of them share.
    pub shared: Vec<(Expr, Polynomial)>,
    /// Calls that compute forces.
    pub kernels: Vec<Kernel>,
    /// As [`INTERNAL`] lists them.
    pub internal: [Square<Polynomial>; 6],
    /// As [`CENTRE`] lists them; empty without translation.
    pub centre: Vec<Vec<Polynomial>>,
}

impl Laws {
    /// The laws in the canonical chart, with `p` spatial, of an energy and of what the centre of mass adds to it. Of `(2.1)` the
    /// Hamiltonian is given as well, whose velocity acts on the index of the body alone.
    pub fn new(
        arena: &mut Arena,
        chart: &Chart,
        (kinetics, added, own): (&Kinetics, &[Load], Option<&Hamiltonian>),
        loads: &[Load],
    ) -> Self {
        let (n, phi, pi) = (chart.dim, chart.phi.atoms(), chart.m.atoms());
        let mut inertial = System { shared: kinetics.shared.clone(), ..still(chart) };
        inertial.add(&kinetics.load());
        added.iter().for_each(|load| inertial.add(load));
        let mut system = System { shared: inertial.shared.clone(), ..still(chart) };
        loads.iter().for_each(|load| system.add(load));
        let kinetic = table(n, |a, i| inertial.rate(Coordinate::M(a, i)));
        let mut shared = Shared { arena, list: Vec::new() };
        let phi_dot = kinetics.velocity.atoms();
        let push = shared.matrix(Quantity::Load, &table(n, |a, i| system.rate(Coordinate::M(a, i))));
        let inverse = shared.inverse(&phi);
        let upper = |shared: &mut Shared, of: Quantity, tensor: &Square<Polynomial>| {
            shared.matrix(of, &product(tensor, &transpose(&inverse)))
        };
        let spin_hat = upper(&mut shared, Quantity::KinematicalSpin, &pi);
        let moment_hat = upper(&mut shared, Quantity::Moment, &push);
        let omega_hat = match own {
            // phi_dot is linear in Pi, and acts on its body index alone: what it is of K_hat = Pi phi^-T is phi_dot^T phi^-T.
            Some(h) => table(n, |a, b| {
                h.velocity[a][b].substitute(&|atom: Expr| {
                    let entry = (0..n * n).find(|k| h.momentum.0[k / n][k % n] == atom)?;
                    Some(spin_hat[entry / n][entry % n].clone())
                })
            }),
            None => product(&inverse, &phi_dot),
        };
        let omega_hat = shared.matrix(Quantity::ComovingAffineVelocity, &omega_hat);
        let inertia_hat = product(&spin_hat, &transpose(&omega_hat));
        let centre = if chart.p.is_empty() {
            Vec::new()
        } else {
            let momentum = Polynomial::vector(&chart.p);
            let forces: Vec<Polynomial> = (0..n).map(|i| system.rate(Coordinate::P(i))).collect();
            let forces = shared.vector(Quantity::Load, &forces);
            let momentum_hat = shared.vector(Quantity::ComovingMomentum, &times(&inverse, &momentum));
            let inertia_hat = times(&omega_hat, &momentum_hat).iter().map(Polynomial::neg).collect();
            let force_hat = times(&inverse, &forces);
            vec![momentum, forces, momentum_hat, inertia_hat, force_hat]
        };
        let internal = [
            product(&phi, &pi),
            sum(&product(&phi_dot, &pi), &product(&phi, &kinetic)),
            product(&phi, &push),
            spin_hat,
            difference(&product(&kinetic, &transpose(&inverse)), &inertia_hat),
            moment_hat,
        ];
        system.add(&Load { shared: shared.list, ..Load::default() });
        Self { shared: system.shared, kernels: system.kernels, internal, centre }
    }
}

/// A system in which nothing moves.
fn still(chart: &Chart) -> System {
    let rates = chart.coordinates().into_iter().map(|z| (z, chart.symbol(z), Polynomial::zero())).collect();
    System { rates, ..System::default() }
}
