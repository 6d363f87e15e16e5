//! The free triaxial top as a rigid affine body, against Jacobi's elliptic functions.

use affine_integrators::gauss::Tableau;
use affine_integrators::lie::Chart;
use affine_integrators::{Gauss, RungeKutta8};
use affine_runtime::frames::Matrix;
use affine_runtime::model::{Constraint, Group, Quantity};

use crate::curve::{defect, write};
use crate::jacobi::sn_cn_dn;

/// `T = tr(Oh J Oh^T)/2` on skew `Oh`: the moment of inertia about an axis is the sum of the other two entries of `J`.
const J: [f64; 3] = [1.3, 0.9, 0.5];
const INERTIA: [f64; 3] = [J[1] + J[2], J[0] + J[2], J[0] + J[1]];

const STATE: &[Group] = &[Group::new(Quantity::Placement, 9), Group::new(Quantity::ComovingAffineSpin, 3)];

/// The skew matrix of a vector: `hat(w) a = w x a`.
fn hat(w: [f64; 3]) -> Matrix<3> {
    Matrix::<3>::new(0.0, -w[2], w[1], w[2], 0.0, -w[0], -w[1], w[0], 0.0)
}

/// `phi' = phi hat(w)`, `L' = L x w`, `w = L/I`, both in the body.
fn equations(_: f64, y: &[f64; 12]) -> [f64; 12] {
    let l = [y[9], y[10], y[11]];
    let w = [l[0] / INERTIA[0], l[1] / INERTIA[1], l[2] / INERTIA[2]];
    let mut rates = [0.0; 12];
    write(&mut rates, &(Matrix::<3>::from_row_slice(&y[..9]) * hat(w)));
    rates[9] = l[1] * w[2] - l[2] * w[1];
    rates[10] = l[2] * w[0] - l[0] * w[2];
    rates[11] = l[0] * w[1] - l[1] * w[0];
    rates
}

/// Angular velocities in the body at the time `t`: with `I_1 < I_2 < I_3` and `L^2 > 2 E I_2` (Landau, Lifshitz,
/// Mechanics, section 37), `w_1 = a_1 cn`, `w_2 = a_2 sn`, `w_3 = a_3 dn` of `rate t`.
fn angular_velocity(energy: f64, square: f64, t: f64) -> [f64; 3] {
    let [i1, i2, i3] = INERTIA;
    assert!(i1 < i2 && i2 < i3 && square > 2.0 * energy * i2);
    let rate = ((i3 - i2) * (square - 2.0 * energy * i1) / (i1 * i2 * i3)).sqrt();
    let m = (i2 - i1) * (2.0 * energy * i3 - square) / ((i3 - i2) * (square - 2.0 * energy * i1));
    let (sn, cn, dn) = sn_cn_dn(rate * t, m);
    [
        ((2.0 * energy * i3 - square) / (i1 * (i3 - i1))).sqrt() * cn,
        ((2.0 * energy * i3 - square) / (i2 * (i3 - i2))).sqrt() * sn,
        ((square - 2.0 * energy * i1) / (i3 * (i3 - i1))).sqrt() * dn,
    ]
}

const ENERGY: f64 = 0.9;
/// `L^2`, between `2 E I_2 = 3.24` and `2 E I_3 = 3.96`.
const SQUARE: f64 = 3.5;

/// At `t = 0`, with `phi = 1`.
fn start() -> [f64; 12] {
    let mut y = [0.0; 12];
    write(&mut y, &Matrix::<3>::identity());
    let w = angular_velocity(ENERGY, SQUARE, 0.0);
    for k in 0..3 {
        y[9 + k] = INERTIA[k] * w[k];
    }
    y
}

/// What the exact solution says of the state: angular velocities in the body, and `phi L` at rest in space. The one angle
/// that is left, about `L`, advances by an elliptic integral of the third kind, whose integrand is
/// `|L| (2 E - w_1^2 I_1)/(L^2 - (I_1 w_1)^2)` for the node of the body's first axis: its quadrature is spectral, the
/// integrand being periodic and analytic.
fn errors(t: f64, y: &[f64; 12]) -> [f64; 3] {
    let expected = angular_velocity(ENERGY, SQUARE, t);
    let l = [y[9], y[10], y[11]];
    let body = (0..3).map(|k| (l[k] / INERTIA[k] - expected[k]).abs()).fold(0.0, f64::max);
    let phi = Matrix::<3>::from_row_slice(&y[..9]);
    let begin = start();
    let vector = |l: &[f64]| affine_runtime::frames::Vector::<3>::new(l[0], l[1], l[2]);
    let space = (phi * vector(&l) - vector(&begin[9..])).norm();

    // The angle of the first axis about L, from the node of e_1 at the start.
    let axis = vector(&begin[9..]) / SQUARE.sqrt();
    let across = |e: affine_runtime::frames::Vector<3>| e - axis * axis.dot(&e);
    let (from, to) =
        (across(affine_runtime::frames::Vector::<3>::new(1.0, 0.0, 0.0)), across(phi.column(0).into_owned()));
    let found = axis.dot(&from.cross(&to)).atan2(from.dot(&to));
    let angle = precession(t);
    let turns = ((found - angle) / core::f64::consts::TAU).round();
    [body, space, (found - angle - turns * core::f64::consts::TAU).abs()]
}

/// Gauss-Legendre of five points over many panels.
fn precession(t: f64) -> f64 {
    const NODES: [(f64, f64); 5] = [
        (-0.906_179_845_938_664, 0.236_926_885_056_189_08),
        (-0.538_469_310_105_683, 0.478_628_670_499_366_5),
        (0.0, 0.568_888_888_888_888_9),
        (0.538_469_310_105_683, 0.478_628_670_499_366_5),
        (0.906_179_845_938_664, 0.236_926_885_056_189_08),
    ];
    let rate = |t: f64| {
        let first = INERTIA[0] * angular_velocity(ENERGY, SQUARE, t)[0];
        SQUARE.sqrt() * (2.0 * ENERGY - first * first / INERTIA[0]) / (SQUARE - first * first)
    };
    let panels = (20.0 * t).ceil();
    let h = t / panels;
    (0..panels as usize)
        .map(|k| NODES.iter().map(|(x, w)| w * rate(h * (k as f64 + 0.5 + 0.5 * x))).sum::<f64>() * 0.5 * h)
        .sum()
}

#[test]
fn order_8_follows_the_elliptic_functions() {
    let t_end = 50.0;
    let chart = Chart::<3>::new(Constraint::Rigid, 0);
    let mut run = RungeKutta8::within(chart, equations, STATE, (0.0, start()), t_end, 1e-14).unwrap();
    let mut worst = [0.0f64; 3];
    while !run.is_finished() {
        run.advance().unwrap();
        for (worst, error) in worst.iter_mut().zip(errors(run.t(), run.y())) {
            *worst = worst.max(error);
        }
        assert!(defect(Constraint::Rigid, &Matrix::<3>::from_row_slice(&run.y()[..9])) < 1e-14);
    }
    println!(
        "free top to t = {t_end}: body {:e}, L in space {:e}, precession {:e}",
        worst[0], worst[1], worst[2]
    );
    // Roundings of some hundred steps, grown linearly by the error of the frequency.
    assert!(worst.iter().all(|error| *error < 3e-12), "{worst:?}");
}

#[test]
fn gauss_keeps_the_invariants_of_the_top() {
    let chart = Chart::<3>::new(Constraint::Rigid, 0);
    for (tableau, accuracy) in [(&Tableau::TWO, 1e-3), (&Tableau::THREE, 1e-5)] {
        let mut run = Gauss::within(chart, equations, tableau, (0.0, start()), 100.0, 0.1).unwrap();
        while !run.is_finished() {
            run.advance().unwrap();
            let l = [run.y()[9], run.y()[10], run.y()[11]];
            let energy: f64 = (0..3).map(|k| 0.5 * l[k] * l[k] / INERTIA[k]).sum();
            let square: f64 = l.iter().map(|l| l * l).sum();
            // Quadratic in L, whose equations do not contain phi.
            assert!((energy - ENERGY).abs() < 1e-13 && (square - SQUARE).abs() < 1e-13);
        }
        let errors = errors(run.t(), run.y());
        assert!(errors.iter().all(|error| *error < accuracy), "{errors:?}");
    }
}
