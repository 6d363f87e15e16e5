//! Stretches far from 1 in further families, and potentials that know `q`.

use affine_runtime::prelude::*;
use affine_runtime::report::{Demand, Oracle, StabilityReport, relative_distance_by_rows};

use super::shared::{energy, run, scene};
use super::stretches::{Affine, FlatHooke, HookeDisc, SAME, ShiftedDisc, Straight, Tensor, generic, maps};

pub(super) fn cases(report: &mut StabilityReport) -> affine_runtime::Result<()> {
    in_space(report)?;
    in_the_plane(report)?;
    flat(report)
}

/// Affine in space, and in flat space, where maps of space act on the velocity as well.
fn in_space(report: &mut StabilityReport) -> affine_runtime::Result<()> {
    let (phi, rate) = generic();
    let affine = run(&Affine, Affine.at_velocity(phi, phi * rate)?, 2.0)?;
    let straight = run(&Straight, Straight.at_velocity(phi, phi * rate)?, 0.5)?;
    for (name, map) in maps() {
        let named = |model| scene(model, 3, name.to_owned(), "phi by rows", Oracle::Invariance);
        report.case(named("affine-affine"), Demand::Held(SAME), || {
            let start = Affine.at_momentum(map * phi, affine.points()[0].sigma_hat())?;
            let mapped = run(&Affine, start, 2.0)?;
            let error = relative_distance_by_rows(mapped.end().1.phi(), &(map * affine.end().1.phi()));
            Ok((error, mapped.statistics().steps))
        });
        report.case(named("d'Alembert, free"), Demand::Held(SAME), || {
            let start = Straight.at_velocity(map * phi, map * phi * rate)?;
            let mapped = run(&Straight, start, 0.5)?;
            let error = relative_distance_by_rows(mapped.end().1.phi(), &(map * straight.end().1.phi()));
            Ok((error, mapped.statistics().steps))
        });
    }
    Ok(())
}

fn in_the_plane(report: &mut StabilityReport) -> affine_runtime::Result<()> {
    let phi = Matrix::<2>::new(1.2, 0.3, -0.1, 0.9);
    let spin = Matrix::<2>::new(0.3, -0.4, 0.6, -0.1);
    let plain = run(&Tensor, Tensor.at_momentum(phi, Comoving(spin))?, 2.0)?;
    let (up, down) = (300.0_f64.exp(), (-300.0_f64).exp());
    for (name, a, b) in [
        ("c = 1e150", 1e150, 1e150),
        ("c = 1e-150", 1e-150, 1e-150),
        ("q = (300, 300)", up, up),
        ("q = (-300, -300)", down, down),
        ("q = (300, -300)", up, down),
    ] {
        let map = Matrix::<2>::new(a, 0.0, 0.0, b);
        let named = |model, quantity| scene(model, 2, name.to_owned(), quantity, Oracle::Invariance);
        report.case(named("body tensor", "phi by rows"), Demand::Held(SAME), || {
            let mapped = run(&Tensor, Tensor.at_momentum(map * phi, Comoving(spin))?, 2.0)?;
            let error = relative_distance_by_rows(mapped.end().1.phi(), &(map * plain.end().1.phi()));
            Ok((error, mapped.statistics().steps))
        });
        if name.starts_with('q') && a == b {
            report.case(named("body J, Hooke", "phi, shifted"), Demand::Held(SAME), || {
                let shifted = ShiftedDisc { s: a.ln() }.prepare()?;
                let shifted = run(&shifted, shifted.at_momentum(phi, Comoving(spin))?, 2.0)?;
                let mapped = run(&HookeDisc, HookeDisc.at_momentum(map * phi, Comoving(spin))?, 2.0)?;
                let error = relative_distance_by_rows(mapped.end().1.phi(), &(map * shifted.end().1.phi()));
                Ok((error, mapped.statistics().steps))
            });
        }
    }
    Ok(())
}

/// The force of a potential in `q` on a flat body is `phi^-T`, which needs `1/det phi` as a number: `|q|` up to 236 in
/// space. What lies beyond is refused.
fn flat(report: &mut StabilityReport) -> affine_runtime::Result<()> {
    let (phi, rate) = generic();
    for q in [100.0_f64, 200.0, 230.0, 240.0, 300.0, -100.0, -200.0, -230.0, -240.0, -300.0] {
        let named = scene("d'Alembert, Hooke", 3, format!("q = {q}"), "energy", Oracle::Invariance);
        let inside = q.abs() < 236.0;
        let demand = if inside { Demand::Held(1e-11) } else { Demand::Refused("range") };
        report.case(named, demand, || {
            // The unit of length is that of time: velocities are of order 1.
            let unit = q.exp();
            let solution = run(&FlatHooke, FlatHooke.at_velocity(phi * unit, phi * rate)?, 0.01 * unit)?;
            Ok((energy(&solution), solution.statistics().steps))
        });
    }
    Ok(())
}
