//! Models of the table under stress from all sides, by one call each.

use affine_runtime::prelude::*;
use affine_runtime::report::{StabilityReport, Stress};

use crate::scenes::Viscous;

/// Stretches and shears as springs.
#[affine_model(
    dim = 3,
    symmetry(space = affine, body = metric),
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1),
    potential = kappa/2*sinh(q)^2 + 0.5*(tr(G)*exp(-2*q) - n),
    emit(taylor, splitting),
)]
struct Vibrating {
    kappa: f64,
}

/// A body without forces, whose motion has a closed form.
#[affine_model(dim = 3, symmetry(space = affine, body = metric), kinetic(casimir2 = 0.2, body_inertia = 1))]
struct Free;

/// The models, by the names that the command line knows.
pub(crate) const NAMES: [&str; 3] = ["vibrating", "viscous", "free"];

/// A model under stress; `None` where there is none of that name.
pub(crate) fn report(name: &str) -> Option<affine_runtime::Result<StabilityReport>> {
    let seen = |done, of| eprint!("\r{done} of {of}{}", if done == of { "\n" } else { "" });
    let phi = Matrix::<3>::new(1.1, 0.2, -0.1, 0.05, 0.95, 0.1, 0.0, -0.15, 1.05);
    let velocity = Matrix::<3>::new(0.1, -0.3, 0.2, 0.3, -0.2, 0.1, -0.1, 0.2, 0.15);
    let factors = [1e-6, 1e-3, 1e3, 1e6];
    match name {
        "vibrating" => Some((|| {
            let with = |factor: f64| Vibrating { kappa: 10.0 * factor }.prepare();
            let model = with(1.0)?;
            let stress =
                Stress::new(&model, model.at_velocity(phi, velocity)?).until(10.0).fields(factors, with);
            stress.progress(seen).run()
        })()),
        "viscous" => Some((|| {
            let with = |factor: f64| Viscous { r: factor }.prepare();
            let model = with(1.0)?;
            let stress =
                Stress::new(&model, model.at_velocity(phi, velocity)?).until(10.0).fields(factors, with);
            stress.progress(seen).run()
        })()),
        "free" => Some((|| {
            let start = Free.at_velocity(phi, velocity)?;
            let methods = [Method::ClosedForm, Method::RungeKutta8, Method::RungeKutta5];
            Stress::new(&Free, start).until(10.0).methods(methods).progress(seen).run()
        })()),
        _ => None,
    }
}
