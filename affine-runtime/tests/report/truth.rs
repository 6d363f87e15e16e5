//! What reports hold runs against: reference solutions and the local error of steps.

use affine_runtime::frames::Matrix;
use affine_runtime::model::Model;
use affine_runtime::report::{WorkPrecision, reference_solution};
use affine_runtime::state::Phase;
use affine_runtime::{Error, Method, Simulation};

use crate::simulation::models::drunk_missile::{self, DrunkMissile};
use crate::simulation::models::planar::{self, Planar};
use crate::simulation::models::vibrating_body::{self, VibratingBody};
use crate::simulation::reference;

fn distance<const N: usize>(a: &Matrix<N>, b: &Matrix<N>) -> f64 {
    (a - b).norm() / b.norm()
}

#[test]
fn double_double_solutions_agree_with_45_digits() {
    for (t_end, state) in reference::DRUNK_MISSILE {
        let exact = DrunkMissile.unflatten(&state);
        let found = reference_solution(&DrunkMissile, &drunk_missile::start(), (0.0, t_end)).unwrap();
        // The coefficients of these models are doubles, and so are start and end.
        assert!(distance(found.phi(), exact.phi()) < 1e-15, "{:e}", distance(found.phi(), exact.phi()));
        assert!(distance(&found.sigma_hat().0.0, &exact.sigma_hat().0.0) < 1e-15);
        assert!((found.x() - exact.x()).norm() / exact.x().norm() < 1e-15);
    }
    let (t_end, state) = reference::VIBRATING_BODY[0];
    let exact = Matrix::<3>::from_row_slice(&state[..9]);
    let found =
        reference_solution(&VibratingBody::BENCHMARK, &vibrating_body::start(), (0.0, t_end)).unwrap();
    assert!(distance(found.phi(), &exact) < 1e-14, "{:e}", distance(found.phi(), &exact));
}

#[test]
fn backwards_it_returns() {
    let start = drunk_missile::start();
    let there = reference_solution(&DrunkMissile, &start, (1.0, 3.0)).unwrap();
    let back = reference_solution(&DrunkMissile, &there, (3.0, 1.0)).unwrap();
    // The rounding of the point in between, grown over two units of time.
    assert!(distance(back.phi(), start.phi()) < 1e-15);
}

#[test]
fn without_a_reference_one_is_computed() {
    let (t_end, state) = reference::DRUNK_MISSILE[0];
    let measure = |report: WorkPrecision<'_, 3, DrunkMissile>| {
        let report = report.tolerances([1e-6]).repeats(1).run().unwrap();
        report.error(&report.rows()[0], "phi").unwrap()
    };
    let given = measure(
        WorkPrecision::new(&DrunkMissile, drunk_missile::start(), t_end)
            .against(DrunkMissile.unflatten(&state)),
    );
    let computed = measure(WorkPrecision::new(&DrunkMissile, drunk_missile::start(), t_end));
    assert!((given - computed).abs() < 1e-15, "{given:e} {computed:e}");
}

#[test]
fn a_motion_that_ends_on_the_way_has_no_reference() {
    let model = Planar::<true> { spring: 0.0, singular_at: Some(0.5), is_weighed: false };
    let none = reference_solution(&model, &planar::start(0.1), (0.0, 1.0));
    assert_eq!(none, Err(Error::NoReference { model: "Planar" }));
}

/// At loose tolerances its estimators are far from what they are made for.
const STIFF: VibratingBody = VibratingBody { kappa: 1e3, ..VibratingBody::BENCHMARK };

/// The share of steps of a run that err by more than the tolerance, against the solution in double-double arithmetic:
/// of the placement alone, and of placement or momentum relative to its own size.
fn shares(tolerance: f64) -> [f64; 2] {
    let run = Simulation::new(&STIFF, vibrating_body::start())
        .until(1.0)
        .tolerance(tolerance)
        .method(Method::RungeKutta5)
        .run()
        .unwrap();
    let mut above = [0, 0];
    for ((t, begin), (t_next, end)) in run.iter().zip(run.iter().skip(1)) {
        let exact = reference_solution(&STIFF, begin, (t, t_next)).unwrap();
        let phi = distance(end.phi(), exact.phi());
        let spin = distance(&end.sigma_hat().0.0, &exact.sigma_hat().0.0);
        above[0] += usize::from(phi > tolerance);
        above[1] += usize::from(phi > tolerance || spin > tolerance);
    }
    above.map(|above| above as f64 / (run.len() - 1) as f64)
}

#[test]
fn steps_above_tolerance_are_counted() {
    let mut seen = Vec::new();
    for tolerance in [0.1, 0.05, 1e-2, 1e-3, 1e-6] {
        let report = WorkPrecision::new(&STIFF, vibrating_body::start(), 1.0)
            .methods([Method::RungeKutta5])
            .tolerances([tolerance])
            .repeats(1)
            .run()
            .unwrap();
        let share = report.rows()[0].outcome.as_ref().unwrap().above_tolerance.unwrap();
        let [of_placement, of_any] = shares(tolerance);
        assert!(of_placement <= share && share <= of_any, "{tolerance:e}: {of_placement} {share} {of_any}");
        seen.push(share);
    }
    assert!(seen.iter().any(|share| *share > 0.0), "no step errs: the test shows nothing: {seen:?}");
}

#[test]
fn what_has_no_tolerance_has_no_share() {
    let report = WorkPrecision::new(&Planar::FREE, planar::start(0.1), 3.0)
        .tolerances([1e-14])
        .repeats(1)
        .run()
        .unwrap();
    for row in report.rows() {
        assert_eq!(row.outcome.as_ref().unwrap().above_tolerance, None, "{:?}", row.method);
    }
}
