//! Errors against references, and what they cost. Errors are relative, in the Frobenius norm of each object.

use affine_integrators::Statistics;
use affine_runtime::frames::Matrix;
use affine_runtime::kinematics::Kinematics;
use affine_runtime::simulate::Method;
use affine_runtime::state::Phase;
use affine_runtime::{Simulation, Trajectory};

use crate::models::drunk_missile::{self, DrunkMissile, Missile};
use crate::models::planar::{self, Planar};
use crate::models::vibrating_body::{self, Body3, VibratingBody};
use crate::models::{phi0, spin0};
use crate::reference;

fn relative(found: &[f64], expected: &[f64]) -> f64 {
    let norm = |v: &mut dyn Iterator<Item = f64>| v.map(|x| x * x).sum::<f64>().sqrt();
    norm(&mut found.iter().zip(expected).map(|(a, b)| a - b)) / norm(&mut expected.iter().copied())
}

fn rows(m: &Matrix<3>) -> Vec<f64> {
    m.transpose().iter().copied().collect()
}

/// Largest relative error of `x`, `phi`, `p_hat` and `Sigma_hat`.
fn missile_error(point: &Missile, state: &[f64; 24]) -> f64 {
    [
        relative(point.x().as_slice(), &state[..3]),
        relative(&rows(point.phi()), &state[3..12]),
        relative(point.p_hat().0.0.as_slice(), &state[12..15]),
        relative(&rows(&point.sigma_hat().0.0), &state[15..]),
    ]
    .into_iter()
    .fold(0.0, f64::max)
}

fn body_error(point: &Body3, state: &[f64; 18]) -> f64 {
    relative(&rows(point.phi()), &state[..9]).max(relative(&rows(&point.sigma_hat().0.0), &state[9..]))
}

fn missile(t: f64, tolerance: f64) -> Trajectory<3, Missile> {
    Simulation::new(&DrunkMissile, drunk_missile::start()).until(t).tolerance(tolerance).run().unwrap()
}

fn body(t: f64, tolerance: f64) -> Trajectory<3, Body3> {
    let model = VibratingBody::BENCHMARK;
    Simulation::new(&model, vibrating_body::start()).until(t).tolerance(tolerance).run().unwrap()
}

/// Steps and evaluations of a run without rejections.
fn accepted((steps, evaluations): (u64, u64)) -> Statistics {
    Statistics { steps, evaluations, ..Statistics::default() }
}

#[test]
fn drunk_missile_follows_the_reference() {
    // 12 evaluations per step, 2 at the start, 12 for the components of `p_hat` and `Sigma_hat`.
    let costs = [(15, 194), (137, 1658)];
    for ((t, state), cost) in reference::DRUNK_MISSILE.iter().zip(costs) {
        let run = missile(*t, 1e-13);
        let error = missile_error(run.end().1, state);
        assert!(error < 1e-12, "t = {t}: {error:e}");
        assert_eq!(run.statistics(), accepted(cost));
    }
}

#[test]
fn vibrating_body_follows_the_reference() {
    let costs = [(190, 2292), (945, 11352)];
    // Phase errors of the vibration add up over the 50 units of time.
    for (((t, state), bound), cost) in reference::VIBRATING_BODY.iter().zip([1e-12, 5e-12]).zip(costs) {
        let run = body(*t, 1e-13);
        let error = body_error(run.end().1, state);
        assert!(error < bound, "t = {t}: {error:e}");
        assert_eq!(run.statistics(), accepted(cost));
    }
}

#[test]
fn error_is_proportional_to_the_tolerance() {
    let (t, state) = reference::DRUNK_MISSILE[1];
    for tolerance in [1e-3, 1e-6, 1e-9, 1e-12, 1e-14] {
        let ratio = missile_error(missile(t, tolerance).end().1, &state) / tolerance;
        assert!((0.1..10.0).contains(&ratio), "{tolerance:e}: error/tolerance = {ratio}");
    }
    // The finest one: what rounding leaves.
    assert!(missile_error(missile(t, 1e-15).end().1, &state) < 1e-14);
}

/// What the description of [`Method::RungeKutta5`] says; tolerance, and errors of orders 8 and 5 over it.
#[test]
fn order_5_leaves_more_of_a_tolerance_than_order_8() {
    let (t, state) = reference::VIBRATING_BODY[1];
    assert_eq!(t, 50.0);
    for tolerance in [1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11] {
        let [eighth, fifth] = [Method::RungeKutta8, Method::RungeKutta5].map(|method| {
            let model = VibratingBody::BENCHMARK;
            let run = Simulation::new(&model, vibrating_body::start()).until(t).tolerance(tolerance);
            let run = run.method(method).output([]).run().unwrap();
            body_error(run.end().1, &state) / tolerance
        });
        println!("{tolerance:e}: {eighth:.1} {fifth:.1}");
        assert!((2.0..8.0).contains(&eighth), "{tolerance:e}: {eighth}");
        assert!((20.0..250.0).contains(&fifth), "{tolerance:e}: {fifth}");
    }
}

#[test]
fn geodesic_is_a_product_of_exponentials() {
    // phi = phi0 exp(tX) exp(tW), X = Sh/alpha + tr(Sh)/beta, W = -Vort/mu, with I = 1, A = 0.2, B = 0.1:
    // 1/alpha = 1/1.2, 1/beta = -0.1/(1.2*1.5), 1/mu = 1/0.96.
    let model = VibratingBody { kappa: 0.0, c1: 0.0, ..VibratingBody::BENCHMARK };
    let run = Simulation::new(&model, vibrating_body::start()).until(2.0).tolerance(1e-14).run().unwrap();
    let spin = spin0();
    let stretch = spin / 1.2 + Matrix::<3>::identity() * (spin.trace() * -0.1 / 1.8);
    let whirl = (spin.transpose() - spin) / 0.96;
    let exact = phi0() * (stretch * 2.0).exp() * (whirl * 2.0).exp();
    let error = relative(run.end().1.phi().as_slice(), exact.as_slice());
    assert!(error < 1e-13, "{error:e}");
    let turn = (whirl * 2.0).exp();
    let exact_spin = turn.transpose() * spin * turn;
    assert!(relative(run.end().1.sigma_hat().0.0.as_slice(), exact_spin.as_slice()) < 1e-13);
}

#[test]
fn backward_returns_to_the_start() {
    let forth = missile(10.0, 1e-13);
    let back = Simulation::new(&DrunkMissile, *forth.end().1)
        .from(10.0)
        .until(0.0)
        .tolerance(1e-13)
        .every(2.5)
        .run()
        .unwrap();
    assert_eq!(back.times(), [10.0, 7.5, 5.0, 2.5, 0.0]);
    let start = drunk_missile::start();
    assert!(relative(back.end().1.phi().as_slice(), start.phi().as_slice()) < 1e-12);
    assert!((back.end().1.x() - start.x()).norm() < 1e-12);
}

#[test]
fn a_turned_space_changes_no_step() {
    let (s, c) = 0.83f64.sin_cos();
    let turn = Matrix::<3>::new(c, -s, 0.0, 0.6 * s, 0.6 * c, -0.8, 0.8 * s, 0.8 * c, 0.6);
    let turned = drunk_missile::turned_start(&turn);
    for tolerance in [1e-6, 1e-10] {
        let here = missile(10.0, tolerance);
        let there = Simulation::new(&DrunkMissile, turned).until(10.0).tolerance(tolerance).run().unwrap();
        assert_eq!(here.statistics(), there.statistics());
        assert!(relative(there.end().1.phi().as_slice(), (turn * here.end().1.phi()).as_slice()) < 1e-13);
        assert!(relative(there.end().1.x().as_slice(), (turn * here.end().1.x()).as_slice()) < 1e-13);
        assert!((there.end().1.dilatation() - here.end().1.dilatation()).abs() < 1e-13);
    }
}

#[test]
fn spring_swings_as_cos_and_sin() {
    // phi = phi0 cos t + Pi0^T sin t, Pi = Pi0 cos t - phi0^T sin t.
    let start = planar::start(0.3);
    let run = Simulation::new(&Planar::SPRING, start).until(0.7).tolerance(1e-14).run().unwrap();
    let (sin, cos) = 0.7f64.sin_cos();
    let phi = start.phi() * cos + start.pi().0.0.transpose() * sin;
    let pi = start.pi().0.0 * cos - start.phi().transpose() * sin;
    assert!(relative(run.end().1.phi().as_slice(), phi.as_slice()) < 1e-14);
    assert!(relative(run.end().1.pi().0.0.as_slice(), pi.as_slice()) < 1e-14);
}

#[test]
fn closed_form_and_integration_agree() {
    let start = planar::start(0.5);
    let run = |method| {
        let simulation = Simulation::new(&Planar::FREE, start).until(3.0).every(0.3).method(method);
        simulation.tolerance(1e-13).run().unwrap()
    };
    let (exact, stepped) = (run(Method::ClosedForm), run(Method::RungeKutta8));
    assert_eq!(exact.times(), stepped.times());
    for ((t, a), (_, b)) in exact.iter().zip(stepped.iter()) {
        assert_eq!(*a.phi(), start.phi() + start.pi().0.0.transpose() * t);
        assert!(relative(b.phi().as_slice(), a.phi().as_slice()) < 1e-14);
    }
    assert_eq!(exact.statistics(), Statistics::default());
    assert!(stepped.statistics().steps > 0);
}
