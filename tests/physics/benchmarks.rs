//! Vibrating bodies, from gentle to stiff, against reference solutions of 36 to 45 digits.

use affine_runtime::prelude::*;
use affine_runtime::report::reference_solution;

use crate::families::{matrix, vector};
use affine_tests::reference::{assert_close, entries, norm};
use affine_tests::tolerances::{VIBRATION, VIBRATION_PER_RADIAN};

/// Tolerance of the integration, per step: the finest there is.
const FINEST: f64 = 1e-15;

/// Problem P2: affine in space, metrical in the body.
#[affine_model(
    dim = 3,
    symmetry(space = affine, body = metric),
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1),
    potential = 10/2*sinh(q)^2 + 0.5*(tr(G)*exp(-2*q) - n)
)]
struct Vibrating;

/// Problem P2r: metrical in space, affine in the body.
#[affine_model(
    dim = 3,
    symmetry(space = metric, body = affine),
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, space_inertia = 1),
    potential = 10/2*sinh(q)^2 + 0.5*(tr(G)*exp(-2*q) - n)
)]
struct Mirrored;

/// Problems P3 and P6: flat metric, anisotropic body.
#[affine_model(
    dim = 3,
    kinetic(dalembert = diag(1, 1.5, 2)),
    potential = kappa/2*sinh(q)^2 + 0.5*(tr(G)*exp(-2*q) - n),
    emit(nystrom)
)]
struct Elastic {
    kappa: f64,
}

/// Problems P5 and P8: the body of P2 with other stiffnesses.
#[affine_model(
    dim = 3,
    symmetry(space = affine, body = metric),
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1),
    potential = kappa/2*sinh(q)^2 + c1*(tr(G)*exp(-2*q) - n)
)]
struct Stiff {
    kappa: f64,
    c1: f64,
}

/// Problem P7: the stiff body as a drunk missile.
#[affine_model(
    dim = 3,
    symmetry(space = affine, body = metric),
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, body_translation = 1),
    potential = 10000/2*sinh(q)^2 + 0.5*(tr(G)*exp(-2*q) - n)
)]
struct StiffMissile;

/// A row of a reference solution: `t`, `x` (empty without translation), `phi` and the affine spin.
struct Row {
    t: f64,
    x: Vec<f64>,
    phi: Vec<f64>,
    spin: Vec<f64>,
}

/// All rows, the start first, and the name of the affine spin.
fn rows(data: &str) -> (Vec<Row>, &str) {
    let mut lines = data.lines().filter(|line| !line.starts_with('#'));
    let columns: Vec<&str> = lines.next().unwrap().split(',').collect();
    let spin = columns.last().unwrap().strip_suffix("_33").unwrap();
    let centre = columns.len() - 19;
    assert!(centre == 0 || centre == 3, "columns");
    let row = |line: &str| {
        let mut numbers = line.split(',').map(|number| number.parse::<f64>().unwrap());
        let mut take = |count| numbers.by_ref().take(count).collect::<Vec<_>>();
        let row = Row { t: take(1)[0], x: take(centre), phi: take(9), spin: take(9) };
        assert_eq!((row.spin.len(), numbers.next()), (9, None), "columns");
        row
    };
    let rows: Vec<Row> = lines.map(row).collect();
    assert!(rows.len() > 2 && rows[0].t == 0.0, "rows");
    (rows, spin)
}

/// Holds the motion against the rows up to `until`, where `omega` is the largest frequency of the problem.
fn assert_is_the_motion<M: Model<3>>(
    model: &M,
    data: &str,
    until: f64,
    omega: f64,
    start: impl FnOnce(&Row) -> M::Point<f64>,
) {
    let (rows, spin) = rows(data);
    let start = start(&rows[0]);
    let wanted: Vec<&Row> = rows[1..].iter().filter(|row| row.t <= until).collect();
    assert_eq!(wanted.last().unwrap().t, until, "a row at the end");
    let run = Simulation::new(model, start)
        .until(until)
        .tolerance(FINEST)
        .output(wanted.iter().map(|row| row.t))
        .run()
        .unwrap();
    assert_eq!(run.len(), wanted.len());
    for (row, (t, point)) in wanted.into_iter().zip(run.iter()) {
        assert_eq!(row.t, t);
        let tolerance = VIBRATION.max(VIBRATION_PER_RADIAN * omega * t);
        let close = |what: &str, found: &[f64], expected: &[f64]| {
            assert_close(&format!("{what}({t})"), found, expected, norm(expected), tolerance);
        };
        if !row.x.is_empty() {
            close("x", point.x().as_slice(), &row.x);
        }
        close("phi", &entries(point.phi()), &row.phi);
        let found = match spin {
            "sigma" => entries(&point.sigma().0.0),
            "sigma_hat" => entries(&point.sigma_hat().0.0),
            "pi" => entries(&point.pi().0.0),
            other => panic!("no affine spin {other}"),
        };
        close(spin, &found, &row.spin);
    }
}

/// Of the dilatation under `kappa/2 sh^2 q`, `p_dil = n (I+A+nB) q_dot` with I = 1, A = 1/5, B = 1/10, n = 3:
/// `omega^2 = kappa/(n (I+A+nB))` at small amplitude. At amplitude `q` the force `kappa/2 sh 2q` is steeper by at most
/// `ch 2q`.
fn dilatational_frequency(kappa: f64, amplitude: f64) -> f64 {
    (kappa * (2.0 * amplitude).cosh() / (3.0 * (1.0 + 0.2 + 3.0 * 0.1))).sqrt()
}

/// Of the shear under `c1 sum_a (e^(2 u_a) - 1)` with `sum_a u_a = 0`, kinetic energy `(I+A)/2 sum_a u_a_dot^2`:
/// `omega^2 = 4 c1/(I+A)` at small amplitude, steeper by at most `e^(2u)` at the largest stretch `u`.
fn shear_frequency(c1: f64, largest: f64) -> f64 {
    (4.0 * c1 * (2.0 * largest).exp() / (1.0 + 0.2)).sqrt()
}

#[test]
fn vibrating_body() {
    let omega = dilatational_frequency(10.0, 0.0);
    assert_is_the_motion(&Vibrating, include_str!("../data/p2.csv"), 50.0, omega, |row| {
        Vibrating.at_momentum(matrix(&row.phi), Comoving(matrix(&row.spin))).unwrap()
    });
}

#[test]
fn mirrored_vibrating_body() {
    let omega = dilatational_frequency(10.0, 0.0);
    assert_is_the_motion(&Mirrored, include_str!("../data/p2r.csv"), 50.0, omega, |row| {
        Mirrored.at_momentum(matrix(&row.phi), Spatial(matrix(&row.spin))).unwrap()
    });
}

/// Under a stiff `kappa q^2/2` the Hessian in `phi` is `kappa/n^2 phi^-T (x) phi^-T` beside the constant metric
/// `1 (x) J`, so `omega^2 = kappa/n^2 tr(phi^-T J^-1 phi^-1)`. With `det phi` near 1 and stretches down to 1/2,
/// `|phi^-1| <= 1/least stretch` bounds it by `4 kappa/n^2 tr J^-1`.
fn flat_frequency(kappa: f64) -> f64 {
    (4.0 * kappa / 9.0 * (1.0 + 1.0 / 1.5 + 0.5)).sqrt()
}

fn assert_elastic(kappa: f64, data: &str, until: f64) {
    let model = Elastic { kappa }.prepare().unwrap();
    assert_is_the_motion(&model, data, until, flat_frequency(kappa), |row| {
        model.at_momentum(matrix(&row.phi), TwoPoint(matrix(&row.spin))).unwrap()
    });
}

#[test]
fn elastic_dalembert_body() {
    assert_elastic(10.0, include_str!("../data/p3.csv"), 50.0);
}

/// To t = 2: at t = 5 one last place of the start already moves the momentum, small there, by 3e-12 of its norm, and the
/// rounding of thousands of vibrations by more than the limit.
#[test]
fn stiff_dalembert_body() {
    assert_elastic(1e6, include_str!("../data/p6.csv"), 2.0);
}

/// The same to t = 5 in double-double arithmetic.
#[test]
fn stiff_dalembert_body_beyond_double_precision() {
    let model = Elastic { kappa: 1e6 }.prepare().unwrap();
    let (rows, _) = rows(include_str!("../data/p6.csv"));
    let start = model.at_momentum(matrix(&rows[0].phi), TwoPoint(matrix(&rows[0].spin))).unwrap();
    let expected = rows.iter().find(|row| row.t == 5.0).unwrap();
    let found = reference_solution(&model, &start, (0.0, expected.t)).unwrap();
    assert_close("phi(5)", &entries(found.phi()), &expected.phi, norm(&expected.phi), VIBRATION);
    assert_close("pi(5)", &entries(&found.pi().0.0), &expected.spin, norm(&expected.spin), VIBRATION);
}

fn assert_stiff(kappa: f64, c1: f64, omega: f64, data: &str, until: f64) {
    let model = Stiff { kappa, c1 }.prepare().unwrap();
    assert_is_the_motion(&model, data, until, omega, |row| {
        model.at_momentum(matrix(&row.phi), Comoving(matrix(&row.spin))).unwrap()
    });
}

#[test]
fn stiff_dilatation() {
    assert_stiff(1e4, 0.5, dilatational_frequency(1e4, 0.0), include_str!("../data/p5_1e4.csv"), 10.0);
}

#[test]
fn very_stiff_dilatation() {
    assert_stiff(1e6, 0.5, dilatational_frequency(1e6, 0.0), include_str!("../data/p5_1e6.csv"), 10.0);
}

/// The start has `q` = 0.3, ten times that of the others.
#[test]
fn stiff_dilatation_of_large_amplitude() {
    assert_stiff(1e4, 0.5, dilatational_frequency(1e4, 0.3), include_str!("../data/p5_large.csv"), 10.0);
}

/// The largest stretch of the start is `e^(1/4)`.
#[test]
fn stiff_shear() {
    assert_stiff(10.0, 1e4, shear_frequency(1e4, 0.25), include_str!("../data/p8.csv"), 2.0);
}

#[test]
fn stiff_drunk_missile() {
    let omega = dilatational_frequency(1e4, 0.0);
    assert_is_the_motion(&StiffMissile, include_str!("../data/p7.csv"), 10.0, omega, |row| {
        let (x, p) = (vector(&row.x), vector(&[0.3, -0.2, 0.5]));
        StiffMissile.at_momentum(x, matrix(&row.phi), p, Comoving(matrix(&row.spin))).unwrap()
    });
}
