//! The problems P9 to P12.

use affine_runtime::prelude::*;

/// P9: the vibrating body P2 with viscosity `r`.
#[affine_model(
    dim = 3,
    symmetry(space = affine, body = metric),
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1),
    potential = 10/2*sinh(q)^2 + 0.5*(tr(G)*exp(-2*q) - n),
    dissipation(body_inertia = r)
)]
pub(crate) struct Viscous {
    pub(crate) r: f64,
}

/// P10: viscosity of the volume alone, but for a tenth.
#[affine_model(
    dim = 2,
    kinetic(dalembert = 1),
    potential = (tr(G) - n)^2,
    dissipation(casimir1_squared = r, body_inertia = 0.1)
)]
pub(crate) struct Bulk {
    pub(crate) r: f64,
}

/// P11: anisotropic viscosity beside a stiff spring of shear.
#[affine_model(
    dim = 3,
    symmetry(space = affine, body = metric),
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1),
    potential = 10/2*sinh(q)^2 + 3e7*(tr(G)*exp(-2*q) - n),
    dissipation(body_inertia = [[502000, 250000, 500000], [250000, 127000, 250000], [500000, 250000, 502000]])
)]
pub(crate) struct Spring;

/// P12: a light body that is driven.
#[affine_model(
    dim = 3,
    symmetry(space = affine, body = metric),
    kinetic(casimir2 = 2e-7, casimir1_squared = 1e-7, body_inertia = 1e-6),
    potential = 10/2*sinh(q)^2 + 0.5*(tr(G)*exp(-2*q) - n) + 0.3*sin(5*t)*G[1,2],
    dissipation(body_inertia = 1)
)]
pub(crate) struct Driven;

/// Viscosity in the frame of space.
#[affine_model(
    dim = 3,
    symmetry(space = affine, body = metric),
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1),
    potential = 10/2*sinh(q)^2 + 0.5*(tr(G)*exp(-2*q) - n),
    dissipation(space_inertia = r)
)]
pub(crate) struct Spatial {
    pub(crate) r: f64,
}

/// Viscosity in both frames.
#[affine_model(
    dim = 3,
    kinetic(dalembert = diag(1, 1.5, 2)),
    potential = 10/2*sinh(q)^2 + 0.5*(tr(G)*exp(-2*q) - n),
    dissipation(space_inertia = r, body_inertia = r)
)]
pub(crate) struct Everywhere {
    pub(crate) r: f64,
}

/// A centre of mass that is stopped.
#[affine_model(
    dim = 3,
    kinetic(body_inertia = 1, casimir2 = 0.2, space_translation = 2),
    potential = 0.5*(tr(G) - 2*ln(det)) + 9.81*x[3],
    dissipation(body_inertia = 1, space_translation = r)
)]
pub(crate) struct Moving {
    pub(crate) r: f64,
}

/// A viscous body of constant volume.
#[affine_model(
    dim = 3,
    constraint = isochoric,
    kinetic(body_inertia = 1, casimir2 = 0.2),
    potential = 0.5*tr(G),
    dissipation(body_inertia = r)
)]
pub(crate) struct Isochoric {
    pub(crate) r: f64,
}

/// P9 for many bodies.
#[affine_model(
    dim = 3,
    symmetry(space = affine, body = metric),
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1),
    potential = 10/2*sinh(q)^2 + 0.5*(tr(G)*exp(-2*q) - n),
    dissipation(body_inertia = r),
    emit(lanes)
)]
pub(crate) struct Crowd {
    pub(crate) r: f64,
}

/// Friction in the frame of the body, `r/2 |phi^-1 phi_dot|^2`, beside a kinetic energy that is not: where the body is small
/// friction is fast, at the rate `r/Q^2`. It shrinks to stretches of `sqrt(0.002)`.
#[affine_model(
    dim = 2,
    kinetic(dalembert = 1),
    potential = 5*tr(G) - 0.02*log(det),
    dissipation(body_inertia = r)
)]
pub(crate) struct Shrinking {
    pub(crate) r: f64,
}
