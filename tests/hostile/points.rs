//! Starts that are no phase points, put together without a check.

use affine_runtime::prelude::*;
use affine_runtime::simulate::Reason;

use crate::sweep::{Sweep, refused, sound, sweep};

struct NotFinite;

impl Sweep for NotFinite {
    fn over<const N: usize, M: Model<N>>(&self, model: &M, start: M::Point<f64>, methods: &[Method]) {
        let good = model.flatten(&start);
        for &method in methods {
            for k in 0..good.as_ref().len() {
                for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
                    let mut full = good;
                    full.as_mut()[k] = bad;
                    let label = format!("{method:?}, component {k} is {bad}");
                    let run = sound().of(model, model.unflatten(&full), method);
                    let reason = refused(run, &["stopped at t = 0 after 0 steps", "not finite"], &label);
                    assert_eq!(reason, Reason::NotFinite, "{label}");
                }
            }
        }
    }
}

#[test]
fn with_components_that_are_no_numbers() {
    sweep(NotFinite);
}

struct Inverted;

impl Sweep for Inverted {
    fn over<const N: usize, M: Model<N>>(&self, model: &M, start: M::Point<f64>, methods: &[Method]) {
        // As they stand, the momentum in the frame of the model: what is computed from them would not be finite.
        let placed = |phi: Matrix<N>| {
            let mut entries = Vec::new();
            start.entries(&mut |entry| entries.push(entry));
            entries.splice(..N * N, phi.as_slice().iter().copied());
            let mut entries = entries.into_iter();
            start.with_entries(&mut || entries.next().unwrap())
        };
        let phi = *start.phi();
        let row = |scale: f64| {
            let mut rows = phi;
            let first = rows.row(0).into_owned();
            rows.set_row(1, &(first * scale));
            rows
        };
        let mut mirrored = phi;
        mirrored.swap_rows(0, 1);
        for &method in methods {
            // Rows that are multiples, exactly: by powers of two.
            for (what, phi) in [
                ("0", Matrix::<N>::zeros()),
                ("singular", row(1.0)),
                ("singular and graded", row(2.0_f64.powi(-600))),
                ("mirrored", mirrored),
                ("mirrored and small", mirrored * 1e-150),
                ("mirrored and large", mirrored * 1e150),
            ] {
                let label = format!("{method:?}: {what}");
                let reason =
                    refused(sound().of(model, placed(phi), method), &["det phi = ", "not positive"], &label);
                let Reason::Placement { determinant, t, .. } = reason else { panic!("{label}: {reason:?}") };
                assert!(determinant <= 0.0 && t == 0.0, "{label}: {determinant}");
            }
        }
    }
}

#[test]
fn with_placements_that_do_not_keep_orientation() {
    sweep(Inverted);
}
