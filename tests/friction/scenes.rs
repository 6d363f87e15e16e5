//! Stiff scenes that no list names: friction in both frames, under constraints, of the centre of mass, in steps of a loop, and
//! with events.

use affine_runtime::prelude::*;
use affine_runtime::state::Phase;

use crate::models::{Crowd, Everywhere, Isochoric, Moving, Shrinking, Spatial, Viscous};

const PHI: [f64; 9] = [1.1, 0.2, -0.1, 0.05, 0.9, 0.15, -0.2, 0.1, 1.05];
const SPIN: [f64; 9] = [0.1, 0.4, -0.3, -0.2, -0.15, 0.25, 0.35, -0.1, 0.05];

fn phi() -> Matrix<3> {
    Matrix::<3>::from_row_slice(&PHI)
}

fn spin() -> Matrix<3> {
    Matrix::<3>::from_row_slice(&SPIN)
}

/// The ends of two runs agree, and the first is of few steps.
macro_rules! agree {
    ($model:expr, $start:expr, $t_end:expr, $bound:expr) => {{
        let (model, start) = ($model, $start);
        let run = |tolerance: f64, method: Method| {
            Simulation::new(&model, start).until($t_end).tolerance(tolerance).method(method).run().unwrap()
        };
        let (stiff, tight) = (run(1e-8, Method::Automatic), run(1e-11, Method::RungeKutta8));
        assert!(matches!(stiff.computation().method, Method::Radau { .. }), "{}", stiff.why());
        let error = (stiff.end().1.phi() - tight.end().1.phi()).norm();
        let spins = [&stiff, &tight].map(|run| run.end().1.sigma_hat().0.0);
        let of_spin = (spins[0] - spins[1]).norm();
        assert!(
            error < $bound && of_spin < $bound,
            "phi by {error:e}, Sigma_hat by {of_spin:e}: {}",
            stiff.why()
        );
        let (few, many) = (stiff.statistics().steps, tight.statistics().steps);
        assert!(3 * few < many, "{few} steps for {many}");
        let balance = stiff.power_balance().unwrap();
        assert!(balance.relative() < 1e-7, "{balance}");
    }};
}

#[test]
fn friction_in_the_frame_of_space() {
    let model = Spatial { r: 1e5 }.prepare().unwrap();
    let start = model.at_momentum(phi(), Comoving(spin())).unwrap();
    agree!(model, start, 0.1, 1e-7);
}

#[test]
fn friction_in_both_frames() {
    let model = Everywhere { r: 1e5 }.prepare().unwrap();
    let start = model.at_momentum(phi(), Comoving(spin())).unwrap();
    agree!(model, start, 0.1, 1e-7);
}

#[test]
fn friction_of_the_centre_of_mass() {
    let model = Moving { r: 1e5 }.prepare().unwrap();
    let (x, p) = (Vector::<3>::new(0.0, 0.0, 1.0), Vector::<3>::new(0.3, -0.2, 0.5));
    let start = model.at_momentum(x, phi(), p, Comoving(spin())).unwrap();
    agree!(model, start, 0.1, 1e-7);
}

/// On SL(n) too: the placement stays there up to rounding.
#[test]
fn friction_under_a_constraint() {
    let model = Isochoric { r: 1e5 }.prepare().unwrap();
    let phi = phi() / phi().determinant().cbrt();
    let velocity = spin() - Matrix::<3>::identity() * (spin().trace() / 3.0);
    let start = model.at_velocity(phi, phi * velocity).unwrap();
    let run = |method: Method, tolerance: f64| {
        Simulation::new(&model, start).until(0.1).tolerance(tolerance).method(method).run().unwrap()
    };
    let (stiff, tight) = (run(Method::Radau { stages: None }, 1e-8), run(Method::RungeKutta8, 1e-11));
    assert!((stiff.end().1.phi().determinant() - 1.0).abs() < 1e-13, "det phi = 1");
    let error = (stiff.end().1.phi() - tight.end().1.phi()).norm();
    assert!(error < 1e-7, "{error:e}");
    assert!(3 * stiff.statistics().steps < tight.statistics().steps, "{} steps", stiff.statistics().steps);
}

/// Whatever the friction: no false ending, and no more steps than a few dozen.
#[test]
fn sixteen_decades() {
    for exponent in 0..=16 {
        let model = Viscous { r: 10.0_f64.powi(exponent) }.prepare().unwrap();
        let start = model.at_momentum(phi(), Comoving(spin())).unwrap();
        let run = Simulation::new(&model, start).until(1e3).tolerance(1e-6).run().unwrap();
        assert_eq!(run.end().0, 1e3);
        assert!(
            exponent < 1 || run.statistics().steps < 100,
            "1e{exponent}: {} steps",
            run.statistics().steps
        );
        let balance = run.power_balance().unwrap();
        assert!(balance.relative() < 1e-4, "1e{exponent}: {balance}");
    }
}

/// A run that is cut and gone on with has the bits of one that is not.
#[test]
fn checkpoints_hold_all_that_steps_depend_on() {
    let model = Viscous { r: 1e6 }.prepare().unwrap();
    let start = model.at_momentum(phi(), Comoving(spin())).unwrap();
    let simulation = || Simulation::new(&model, start).until(1.0).tolerance(1e-8);
    let whole = simulation().run().unwrap();
    let halt = simulation().max_steps(9).run().unwrap_err();
    let checkpoint = halt.trajectory.checkpoint().unwrap();
    let rest = simulation().resume(checkpoint).run().unwrap();
    assert_eq!(whole.end(), rest.end());
    assert_eq!(whole.statistics().steps, rest.statistics().steps);
}

/// A field that changes between steps of a loop: friction that grows.
#[test]
fn friction_grows_in_a_loop() {
    let start = Viscous { r: 1e3 }.prepare().unwrap().at_momentum(phi(), Comoving(spin())).unwrap();
    let viscous = |r: f64| affine_runtime::model::Owned(Viscous { r }.prepare().unwrap());
    let mut flow = Flow::by(Method::Radau { stages: None }, viscous(1e3), (0.0, start)).unwrap();
    let mut tight = Flow::by(Method::RungeKutta8, viscous(1e3), (0.0, start)).unwrap();
    for frame in 1..=6 {
        let r = 1e3 * 2.0_f64.powi(frame);
        for flow in [&mut flow, &mut tight] {
            flow.set_model(viscous(r));
            flow.advance(0.01).unwrap();
        }
    }
    let error = (flow.point().phi() - tight.point().phi()).norm();
    assert!(error < 1e-8, "{error:e}");
}

/// An event within a step: where the creeping body has come by a given amount.
#[test]
fn events_are_found_between_steps() {
    let model = Viscous { r: 1e6 }.prepare().unwrap();
    let start = model.at_momentum(phi(), Comoving(spin())).unwrap();
    let long = || Simulation::new(&model, start).until(1e5);
    let reached = long().run().unwrap().end().1.phi()[(0, 0)];
    let level = 0.5 * (PHI[0] + reached);
    let passes = || Event::new("passes", move |_: f64, point: &_| Phase::<3>::phi(point)[(0, 0)] - level);
    let [coarse, fine] = [1e-6, 1e-11]
        .map(|tolerance| long().tolerance(tolerance).event(passes()).run().unwrap().events()[0].t);
    assert!((coarse - fine).abs() < 1e-4 * fine, "{coarse} for {fine}");
}

/// Bodies of an ensemble leave the lanes where their friction is stiff, and are where they are alone.
#[test]
fn ensembles_are_not_stopped() {
    for (r, t_end) in [(1e6, 10.0), (1.0, 0.5)] {
        let model = Crowd { r }.prepare().unwrap();
        let starts: Vec<_> = (0..20)
            .map(|k| model.at_momentum(phi(), Comoving(spin() * (1.0 + 0.1 * f64::from(k)))).unwrap())
            .collect();
        let ends = Ensemble::new(&model, starts.clone()).until(t_end).tolerance(1e-8).run().unwrap();
        for (start, end) in starts.into_iter().zip(ends) {
            let alone = Simulation::new(&model, start).until(t_end).tolerance(1e-8).run().unwrap();
            let (end, is_stiff) = (end.unwrap(), alone.computation().friction.is_some());
            assert_eq!(is_stiff, r > 1e3);
            assert!(!is_stiff || end == *alone.end().1, "to the bit");
            assert!((end.phi() - alone.end().1.phi()).norm() < 1e-8, "in lanes");
        }
    }
}

/// Down to the rounding of doubles steps are found, and none is worse than the coarser ones.
#[test]
fn the_finest_tolerances() {
    let model = Viscous { r: 1e4 }.prepare().unwrap();
    let start = model.at_momentum(phi(), Comoving(spin())).unwrap();
    let run = |tolerance: f64| Simulation::new(&model, start).until(1.0).tolerance(tolerance).run().unwrap();
    let fine = run(1e-12);
    for tolerance in [1e-13, 1e-14, 1e-15] {
        let finer = run(tolerance);
        let apart = (finer.end().1.phi() - fine.end().1.phi()).norm();
        assert!(apart < 2e-12, "{tolerance:e}: {apart:e}");
        assert!(finer.statistics().steps < 1000, "{tolerance:e}: {} steps", finer.statistics().steps);
    }
}

/// Backward in time what friction takes away grows: that is followed, or the run says why not.
#[test]
fn backward_in_time() {
    let model = Viscous { r: 1e5 }.prepare().unwrap();
    let start = model.at_momentum(phi(), Comoving(spin())).unwrap();
    let back = Simulation::new(&model, start).until(-1.0).tolerance(1e-8).max_steps(2000).run();
    assert!(back.is_err(), "velocities grow by e^125000: steps follow that, and are many");
    let near = Simulation::new(&model, start).until(-1e-5).tolerance(1e-10).run().unwrap();
    assert_eq!(near.computation().method, Method::RungeKutta8);
    let again = Simulation::new(&model, *near.end().1).until(1e-5).tolerance(1e-10).run().unwrap();
    assert!((again.end().1.phi() - phi()).norm() < 1e-8);
}

/// At the start friction takes velocities away some fifty times in the run, and 25000 times where the body has shrunk: the implicit steps take over on the way, with
/// outputs, work, interruptions and events as if nothing had happened.
#[test]
fn friction_that_grows_stiff_on_the_way() {
    let model = Shrinking { r: 1.0 }.prepare().unwrap();
    let phi = Matrix::<2>::new(1.1, 0.2, -0.1, 0.95);
    let start = model.at_velocity(phi, Matrix::<2>::new(0.1, 0.4, -0.3, 0.2)).unwrap();
    let to = |method: Method, tolerance: f64| {
        Simulation::new(&model, start).until(50.0).method(method).tolerance(tolerance)
    };
    let run = to(Method::Automatic, 1e-9).run().unwrap();
    let tight = to(Method::RungeKutta8, 1e-12).run().unwrap();
    assert!(matches!(run.computation().method, Method::Radau { .. }), "{}", run.why());
    let since = run.computation().stiff_since.unwrap();
    assert!(run.why().to_string().contains(&format!("from t = {since} on")), "{}", run.why());
    assert!(run.statistics().steps < 1024 && tight.statistics().steps > 2500, "{}", run.why());
    let (point, exact) = (run.end().1, tight.end().1);
    let error = (point.phi() - exact.phi()).norm() / exact.phi().norm();
    assert!(error < 1e-7, "{error:e}");
    let balance = run.power_balance().unwrap();
    assert!(balance.relative() < 1e-8, "{balance}");
    // Each time once, and the change of method between two of them.
    let times: Vec<f64> = run.iter().map(|(t, _)| t).collect();
    assert!(times.windows(2).all(|pair| pair[0] < pair[1]) && times.contains(&since));
    let at = |run: Simulation<'_, 2, _>| run.output([0.2 * since, since, 50.0]).run().unwrap();
    let seldom = at(to(Method::Automatic, 1e-9));
    assert_eq!(seldom.iter().count(), 3);
    assert_eq!(seldom.end().1, point);
    // Interrupted before and after, and gone on with.
    for max_steps in [500, 520] {
        let halt = to(Method::Automatic, 1e-9).max_steps(max_steps).run().unwrap_err();
        let checkpoint = halt.trajectory.checkpoint().unwrap();
        let rest = to(Method::Automatic, 1e-9).resume(checkpoint).run().unwrap();
        assert_eq!((rest.end().1, rest.statistics().steps), (point, run.statistics().steps));
        assert_eq!(rest.computation().stiff_since, Some(since), "{}", rest.why());
    }
    // Soft until the end, nothing changes.
    let soft = Simulation::new(&model, start).until(0.1).tolerance(1e-12).run().unwrap();
    assert_eq!(soft.computation().method, Method::RungeKutta8);
    assert_eq!(soft.end().1, to(Method::RungeKutta8, 1e-12).until(0.1).run().unwrap().end().1);
}
