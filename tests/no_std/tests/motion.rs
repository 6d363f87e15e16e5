//! The reduced equations of the model without the standard library, run.
#![allow(clippy::unwrap_used)]

use affine_no_std::{DrunkMissile, HeavyMissile, follow};
use affine_runtime::prelude::*;

/// Euler's method conserves the energy to first order in the step: half the step, half the drift.
#[test]
fn energy_drifts_with_the_step() {
    let phi = Matrix::<3>::identity();
    let spin = Comoving(Matrix::<3>::new(0.1, 0.4, -0.3, -0.2, -0.15, 0.25, 0.35, -0.1, 0.05));
    let (x, p) = (Vector::<3>::zeros(), Vector::<3>::new(0.3, -0.2, 0.5));
    let start = DrunkMissile.at_momentum(x, phi, p, spin).unwrap();
    let drift = |steps: usize| {
        let (placement, [before, after]) = follow(&DrunkMissile, &start, 1.0 / steps as f64, steps);
        assert!((placement - phi).norm() > 0.1, "the body moves: {placement}");
        (after - before).abs()
    };
    let ratio = drift(1000) / drift(2000);
    assert!((ratio - 2.0).abs() < 0.01, "{ratio}");
}

/// A mass of 1 in a field is the mass 1 in the attribute, up to the rounding of coefficients.
#[test]
fn fields_are_prepared() {
    let model = HeavyMissile { m: 1.0 }.prepare().unwrap();
    let phi = Matrix::<3>::identity();
    let spin = Comoving(Matrix::<3>::new(0.1, 0.4, -0.3, -0.2, -0.15, 0.25, 0.35, -0.1, 0.05));
    let (x, p) = (Vector::<3>::zeros(), Vector::<3>::new(0.3, -0.2, 0.5));
    let prepared = follow(&model, &model.at_momentum(x, phi, p, spin).unwrap(), 0.01, 100);
    let literal = follow(&DrunkMissile, &DrunkMissile.at_momentum(x, phi, p, spin).unwrap(), 0.01, 100);
    // One hundred steps of a few roundings each.
    assert!((prepared.0 - literal.0).norm() < 1e-13);
    assert!(HeavyMissile { m: 0.0 }.prepare().is_err());
}
