//! Stretches that coincide, and starts that do nothing.

use affine_runtime::decompose::LinearMap;
use affine_runtime::prelude::*;
use affine_runtime::report::{Demand, Oracle, StabilityReport};

use super::shared::{energy, relative_distance, run, scene};

#[affine_model(dim = 2, kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1))]
pub(crate) struct Disc;

#[affine_model(dim = 3, kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1))]
pub(crate) struct Body;

#[affine_model(dim = 3, kinetic(dalembert = 1), potential = q1^2 + q2^2 + q3^2)]
pub(crate) struct Hencky;

#[affine_model(dim = 2, kinetic(dalembert = 1), potential = q1^2 + q2^2)]
pub(crate) struct HenckyDisc;

#[affine_model(dim = 3, kinetic(casimir2 = 0.2, body_inertia = diag(1, 1.5, 2)), potential = pairs(d^2) + q^2)]
pub(crate) struct Uneven;

#[affine_model(dim = 3, kinetic(casimir2 = 0.2, body_inertia = 1, body_translation = 1), potential = neo_hookean(0.5))]
pub(crate) struct Missile;

#[affine_model(
    dim = 3,
    kinetic(dalembert = diag(1, 1.5, 2)),
    potential = hyperbolic_dilatation(10) + neo_hookean(0.5),
)]
pub(crate) struct Elastic;

/// Roundings of some hundred steps.
const SAME: f64 = 1e-11;

pub(super) fn cases(report: &mut StabilityReport) -> affine_runtime::Result<()> {
    report.heading("coincident stretches, rest, pure rotation, normal generators");
    rest(report);
    rotation(report);
    generators(report);
    crossing(report)
}

/// A body at rest without a force stays where it is, to the last bit.
fn rest(report: &mut StabilityReport) {
    let unit = Matrix::<3>::identity();
    let zero = Matrix::<3>::zeros();
    let named = |model| scene(model, 3, "at rest".to_owned(), "phi", Oracle::ClosedForm);
    report.case(named("body-metric"), Demand::Held(0.0), || {
        let solution = run(&Body, Body.at_momentum(unit, Comoving(zero))?, 10.0)?;
        Ok((relative_distance(solution.end().1.phi(), &unit), solution.statistics().steps))
    });
    report.case(named("d'Alembert, Hencky"), Demand::Held(1e-15), || {
        let solution = run(&Hencky, Hencky.at_momentum(unit, TwoPoint(zero))?, 10.0)?;
        Ok((relative_distance(solution.end().1.phi(), &unit), solution.statistics().steps))
    });
    report.case(named("body J, pairs(d^2) + q^2"), Demand::Held(1e-15), || {
        let solution = run(&Uneven, Uneven.at_momentum(unit, Comoving(zero))?, 10.0)?;
        Ok((relative_distance(solution.end().1.phi(), &unit), solution.statistics().steps))
    });
    report.case(named("d'Alembert, elastic"), Demand::Held(1e-15), || {
        let solution = run(&Elastic, Elastic.at_momentum(unit, TwoPoint(zero))?, 10.0)?;
        Ok((relative_distance(solution.end().1.phi(), &unit), solution.statistics().steps))
    });
    report.case(named("drunk missile, p = 0"), Demand::Held(1e-15), || {
        let none = Vector::<3>::zeros();
        let solution = run(&Missile, Missile.at_momentum(none, unit, none, Comoving(zero))?, 10.0)?;
        Ok((relative_distance(solution.end().1.phi(), &unit), solution.statistics().steps))
    });
}

/// A skew generator commutes with its transpose: `phi = phi0 exp(t W)`. At `phi0 = 1` all stretches coincide for ever.
fn rotation(report: &mut StabilityReport) {
    let turn = Matrix::<3>::new(0.0, -0.5, 0.3, 0.5, 0.0, -0.7, -0.3, 0.7, 0.0);
    let unit = Matrix::<3>::identity();
    let exact = (turn * 10.0).skew_exponential();
    let named = |model| scene(model, 3, "pure rotation, t = 10".to_owned(), "phi", Oracle::ClosedForm);
    report.case(named("body-metric"), Demand::Held(SAME), || {
        let solution = run(&Body, Body.at_velocity(unit, turn)?, 10.0)?;
        Ok((relative_distance(solution.end().1.phi(), &exact), solution.statistics().steps))
    });
    // Of the flat body the stretch about the axis is held by the centrifugal force: Q Q_dot^2 = 2 ln Q/Q in the plane.
    let stretch = 1.25_f64;
    let rate = (2.0 * stretch.ln()).sqrt() / stretch;
    let named =
        scene("d'Alembert, Hencky", 2, "steady rotation, t = 10".to_owned(), "phi", Oracle::ClosedForm);
    report.case(named, Demand::Held(SAME), || {
        let phi = Matrix::<2>::identity() * stretch;
        let spin = Matrix::<2>::new(0.0, -rate, rate, 0.0);
        let solution = run(&HenckyDisc, HenckyDisc.at_velocity(phi, phi * spin)?, 10.0)?;
        let exact = phi * (spin * 10.0).skew_exponential();
        Ok((relative_distance(solution.end().1.phi(), &exact), solution.statistics().steps))
    });
}

/// Normal generators `a + b J`: `phi = phi0 exp(t M) = phi0 e^(a t) (cos bt + J sin bt)`; and nearly normal ones, against the
/// product formula of plane exponentials.
fn generators(report: &mut StabilityReport) {
    let phi = Matrix::<2>::new(1.2, 0.3, -0.1, 0.9);
    let (a, b, t) = (0.2_f64, 0.7_f64, 5.0_f64);
    for off in [0.0, 1e-15, 1e-8, 1e-4] {
        let named =
            scene("body-metric", 2, format!("normal generator + {off:e}"), "phi, t = 5", Oracle::ClosedForm);
        report.case(named, Demand::Held(SAME), || {
            // M = a + b J + off diag(1, -1); w = (I - A)/(I + A) = 2/3.
            let rate = Matrix::<2>::new(a + off, -b, b, a - off);
            let solution = run(&Disc, Disc.at_velocity(phi, phi * rate)?, t)?;
            // exp(t (a + off Z - w b J)) with Z^2 = 1, J^2 = -1, ZJ = -JZ: (off Z - w b J)^2 = off^2 - (w b)^2.
            let (w, z) = (2.0 / 3.0, Matrix::<2>::new(1.0, 0.0, 0.0, -1.0));
            let j = Matrix::<2>::new(0.0, -1.0, 1.0, 0.0);
            let omega = ((w * b) * (w * b) - off * off).sqrt();
            let generator = z * off - j * (w * b);
            let first = Matrix::<2>::identity() * (omega * t).cos() + generator * ((omega * t).sin() / omega);
            let (sine, cosine) = ((1.0 + w) * b * t).sin_cos();
            let exact = phi * first * Matrix::<2>::new(cosine, -sine, sine, cosine) * (a * t).exp();
            Ok((relative_distance(solution.end().1.phi(), &exact), solution.statistics().steps))
        });
    }
}

/// Through and near coincident stretches: a potential of single stretches does not know rotations of space and body.
fn crossing(report: &mut StabilityReport) -> affine_runtime::Result<()> {
    let turn = Matrix::<3>::new(0.0, -0.5, 0.3, 0.5, 0.0, -0.7, -0.3, 0.7, 0.0).skew_exponential();
    let other = Matrix::<3>::new(0.0, 0.9, 0.2, -0.9, 0.0, 0.4, -0.2, -0.4, 0.0).skew_exponential();
    for off in [0.0, 1e-15, 1e-12, 1e-8, 1e-4] {
        let phi = Matrix::<3>::from_diagonal(&Vector::<3>::new(1.1, 1.1 + off, 1.1 - off));
        let velocity = Matrix::<3>::new(0.2, 0.1, 0.0, 0.1, -0.3, 0.2, -0.1, 0.0, 0.15);
        let named = |quantity| {
            scene(
                "d'Alembert, Hencky",
                3,
                format!("stretches apart by {off:e}"),
                quantity,
                Oracle::Invariance,
            )
        };
        let plain = run(&Hencky, Hencky.at_velocity(phi, velocity)?, 5.0)?;
        report.case(named("phi, turned"), Demand::Held(SAME), || {
            let start = Hencky.at_velocity(turn * phi * other, turn * velocity * other)?;
            let turned = run(&Hencky, start, 5.0)?;
            let expected = turn * plain.end().1.phi() * other;
            Ok((relative_distance(turned.end().1.phi(), &expected), turned.statistics().steps))
        });
        report.case(named("energy"), Demand::Held(SAME), || Ok((energy(&plain), plain.statistics().steps)));
    }
    Ok(())
}
