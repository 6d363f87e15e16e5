//! What a trajectory tells about itself.

use affine_runtime::__private::point as point_of;
use affine_runtime::Error;
use affine_runtime::model::Conserved;
use affine_runtime::prelude::*;
use affine_runtime::state::Centre;

use crate::models::drunk_missile::{self, DrunkMissile};
use crate::models::planar::{self, Planar};

#[test]
fn drunk_missile_conserves_what_it_should() {
    let run =
        Simulation::new(&DrunkMissile, drunk_missile::start()).until(10.0).tolerance(1e-13).run().unwrap();
    let conservation = run.conservation();
    let quantities: Vec<Conserved> = conservation.drifts().iter().map(|d| d.quantity).collect();
    assert_eq!(quantities, run.description().conserved);
    // The errors of one trajectory, which are below 1e-12.
    assert!(conservation.worst() < 1e-12, "{conservation}");
    assert!(conservation.of(Conserved::AffineSpin).is_none(), "not conserved with p != 0");
    let momentum = conservation.of(Conserved::LinearMomentum).unwrap();
    assert!((momentum.scale - 0.38f64.sqrt()).abs() < 1e-12, "|p| = |(0.3, -0.2, 0.5)|");
    let table = conservation.to_string();
    assert_eq!(table.lines().count(), 2 + quantities.len(), "{table}");
    assert!(table.contains("I = x p^T + Sigma"), "{table}");
}

#[test]
fn at_rest_more_is_conserved() {
    let run = Simulation::new(&DrunkMissile, drunk_missile::start_at_rest()).until(5.0).run().unwrap();
    let conservation = run.conservation();
    assert!(conservation.of(Conserved::AffineSpin).is_some(), "{conservation}");
    assert!(conservation.of(Conserved::LinearMomentum).is_none(), "{conservation}");
    assert!(conservation.worst() < 1e-9, "{conservation}");
    assert!(run.why().to_string().contains("p = 0"), "{}", run.why());
}

/// What an event has set in motion does not rest after an interruption: neither more is conserved then.
#[test]
fn at_rest_until_it_is_pushed() {
    type Point = <DrunkMissile as Model<3>>::Point<f64>;
    let push = |_: f64, point: &Point| {
        let centre = Centre { x: point.x(), p: Vector::<3>::new(0.3, -0.2, 0.5) };
        Ok(point_of(*point.phi(), point.sigma_hat(), centre))
    };
    let pushed = || {
        let at_one = Event::new("push", |t, _: &Point| t - 1.0);
        Simulation::new(&DrunkMissile, drunk_missile::start_at_rest()).until(3.0).event(at_one.change(push))
    };
    let whole = pushed().run().unwrap();
    let steps = whole.statistics().steps - 1;
    let halt = pushed().max_steps(steps).run().unwrap_err();
    let rest = pushed().resume(halt.trajectory.checkpoint().unwrap()).run().unwrap();
    assert_eq!(rest.end(), whole.end());
    assert!(!rest.why().to_string().contains("p = 0"), "{}", rest.why());
    assert!(rest.conservation().of(Conserved::AffineSpin).is_none(), "{}", rest.conservation());
}

/// A body that is dropped has `p = 0` at the start alone.
#[test]
fn what_falls_does_not_stay_at_rest() {
    #[affine_model(dim = 2, kinetic(dalembert = 1, space_translation = 1), potential = 9.81*x[2])]
    struct Dropped;
    let (zero, phi_dot) = (Vector::<2>::zeros(), Matrix::<2>::new(0.0, 1.0, -1.0, 0.0));
    let start = Dropped.at_velocity(zero, Matrix::identity(), zero, phi_dot).unwrap();
    let run = Simulation::new(&Dropped, start).until(1.0).run().unwrap();
    assert!(run.end().1.p()[1] < -9.0);
    assert!(!run.why().to_string().contains("p = 0"), "{}", run.why());
}

#[test]
fn a_drift_is_what_it_is() {
    // A driven body does not keep its energy: Pi_11(t) = Pi_11(0) + 1/(40 - t) - 1/40, and only that changes.
    let model = Planar { singular_at: Some(40.0), ..Planar::FREE };
    let start = planar::start(0.5);
    let run = Simulation::new(&model, start).until(5.0).every(1.0).tolerance(1e-12).run().unwrap();
    let drift = *run.conservation().of(Conserved::Energy).unwrap();
    let (before, after) = (0.5, 0.5 + 1.0 / 35.0 - 1.0 / 40.0);
    assert!((drift.absolute - 0.5 * (after * after - before * before)).abs() < 1e-11);
    // H = |Pi|^2/2, and |Pi| |phi_dot|/2 is the same: both largest at the end.
    let largest = 0.5 * (after * after + 0.01 + 0.04);
    assert!((drift.scale - largest).abs() < 1e-11, "{drift:?}");
    assert!((drift.relative() - drift.absolute / largest).abs() < 1e-11);
    assert_eq!(run.energies().len(), 6);
    assert!((run.energies()[5] - largest).abs() < 1e-11);
}

#[test]
fn the_end_counts_although_it_is_no_output() {
    let model = Planar { singular_at: Some(40.0), ..Planar::FREE };
    let at = |times: &[f64]| {
        let simulation = Simulation::new(&model, planar::start(0.5)).until(5.0).tolerance(1e-12);
        simulation.output(times.iter().copied()).run().unwrap().conservation()
    };
    let (few, all) = (at(&[]), at(&[0.0, 1.0, 5.0]));
    let energy = Conserved::Energy;
    assert_eq!(few.of(energy).unwrap().absolute, all.of(energy).unwrap().absolute);
}

#[test]
fn why_names_method_and_reason() {
    let text = |method| {
        let simulation = Simulation::new(&Planar::FREE, planar::start(0.5)).until(1.0).method(method);
        simulation.run().unwrap().why().to_string()
    };
    assert!(text(Method::Automatic).starts_with("Planar: closed form: this model has one"));
    assert!(text(Method::ClosedForm).starts_with("Planar: closed form, as asked for"));
    assert!(text(Method::RungeKutta8).contains("Method::Automatic would take the closed form"));
    let run =
        Simulation::new(&DrunkMissile, drunk_missile::start()).until(1.0).tolerance(1e-6).run().unwrap();
    let why = run.why().to_string();
    assert!(why.contains("Runge-Kutta of order 8, relative error 1e-6 per step"), "{why}");
    assert!(why.contains("left out of the model: nothing: a naive fixture"), "{why}");
    assert!(!why.contains("p = 0"), "{why}");
    assert_eq!(run.computation().method, Method::RungeKutta8);
}

#[test]
fn csv_of_a_pinned_body() {
    let run = Simulation::new(&Planar::FREE, planar::start(0.5)).until(0.5).every(0.5).run().unwrap();
    let mut text = Vec::new();
    run.csv(&mut text).unwrap();
    let text = String::from_utf8(text).unwrap();
    let expected = [
        "t,phi11,phi12,phi21,phi22,Pi11,Pi12,Pi21,Pi22,energy",
        "0e0,1e0,2e-1,0e0,1.5e0,5e-1,1e-1,0e0,-2e-1,",
        "5e-1,1.25e0,2e-1,5e-2,1.4e0,5e-1,1e-1,0e0,-2e-1,",
    ];
    for (line, expected) in text.lines().zip(expected) {
        assert!(line.starts_with(expected), "{line}");
    }
    // H = |Pi|^2/2 of a body with unit inertia.
    let energy: f64 = text.lines().nth(2).unwrap().split(',').nth(9).unwrap().parse().unwrap();
    assert!((energy - 0.15).abs() < 1e-15, "{energy}");
}

#[test]
fn csv_reads_back_as_the_same_numbers() {
    let run = Simulation::new(&DrunkMissile, drunk_missile::start()).until(1.0).every(0.5).run().unwrap();
    let path = std::env::temp_dir().join(format!("affine-runtime-{}.csv", std::process::id()));
    run.save_csv(&path).unwrap();
    let text = std::fs::read_to_string(&path).unwrap();
    std::fs::remove_file(&path).unwrap();
    let mut lines = text.lines();
    let names = lines.next().unwrap();
    assert!(names.starts_with(
        "t,x1,x2,x3,phi11,phi12,phi13,phi21,phi22,phi23,phi31,phi32,phi33,p1,p2,p3,Sigma_hat11,Sigma_hat12,\
         Sigma_hat13,Sigma_hat21,Sigma_hat22,Sigma_hat23,Sigma_hat31,Sigma_hat32,Sigma_hat33,energy,"
    ));
    for (line, (t, point)) in lines.zip(run.iter()) {
        let numbers: Vec<f64> = line.split(',').map(|n| n.parse().unwrap()).collect();
        let mut expected = vec![t];
        expected.extend(point.x().iter());
        expected.extend(point.phi().transpose().iter());
        expected.extend(point.p().iter());
        expected.extend(point.sigma_hat().0.0.transpose().iter());
        assert_eq!(numbers[..expected.len()], expected);
        assert_eq!(numbers.len(), names.split(',').count());
    }
    assert_eq!(text.lines().count(), 4);
}

#[test]
fn a_file_that_cannot_be_written() {
    let run = Simulation::new(&Planar::FREE, planar::start(0.5)).until(0.5).run().unwrap();
    let path = std::env::temp_dir().join("no such folder").join("run.csv");
    let error = run.save_csv(&path).unwrap_err();
    assert_eq!(error, Error::File { path: path.clone(), kind: std::io::ErrorKind::NotFound });
    assert!(error.to_string().contains("run.csv"), "{error}");
}
