//! Stretches far from 1 in further families, and potentials that know `q`.

use affine_runtime::prelude::*;
use affine_runtime::report::{Demand, Oracle, StabilityReport};

use super::shared::{relative_distance_by_rows, run, scene};
use super::stretches::{Affine, Gas, HookeDisc, SAME, ShiftedDisc, Straight, Tensor, generic, maps};

pub(super) fn cases(report: &mut StabilityReport) -> affine_runtime::Result<()> {
    in_space(report)?;
    in_the_plane(report)
}

/// Affine in space, and in flat space, where maps of space act on the velocity as well.
fn in_space(report: &mut StabilityReport) -> affine_runtime::Result<()> {
    let (phi, rate) = generic();
    let affine = run(&Affine, Affine.at_velocity(phi, phi * rate)?, 2.0)?;
    let straight = run(&Straight, Straight.at_velocity(phi, phi * rate)?, 0.5)?;
    let gas = Gas { a: 0.3, b: 0.2 }.prepare()?;
    let gas = run(&gas, gas.at_momentum(phi, Comoving(rate))?, 2.0)?;
    for (name, map) in maps() {
        let named = |model| scene(model, 3, name.to_owned(), "phi by rows", Oracle::Invariance);
        report.case(named("affine-affine"), Demand::Held(SAME), || {
            let start = Affine.at_momentum(map * phi, affine.points()[0].sigma_hat())?;
            let mapped = run(&Affine, start, 2.0)?;
            let error = relative_distance_by_rows(mapped.end().1.phi(), &(map * affine.end().1.phi()));
            Ok((error, mapped.statistics().steps))
        });
        // exp(q) and exp(-q) know c: it goes into their coefficients.
        if map[(0, 0)] == map[(2, 2)] {
            report.case(named("body J, D and 1/D"), Demand::Held(SAME), || {
                let c = map[(0, 0)];
                let mapped = Gas { a: 0.3 / c, b: 0.2 * c }.prepare()?;
                let mapped = run(&mapped, mapped.at_momentum(map * phi, Comoving(rate))?, 2.0)?;
                let error = relative_distance_by_rows(mapped.end().1.phi(), &(map * gas.end().1.phi()));
                Ok((error, mapped.statistics().steps))
            });
        }
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
