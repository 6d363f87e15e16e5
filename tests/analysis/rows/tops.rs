//! Rigid bodies.

use affine_runtime::analysis::{Condition, Generator, StabilityVerdict, equilibrium, relative_equilibrium};
use affine_runtime::prelude::*;

use super::{Row, assert_near, assert_paired, frequencies, turned};
use crate::models::{FreeTop, Hanging, Top, turning, unrest};

pub(super) fn assert_row(row: &Row) {
    match row.text("kind") {
        "free top, stationary rotation" => assert_free(row),
        "sleeping top" if row.has("parameters/omega") => assert_asleep(row),
        "sleeping top" => assert_critical(row),
        "hanging body, modes" => assert_hanging(row),
        "steady precession" => assert_precession(row),
        other => panic!("no kind {other}"),
    }
}

/// Euler's theorem.
fn assert_free(row: &Row) {
    assert_eq!(row.array("parameters/j"), [1.0, 1.5, 2.0]);
    let (axis, omega) = (row.count("parameters/axis"), row.parameter("omega"));
    let turn = Generator::<3>::rotation(axis % 3 + 1, (axis + 1) % 3 + 1);
    let guess = FreeTop.at_velocity(Matrix::<3>::identity(), turn.space * omega).unwrap();
    let condition = [Condition::Velocity(0, omega)];
    let found = relative_equilibrium(&FreeTop, &guess, &[turn], &condition).unwrap();
    let stability = found.stability(&FreeTop).unwrap();
    assert_paired(&stability);
    match (stability.verdict, row.text("stability")) {
        (StabilityVerdict::Stable, "stable") => {
            assert_near(&frequencies(&stability), &[row.number("nutation_frequency_in_body")], 1e-13);
        }
        (StabilityVerdict::Unstable { rate }, "unstable") => {
            assert!((rate - row.number("growth_rate")).abs() < 1e-13);
        }
        other => panic!("{other:?}"),
    }
    let signs = |numbers: &[f64]| numbers.iter().filter(|one| **one < 0.0).count();
    assert_eq!(signs(&stability.stiffnesses), signs(&row.numbers("second_variation")));
}

fn top(row: &Row) -> Top {
    let [j1, j3, u] = ["j1", "j3", "u"].map(|name| row.parameter(name));
    Top { j1, j3, u }
}

/// Upright, from just below the critical velocity to just above.
fn assert_critical(row: &Row) {
    let top = top(row).prepare().unwrap();
    let critical = row.number("omega_critical");
    let known = row.number("tilt_frequency_at_critical_in_space");
    let turn = [Generator::rotation(1, 2)];
    for (shift, expected) in [(1e-9, true), (-1e-9, false)] {
        let omega = critical * (1.0 + shift);
        let guess = top.at_velocity(Matrix::<3>::identity(), turning(omega)).unwrap();
        let found = relative_equilibrium(&top, &guess, &turn, &[Condition::Velocity(0, omega)]).unwrap();
        let stability = found.stability(&top).unwrap();
        match stability.verdict {
            StabilityVerdict::Stable => assert!(expected),
            StabilityVerdict::Unstable { rate } => assert!(!expected && rate < 1e-3),
            other => panic!("{other:?}"),
        }
        // In the frame that turns, of either sign: two meet, by the square root of the shift.
        let mean = frequencies(&stability).into_iter().map(|one| one - critical).sum::<f64>() / 2.0;
        assert!((mean.abs() - known).abs() < 1e-7, "{mean}: {:?}", stability.eigenvalues);
    }
}

/// Asleep or not, with its eigenvalues, and with the stiffness of a tilt in frames that turn by `k`.
fn assert_asleep(row: &Row) {
    let top = top(row).prepare().unwrap();
    let omega = row.parameter("omega");
    let one = Matrix::<3>::identity();
    let of = |k: f64| {
        let found = turned(&top, one, [k, omega - k], |phi, rate| top.at_velocity(phi, rate)).unwrap();
        found.stability(&top).unwrap()
    };
    let stability = of(omega);
    assert_paired(&stability);
    let known = |k: usize, part: &str| row.number(&format!("eigenvalues_in_space/{k}/{part}"));
    match (stability.verdict, row.text("stability")) {
        (StabilityVerdict::Stable, "stable") => {
            // In the frame that turns these less omega.
            let mut expected = [0, 1].map(|k| (known(k, "im") - omega).abs());
            expected.sort_by(f64::total_cmp);
            assert_near(&frequencies(&stability), &expected, 1e-13);
        }
        (StabilityVerdict::Unstable { rate }, "unstable") => {
            assert!((rate - known(1, "re")).abs() < 1e-13);
            let growing = stability.eigenvalues.iter().find(|one| one.value.re > one.error).unwrap();
            assert!((growing.value.im.abs() - (known(1, "im") - omega).abs()).abs() < 1e-13);
        }
        other => panic!("{other:?}"),
    }
    let half = row.number("I3") * omega / (2.0 * row.number("I1"));
    for (k, name) in [(0.0, "k=0"), (omega, "k=omega"), (half, "k=I3 omega~1(2 I1)")] {
        let stiffness = row.number(&format!("tilt_stiffness_in_frame_k/{name}"));
        assert_eq!(of(k).stiffnesses[0] > 0.0, stiffness > 0.0, "{name}");
    }
}

/// `sqrt(u/I_k)`; upright the same modes grow.
fn assert_hanging(row: &Row) {
    assert_eq!((row.array("parameters/j"), row.parameter("u")), ([1.0, 1.5, 2.0], 0.7));
    let down = Matrix::<3>::from_diagonal(&Vector::<3>::new(1.0, -1.0, -1.0));
    for (sign, phi) in [(1.0, down), (-1.0, Matrix::<3>::identity())] {
        let guess = Hanging.at_velocity(phi, Matrix::<3>::zeros()).unwrap();
        let modes = equilibrium(&Hanging, &guess).unwrap().isolated().unwrap().modes(&Hanging).unwrap();
        let mut found: Vec<f64> = modes.modes.iter().map(|mode| (sign * mode.squared).sqrt()).collect();
        found.sort_by(f64::total_cmp);
        assert_near(&found, &row.numbers("frequencies"), 1e-14);
        assert_eq!(modes.zeros, 1);
    }
}

/// Slow and fast, with their nutations.
fn assert_precession(row: &Row) {
    let top = top(row).prepare().unwrap();
    let (tilt, spin) = (row.parameter("theta"), row.parameter("body_spin"));
    let (sin, cos) = tilt.sin_cos();
    let tilted = Matrix::<3>::new(1.0, 0.0, 0.0, 0.0, cos, -sin, 0.0, sin, cos);
    for name in ["slow", "fast"] {
        let of = |part: &str| row.number(&format!("{name}/{part}"));
        let velocities = [of("Omega"), spin - of("Omega") * cos];
        let found = turned(&top, tilted, velocities, |phi, rate| top.at_velocity(phi, rate)).unwrap();
        assert!((found.point.phi()[(2, 2)] - cos).abs() < 1e-12, "{found:?}");
        assert!((found.point.spin().0.0[(0, 1)].abs() - of("p_phi")).abs() < 1e-11, "{found:?}");
        let stability = found.stability(&top).unwrap();
        assert_paired(&stability);
        assert_near(&frequencies(&stability), &[of("nutation")], 1e-11);
        assert_eq!(stability.verdict, StabilityVerdict::Stable);
        assert!(unrest(&top, &found, 30.0) < 1e-9);
    }
}
