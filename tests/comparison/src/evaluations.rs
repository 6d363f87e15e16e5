//! Splitting and Gauss collocation beside the automatic choice, by evaluations at equal errors, on the benchmark problems
//! that do not take long: what `cargo run --release --example work_precision -- symplectic` prints for all.
use std::time::Duration;

use affine_runtime::Method;
use affine_runtime::capability::{InLanes, Taylor};

use crate::equal_steps::{Curve, Motion};
use crate::frontier::{ERRORS, least_cost};
use crate::problems::{self, Visitor};

/// Counts are interpolated, and the iterations of Gauss collocation depend on how products are rounded: a tenth, and less
/// than the difference of neighbouring methods.
const SCATTER: f64 = 0.1;

/// Problem and method, with the evaluations at the errors 1e-6 and 1e-9.
const PINNED: [(&str, &str, [f64; 2]); 10] = [
    ("P1", "Runge-Kutta 8", [63.0, 153.0]),
    ("P1", "splitting 4", [80.0, 432.0]),
    ("P1", "splitting 6", [68.0, 146.0]),
    ("P1", "Gauss 6", [565.0, 1136.0]),
    ("P1", "Gauss 12", [571.0, 619.0]),
    ("P5 1e4", "Runge-Kutta 8", [224.0, 433.0]),
    ("P5 1e4", "splitting 4", [228.0, 1268.0]),
    ("P5 1e4", "splitting 6", [145.0, 369.0]),
    ("P5 1e4", "Gauss 6", [1554.0, 3064.0]),
    ("P5 1e4", "Gauss 12", [1240.0, 1580.0]),
];

/// The curves of the problems that are pinned.
struct Counted(Vec<(&'static str, Curve)>);

impl Visitor for Counted {
    fn visit<M: InLanes<3, Point<f64>: Send + Sync> + Taylor<3> + Sync>(
        &mut self,
        name: &'static str,
        model: &M,
        ends: [M::Point<f64>; 2],
        t_end: f64,
    ) -> affine_runtime::Result<()> {
        if PINNED.iter().all(|(problem, ..)| *problem != name) {
            return Ok(());
        }
        let motion = Motion { model, ends, t_end, repeats: (1, Duration::ZERO) };
        let curves = motion.curves()?;
        let explicit = motion.over_tolerances("Runge-Kutta 8", Method::RungeKutta8)?;
        let all = [curves.automatic, explicit].into_iter().chain(curves.splitting).chain(curves.gauss);
        self.0.extend(all.map(|curve| (name, curve)));
        Ok(())
    }
}

#[test]
fn evaluations_at_equal_errors() {
    let mut counted = Counted(Vec::new());
    problems::visit(&mut counted).unwrap();
    let evaluations = |problem: &str, method: &str, error: f64| {
        let curve = counted.0.iter().find(|(name, curve)| *name == problem && curve.name == method);
        let (_, curve) = curve.expect("every method runs on every problem");
        assert_eq!(curve.evaluations.len(), curve.seconds.len());
        least_cost(&curve.evaluations, error)
    };
    let mut missed = Vec::new();
    for (problem, method, pinned) in PINNED {
        let found =
            [ERRORS[1], ERRORS[2]].map(|error| evaluations(problem, method, error).unwrap_or(0.0).round());
        if found.iter().zip(pinned).any(|(found, pinned)| (found - pinned).abs() > SCATTER * pinned) {
            missed.push((problem, method, found));
        }
    }
    assert!(missed.is_empty(), "{missed:#?}");
    // Gauss collocation needs more evaluations of the equations than explicit steps, however many its stages; of four
    // and six it needs fewer than of three where errors are small.
    for problem in ["P1", "P5 1e4"] {
        for error in [1e-3, 1e-6, 1e-9, 1e-12] {
            let explicit = evaluations(problem, "Runge-Kutta 8", error).unwrap();
            for method in ["Gauss 4", "Gauss 6", "Gauss 8", "Gauss 12"] {
                let implicit = evaluations(problem, method, error);
                assert!(
                    implicit.is_none_or(|implicit| implicit > explicit),
                    "{problem}, {method}, {error:e}"
                );
            }
        }
        let gauss = [6, 8, 12].map(|order| evaluations(problem, &format!("Gauss {order}"), 1e-9).unwrap());
        assert!(gauss[0] > gauss[1] && gauss[1] > gauss[2], "{problem}: {gauss:?}");
    }
}
