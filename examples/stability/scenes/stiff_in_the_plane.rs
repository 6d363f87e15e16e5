//! Stiff dilatation that does not separate, in the plane.

use affine_runtime::decompose::LinearMap;
use affine_runtime::prelude::*;
use affine_runtime::report::StabilityReport;

use super::shared::run;
use super::stiff::{KAPPAS, both};

#[affine_model(
    dim = 2,
    kinetic(dalembert = diag(1, 1.5)),
    potential = hyperbolic_dilatation(kappa) + neo_hookean(0.5),
)]
pub(crate) struct Elastic {
    kappa: f64,
}

#[affine_model(dim = 2, constraint = isochoric, kinetic(dalembert = diag(1, 1.5)), potential = neo_hookean(0.5))]
pub(crate) struct ConfinedElastic;

#[affine_model(
    dim = 2,
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, body_translation = 1),
    potential = hyperbolic_dilatation(kappa) + neo_hookean(0.5),
)]
pub(crate) struct Missile {
    kappa: f64,
}

#[affine_model(
    dim = 2,
    constraint = isochoric,
    kinetic(casimir2 = 0.2, body_inertia = 1, body_translation = 1),
    potential = neo_hookean(0.5),
)]
pub(crate) struct ConfinedMissile;

/// From `det phi = 1` and a traceless velocity, as in space.
pub(super) fn cases(report: &mut StabilityReport) -> affine_runtime::Result<()> {
    let t = 1.0;
    let phi = Matrix::<2>::new(1.2, 0.3, -0.1, 0.9).isochoric_part();
    let rate = Matrix::<2>::new(0.3, -0.4, 0.6, -0.3);
    let confined = run(&ConfinedElastic, ConfinedElastic.at_velocity(phi, phi * rate)?, t)?;
    for kappa in KAPPAS {
        let model = Elastic { kappa }.prepare()?;
        let solution = run(&model, model.at_velocity(phi, phi * rate)?, t);
        let omega = (kappa / 4.0 * (1.0 + 1.0 / 1.5)).sqrt();
        both(report, ("d'Alembert", kappa, t), solution, &confined, omega);
    }
    let (x, p) = (Vector::<2>::zeros(), Vector::<2>::new(0.3, -0.2));
    let confined = run(&ConfinedMissile, ConfinedMissile.at_momentum(x, phi, p, Comoving(rate))?, t)?;
    for kappa in KAPPAS {
        let model = Missile { kappa }.prepare()?;
        let solution = run(&model, model.at_momentum(x, phi, p, Comoving(rate))?, t);
        // n (I + A + n B)
        both(report, ("drunk missile", kappa, t), solution, &confined, (kappa / 2.8).sqrt());
    }
    Ok(())
}
