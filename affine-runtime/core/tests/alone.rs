//! A model that knows this crate alone: `crate = affine_core` for those who evaluate and do not simulate.
#![allow(clippy::unwrap_used)]

use affine_core::Model;
use affine_macros::affine_model;
use nalgebra::{Matrix2, Vector2};

/// A metrical body in an affine space, with a mass.
#[affine_model(
    crate = affine_core,
    dim = 2,
    kinetic(casimir2 = 0.2, body_inertia = 1.5, space_translation = 2)
)]
struct Body;

/// `T = 1/2 I tr(Omega_hat^T Omega_hat) + A/2 tr(Omega_hat^2) + 1/2 m v.v`.
#[test]
fn the_hamiltonian_is_the_kinetic_energy_of_the_velocity() {
    let phi = Matrix2::new(1.2, 0.3, -0.1, 0.9);
    let omega_hat = Matrix2::new(0.3, -0.7, 0.2, 0.5);
    let v = Vector2::new(0.4, -0.6);
    let expected = 0.75 * (omega_hat.transpose() * omega_hat).trace()
        + 0.1 * (omega_hat * omega_hat).trace()
        + v.dot(&v);
    let point = Body.at_velocity(Vector2::zeros(), phi, v, phi * omega_hat).unwrap();
    assert!((Body.hamiltonian(0.0, &point) - expected).abs() < 1e-14 * expected);
}
