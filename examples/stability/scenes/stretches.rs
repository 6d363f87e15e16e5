//! Stretches far from 1, alike and of very different size.

use affine_runtime::prelude::*;
use affine_runtime::report::{Demand, Oracle, StabilityReport};

use super::shared::{relative_distance_by_rows, run, scene};

#[affine_model(dim = 3, kinetic(casimir2 = 0.2, body_inertia = diag(1, 1.5, 2)))]
pub(crate) struct Body;

#[affine_model(dim = 2, kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1))]
pub(crate) struct Disc;

#[affine_model(dim = 3, kinetic(casimir2 = 0.2, space_inertia = diag(1, 1.5, 2)))]
pub(crate) struct Mirrored;

#[affine_model(
    dim = 3,
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1),
    potential = neo_hookean(0.5),
)]
pub(crate) struct Sheared;

#[affine_model(dim = 3, kinetic(casimir2 = 0.2, body_inertia = diag(1, 1.5, 2)), potential = neo_hookean(0.5))]
pub(crate) struct Uneven;

#[affine_model(dim = 2, kinetic(casimir2 = 0.2, body_inertia = diag(1, 1.5)), potential = neo_hookean(0.5))]
pub(crate) struct UnevenDisc;

#[affine_model(
    dim = 3,
    kinetic(casimir2 = 0.2, body_inertia = diag(1, 1.5, 2)),
    potential = harmonic_dilatation(1) + neo_hookean(0.5),
)]
pub(crate) struct Hooke;

#[affine_model(
    dim = 2,
    kinetic(casimir2 = 0.2, body_inertia = diag(1, 1.5)),
    potential = harmonic_dilatation(1) + neo_hookean(0.5),
)]
pub(crate) struct HookeDisc;

/// Hooke's body with `q` counted from elsewhere.
#[affine_model(
    dim = 3,
    kinetic(casimir2 = 0.2, body_inertia = diag(1, 1.5, 2)),
    potential = (q + s)^2/2 + neo_hookean(0.5),
)]
pub(crate) struct Shifted {
    s: f64,
}

/// The same in the plane.
#[affine_model(
    dim = 2,
    kinetic(casimir2 = 0.2, body_inertia = diag(1, 1.5)),
    potential = (q + s)^2/2 + neo_hookean(0.5),
)]
pub(crate) struct ShiftedDisc {
    pub(super) s: f64,
}

/// Under powers of `D`.
#[affine_model(
    dim = 3,
    kinetic(casimir2 = 0.2, body_inertia = diag(1, 1.5, 2)),
    potential = a*exp(q) + b*exp(-q) + neo_hookean(0.5),
)]
pub(crate) struct Gas {
    pub(super) a: f64,
    pub(super) b: f64,
}

#[affine_model(dim = 3, kinetic(casimir2 = 0.2, casimir1_squared = 0.1))]
pub(crate) struct Affine;

#[affine_model(
    dim = 2,
    kinetic(casimir2 = 0.2, body_tensor = [[2, 0.5, 0, 1], [0.5, 3, 0.25, 0], [0, 0.25, 2, 0.5], [1, 0, 0.5, 4]]),
)]
pub(crate) struct Tensor;

#[affine_model(dim = 3, kinetic(dalembert = diag(1, 1.5, 2)))]
pub(crate) struct Straight;

#[affine_model(
    dim = 3,
    kinetic(casimir2 = 0.2, body_inertia = diag(1, 1.5, 2)),
    potential = pairs(tanh(d)^2),
)]
pub(crate) struct Bound;

#[affine_model(
    dim = 3,
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, body_translation = 1)
)]
pub(crate) struct Missile;

/// Roundings of a hundred steps; the two motions are one, number by number in other units.
pub(super) const SAME: f64 = 1e-11;

pub(super) fn generic() -> (Matrix<3>, Matrix<3>) {
    (
        Matrix::<3>::new(1.1, 0.2, -0.1, 0.05, 0.9, 0.15, -0.2, 0.1, 1.05),
        Matrix::<3>::new(0.1, 0.4, -0.3, -0.2, -0.15, 0.25, 0.35, -0.1, 0.05),
    )
}

/// Maps of space with their names: uniform, and graded by `e^300`.
pub(super) fn maps() -> [(&'static str, Matrix<3>); 5] {
    let diagonal = |a: f64, b: f64, c: f64| Matrix::<3>::from_diagonal(&Vector::<3>::new(a, b, c));
    let (up, down) = (300.0_f64.exp(), (-300.0_f64).exp());
    [
        ("c = 1e150", diagonal(1e150, 1e150, 1e150)),
        ("c = 1e-150", diagonal(1e-150, 1e-150, 1e-150)),
        ("q = (300, 300, 300)", diagonal(up, up, up)),
        ("q = (-300, -300, -300)", diagonal(down, down, down)),
        ("q = (300, 0, -300)", diagonal(up, 1.0, down)),
    ]
}

pub(super) fn cases(report: &mut StabilityReport) -> affine_runtime::Result<()> {
    report.heading("stretches up to e^300");
    geodesics(report)?;
    in_the_plane(report)?;
    potentials(report)?;
    super::more_stretches::cases(report)?;
    super::flat::cases(report)?;
    translation(report)
}

/// `phi -> A phi` takes motions of spatially affine bodies to motions with the same co-moving momentum.
fn geodesics(report: &mut StabilityReport) -> affine_runtime::Result<()> {
    let (phi, spin) = generic();
    let plain = run(&Body, Body.at_momentum(phi, Comoving(spin))?, 2.0)?;
    let mirrored = run(&Mirrored, Mirrored.at_momentum(phi, Spatial(spin))?, 2.0)?;
    for (name, map) in maps() {
        let named = |model| scene(model, 3, name.to_owned(), "phi by rows", Oracle::Invariance);
        report.case(named("body J"), Demand::Held(SAME), || {
            let mapped = run(&Body, Body.at_momentum(map * phi, Comoving(spin))?, 2.0)?;
            let error = relative_distance_by_rows(mapped.end().1.phi(), &(map * plain.end().1.phi()));
            Ok((error, mapped.statistics().steps))
        });
        report.case(named("space J, transposed"), Demand::Held(SAME), || {
            let mapped = run(&Mirrored, Mirrored.at_momentum(phi * map, Spatial(spin))?, 2.0)?;
            let expected = (mirrored.end().1.phi() * map).transpose();
            let error = relative_distance_by_rows(&mapped.end().1.phi().transpose(), &expected);
            Ok((error, mapped.statistics().steps))
        });
    }
    Ok(())
}

fn in_the_plane(report: &mut StabilityReport) -> affine_runtime::Result<()> {
    let phi = Matrix::<2>::new(1.2, 0.3, -0.1, 0.9);
    let spin = Matrix::<2>::new(0.3, -0.4, 0.6, -0.1);
    let closed = run(&Disc, Disc.at_momentum(phi, Comoving(spin))?, 2.0)?;
    let uneven = run(&UnevenDisc, UnevenDisc.at_momentum(phi, Comoving(spin))?, 2.0)?;
    let (up, down) = (300.0_f64.exp(), (-300.0_f64).exp());
    for (name, a, b) in [
        ("c = 1e150", 1e150, 1e150),
        ("c = 1e-150", 1e-150, 1e-150),
        ("q = (300, 300)", up, up),
        ("q = (300, -300)", up, down),
    ] {
        let map = Matrix::<2>::new(a, 0.0, 0.0, b);
        let named = |model| scene(model, 2, name.to_owned(), "phi by rows", Oracle::Invariance);
        report.case(named("body-metric"), Demand::Held(SAME), || {
            let mapped = run(&Disc, Disc.at_momentum(map * phi, Comoving(spin))?, 2.0)?;
            let error = relative_distance_by_rows(mapped.end().1.phi(), &(map * closed.end().1.phi()));
            Ok((error, mapped.statistics().steps))
        });
        if a == b {
            report.case(named("body J, neo-Hookean"), Demand::Held(SAME), || {
                let mapped = run(&UnevenDisc, UnevenDisc.at_momentum(map * phi, Comoving(spin))?, 2.0)?;
                let error = relative_distance_by_rows(mapped.end().1.phi(), &(map * uneven.end().1.phi()));
                Ok((error, mapped.statistics().steps))
            });
        }
    }
    Ok(())
}

/// A potential of the shear alone does not know `c`.
fn potentials(report: &mut StabilityReport) -> affine_runtime::Result<()> {
    let (phi, spin) = generic();
    let sheared = run(&Sheared, Sheared.at_momentum(phi, Comoving(spin))?, 2.0)?;
    let uneven = run(&Uneven, Uneven.at_momentum(phi, Comoving(spin))?, 2.0)?;
    let bound = run(&Bound, Bound.at_momentum(phi, Comoving(spin))?, 2.0)?;
    for (name, map) in maps().into_iter().take(4) {
        let named = |model| scene(model, 3, name.to_owned(), "phi", Oracle::Invariance);
        report.case(named("body-metric, neo-Hookean"), Demand::Held(SAME), || {
            let mapped = run(&Sheared, Sheared.at_momentum(map * phi, Comoving(spin))?, 2.0)?;
            let error = relative_distance_by_rows(mapped.end().1.phi(), &(map * sheared.end().1.phi()));
            Ok((error, mapped.statistics().steps))
        });
        report.case(named("body J, neo-Hookean"), Demand::Held(SAME), || {
            let mapped = run(&Uneven, Uneven.at_momentum(map * phi, Comoving(spin))?, 2.0)?;
            let error = relative_distance_by_rows(mapped.end().1.phi(), &(map * uneven.end().1.phi()));
            Ok((error, mapped.statistics().steps))
        });
        report.case(named("body J, pairs(tanh(d)^2)"), Demand::Held(SAME), || {
            let mapped = run(&Bound, Bound.at_momentum(map * phi, Comoving(spin))?, 2.0)?;
            let error = relative_distance_by_rows(mapped.end().1.phi(), &(map * bound.end().1.phi()));
            Ok((error, mapped.statistics().steps))
        });
        if name.starts_with('q') {
            // Hooke's potential knows c: the motion is that of a body with q counted from -ln c.
            report.case(named("body J, Hooke, shifted"), Demand::Held(SAME), || {
                let shifted = Shifted { s: map[(0, 0)].ln() }.prepare()?;
                let shifted = run(&shifted, shifted.at_momentum(phi, Comoving(spin))?, 2.0)?;
                let mapped = run(&Hooke, Hooke.at_momentum(map * phi, Comoving(spin))?, 2.0)?;
                let error = relative_distance_by_rows(mapped.end().1.phi(), &(map * shifted.end().1.phi()));
                Ok((error, mapped.statistics().steps))
            });
        }
    }
    Ok(())
}

/// With translation `p -> A^-T p`: sums like `phi^T p` have to stay in range, and where they do not it is said.
fn translation(report: &mut StabilityReport) -> affine_runtime::Result<()> {
    let (phi, spin) = generic();
    let (x, p) = (Vector::<3>::zeros(), Vector::<3>::new(0.3, -0.2, 0.5));
    let plain = run(&Missile, Missile.at_momentum(x, phi, p, Comoving(spin))?, 2.0)?;
    for c in [1e50_f64, 1e-50, 1e75, 1e-75, 1e100, 1e-100, 1e150, 1e-150] {
        let named = scene("drunk missile", 3, format!("c = {c:e}"), "phi by rows", Oracle::Invariance);
        let inside = (1e-75..=1e75).contains(&c);
        let demand = if inside { Demand::Held(SAME) } else { Demand::HeldOrRefused(SAME) };
        report.case(named, demand, || {
            let mapped = run(&Missile, Missile.at_momentum(x, phi * c, p / c, Comoving(spin))?, 2.0)?;
            let error = relative_distance_by_rows(mapped.end().1.phi(), &(plain.end().1.phi() * c));
            Ok((error, mapped.statistics().steps))
        });
    }
    Ok(())
}
