//! Bodies at rest and bodies that hardly vibrate: their momenta are small and their forces have few digits, which
//! must not drive the step size down.

use affine_runtime::__private::point;
use affine_runtime::Simulation;
use affine_runtime::frames::{Comoving, Matrix};
use affine_runtime::state::{Phase, Pinned};

use crate::models::vibrating_body::{Body3, VibratingBody};

/// A rotation, with entries that are not exact, and a strain of the given amplitude after it; no momentum.
fn nearly_undeformed(amplitude: f64) -> Body3 {
    let ((s, c), (s2, c2)) = (0.7f64.sin_cos(), 0.3f64.sin_cos());
    let turn = Matrix::<3>::new(c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0)
        * Matrix::<3>::new(1.0, 0.0, 0.0, 0.0, c2, -s2, 0.0, s2, c2);
    let strain = Matrix::<3>::new(1.0, 0.5, 0.3, 0.1, -0.4, 0.2, 0.0, 0.3, 0.6);
    let phi = turn * (Matrix::<3>::identity() + strain * amplitude);
    point(phi, Comoving(Matrix::<3>::zeros()), Pinned)
}

#[test]
fn cost_falls_with_the_amplitude() {
    let model = VibratingBody::BENCHMARK;
    for (amplitude, steps) in [(0.0, 20), (1e-15, 20), (1e-12, 20), (1e-9, 30), (1e-6, 40), (1e-3, 60)] {
        let simulation = Simulation::new(&model, nearly_undeformed(amplitude)).until(10.0).tolerance(1e-12);
        let run = simulation.max_steps(steps).run().unwrap();
        // The energy keeps the vibration within a small multiple of where it began.
        let displacement = |p: &Body3| (p.phi().tr_mul(p.phi()) - Matrix::<3>::identity()).norm();
        let largest = run.points().iter().map(displacement).fold(0.0, f64::max);
        assert!(largest < 10.0 * amplitude + 1e-10, "{amplitude:e}: {largest:e}");
    }
}

#[test]
fn stiff_small_vibrations_go_through() {
    for (kappa, c1) in [(1e6, 0.5), (10.0, 1e4)] {
        let model = VibratingBody { kappa, c1, ..VibratingBody::BENCHMARK };
        for amplitude in [0.0, 1e-12, 1e-6] {
            let simulation =
                Simulation::new(&model, nearly_undeformed(amplitude)).until(1.0).tolerance(1e-12);
            simulation.max_steps(700).run().unwrap();
        }
    }
}

#[test]
fn small_vibrations_are_accurate_relative_to_the_placement() {
    // Twice the resolution in the tolerance changes the placement by no more than the tolerance allows.
    let model = VibratingBody::BENCHMARK;
    let at = |tolerance: f64| {
        let simulation = Simulation::new(&model, nearly_undeformed(1e-5)).until(10.0).tolerance(tolerance);
        *simulation.run().unwrap().end().1.phi()
    };
    let fine = at(1e-14);
    for tolerance in [1e-8, 1e-10, 1e-12] {
        let error = (at(tolerance) - fine).norm() / fine.norm();
        assert!(error < 10.0 * tolerance, "{tolerance:e}: {error:e}");
    }
}
