//! Splitting to a tolerance: what a tolerance gives, what stiffness costs, what is kept, and when it is taken.

use affine_runtime::model::Conserved;
use affine_runtime::prelude::*;
use affine_runtime::simulate::Setting;

use crate::models::*;
use crate::motions::difference;

const ADAPTIVE: Method = Method::AdaptiveSplitting { order: None };

type Missiles = <PreparedVibratingMissile as Model<3>>::Point<f64>;

fn missile(kappa: f64) -> (PreparedVibratingMissile, Missiles) {
    let model = VibratingMissile { m: 1.0, kappa }.prepare().unwrap();
    let start = model.at_momentum(x3(), phi3(), p3(), Comoving(spin3())).unwrap();
    (model, start)
}

fn run<const N: usize, M: Model<N>>(
    model: &M,
    start: M::Point<f64>,
    (t_end, tolerance): (f64, f64),
    method: Method,
) -> Trajectory<N, M::Point<f64>> {
    let run = Simulation::new(model, start).until(t_end).tolerance(tolerance).output([]).method(method);
    run.max_steps(10_000_000).run().unwrap()
}

/// The error at t = 2 over the tolerance of each step; 4.7 is found.
const OVER_TOLERANCE: f64 = 6.0;

fn assert_met<const N: usize, M: Model<N>>(name: &str, model: &M, start: M::Point<f64>) {
    let exact = run(model, start, (2.0, 1e-15), Method::RungeKutta8);
    for order in [None, Some(6), Some(8)] {
        let errors = [1e-4, 1e-7, 1e-10].map(|tolerance| {
            let split = run(model, start, (2.0, tolerance), Method::AdaptiveSplitting { order });
            difference(split.end().1, exact.end().1) / tolerance
        });
        assert!(errors.iter().all(|error| *error < OVER_TOLERANCE), "{name}, {order:?}: {errors:?}");
    }
}

#[test]
fn tolerances_are_met() {
    let mut count = 0;
    macro_rules! visit {
        ($name:literal, $n:literal, $model:expr, $start:expr) => {
            assert_met::<$n, _>($name, $model, $start);
            count += 1;
        };
    }
    each_model!(visit);
    assert_eq!(count, 43);
}

#[test]
fn stiffness_costs_nothing_at_loose_tolerances() {
    for (kappa, saving) in [(1e6, 60), (1e7, 200), (1e8, 900)] {
        let (model, start) = missile(kappa);
        let split = run(&model, start, (10.0, 1e-2), Method::Automatic);
        let resolved = run(&model, start, (10.0, 1e-5), Method::RungeKutta8);
        let error = (split.end().1.phi() - resolved.end().1.phi()).norm() / resolved.end().1.phi().norm();
        let cost = split.statistics();
        assert_eq!(split.computation().method, ADAPTIVE, "{kappa:e}");
        assert!(error < 1e-2, "{kappa:e}: {error:e}");
        assert!(cost.steps + cost.rejected < 40, "{kappa:e}: {cost:?}");
        let explicit = run(&model, start, (10.0, 1e-2), Method::RungeKutta8).statistics();
        assert!(explicit.steps > saving * cost.steps, "{kappa:e}: {cost:?} for {explicit:?}");
    }
}

#[test]
fn forces_that_change_with_a_stiff_dilatation_leave_it_cheaper() {
    for kappa in [1e4, 1e6] {
        let model = Inflated { kappa }.prepare().unwrap();
        let phi = phi3().isochoric_part();
        let start = model.at_momentum(phi, Comoving(spin3())).unwrap();
        let split = run(&model, start, (10.0, 1e-5), ADAPTIVE);
        let explicit = run(&model, start, (10.0, 1e-5), Method::RungeKutta8);
        let resolved = run(&model, start, (10.0, 1e-10), Method::RungeKutta8);
        let error = difference(split.end().1, resolved.end().1);
        assert!(error < 1e-5, "{kappa:e}: {error:e}");
        // 75 of 227, and 513 of 1160.
        let [ours, theirs] = [split, explicit].map(|run| run.statistics().steps);
        assert!(2 * ours < theirs, "{kappa:e}: {ours} of {theirs}");
    }
}

/// Momenta that are conserved are kept to `c eps sqrt(steps)` times their size.
const MOMENTA: f64 = 0.1;

#[test]
fn what_is_kept() {
    let (model, start) = missile(1e4);
    let run = run(&model, start, (300.0, 1e-5), ADAPTIVE);
    let steps = run.statistics().steps as f64;
    let conservation = run.conservation();
    for drift in conservation.drifts() {
        let allowed = match drift.quantity {
            // A tenth of the tolerance is found over 2017 steps; a drift may be more.
            Conserved::Energy => 1e-5,
            _ => MOMENTA * f64::EPSILON * steps.sqrt(),
        };
        assert!(drift.relative() <= allowed, "{:?}: {:e}", drift.quantity, drift.relative());
    }
    let why = run.why().to_string();
    for words in [
        "splitting of order 4",
        "1e-5 per step: as asked for",
        "not symplectic",
        "kept up to rounding: momenta",
    ] {
        assert!(why.contains(words), "{words}: {why}");
    }
}

#[test]
fn forth_and_back() {
    let (model, start) = missile(1e4);
    let there = run(&model, start, (5.0, 1e-9), ADAPTIVE);
    let back = Simulation::new(&model, *there.end().1).from(5.0).until(0.0).tolerance(1e-9).method(ADAPTIVE);
    let back = back.run().unwrap();
    let error = difference(back.end().1, &start);
    assert!(error < 1e-8, "{error:e}");
}

#[test]
fn outputs_leave_the_steps_as_they_are() {
    let (model, start) = missile(1e5);
    let run = |times: &[f64]| {
        let run = Simulation::new(&model, start).until(3.0).tolerance(1e-6).method(ADAPTIVE);
        run.output(times.iter().copied()).run().unwrap()
    };
    let (many, one) = (run(&[0.1, 0.33, 1.0, 2.9, 3.0]), run(&[3.0]));
    assert_eq!(many.end(), one.end());
    assert_eq!(many.statistics().steps, one.statistics().steps);
    let resolved =
        Simulation::new(&model, start).until(3.0).tolerance(1e-12).output(many.times().iter().copied());
    let resolved = resolved.method(Method::RungeKutta8).run().unwrap();
    for (point, exact) in many.points().iter().zip(resolved.points()) {
        assert!(difference(point, exact) < 1e-6);
    }
}

#[affine_model(
    dim = 3,
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, body_translation = 1),
    potential = hyperbolic_dilatation(100000000) + neo_hookean(0.5),
)]
struct NotSplit;

#[test]
fn when_it_is_taken() {
    let taken = |kappa: f64, tolerance: f64| {
        let (model, start) = missile(kappa);
        // The method is chosen before the first step.
        let run = Simulation::new(&model, start).until(1.0).tolerance(tolerance).max_steps(100).run();
        run.map_or_else(|halt| halt.trajectory.computation().method, |run| run.computation().method)
    };
    for (kappa, tolerance) in [(1e8, 1e-2), (1e10, 1e-3), (1e12, 1e-5)] {
        assert_eq!(taken(kappa, tolerance), ADAPTIVE, "{kappa:e} {tolerance:e}");
    }
    for (kappa, tolerance) in [(10.0, 1e-3), (1e4, 1e-1), (1e6, 1e-6), (1e8, 1e-9)] {
        assert_eq!(taken(kappa, tolerance), Method::RungeKutta8, "{kappa:e} {tolerance:e}");
    }
    // Three pieces, in the plane.
    let moored = Moored { kappa: 1e8 }.prepare().unwrap();
    let (x, p) = (Vector::<2>::new(0.4, -0.1), Vector::<2>::new(0.3, -0.2));
    let start = moored.at_momentum(x, phi2(), p, Comoving(spin2())).unwrap();
    let split = run(&moored, start, (2.0, 1e-3), Method::Automatic);
    assert_eq!(split.computation().method, ADAPTIVE);
    let exact = run(&moored, start, (2.0, 1e-8), Method::RungeKutta8);
    let error = (split.end().1.phi() - exact.end().1.phi()).norm();
    assert!(error < 1e-3, "{error:e}");
    assert!(exact.statistics().steps > 1000 * split.statistics().steps);
    let (model, start) = missile(1e8);
    let stiff = || Simulation::new(&model, start).until(1.0).tolerance(1e-3).max_steps(1_000_000);
    let why = stiff().run().unwrap().why().to_string();
    assert!(why.contains("the dilatation is stiff") && why.contains("radians"), "{why}");
    // Events look at times within steps, where a stiff motion turns many times.
    let watched = stiff().event(Event::new("far", |_, point: &Missiles| point.x()[0] - 100.0)).run().unwrap();
    assert_eq!(watched.computation().method, Method::RungeKutta8);
    let point = NotSplit.at_momentum(x3(), phi3(), p3(), Comoving(spin3())).unwrap();
    let resolved = Simulation::new(&NotSplit, point).until(1.0).tolerance(1e-3).max_steps(1_000_000);
    assert_eq!(resolved.run().unwrap().computation().method, Method::RungeKutta8);
}

#[test]
fn an_interrupted_run_goes_on_with_the_same_bits() {
    let (model, start) = missile(1e8);
    let run = || Simulation::new(&model, start).until(3.0).tolerance(1e-4).every(0.25);
    let whole = run().run().unwrap();
    assert_eq!(whole.computation().method, ADAPTIVE);
    let halt = run().max_steps(whole.statistics().steps / 2).run().unwrap_err();
    let checkpoint = halt.trajectory.checkpoint().unwrap();
    let rest = run().resume(checkpoint).run().unwrap();
    assert_eq!(rest.end(), whole.end());
    assert_eq!(rest.statistics(), whole.statistics());
}

#[test]
fn what_is_refused() {
    let (model, start) = missile(10.0);
    for order in [0, 3, 10] {
        let method = Method::AdaptiveSplitting { order: Some(order) };
        let halt = Simulation::new(&model, start).until(1.0).method(method).run().unwrap_err();
        assert_eq!(halt.stop.reason, Setting::Order { given: order }.into());
    }
    let point = NotSplit.at_momentum(x3(), phi3(), p3(), Comoving(spin3())).unwrap();
    let halt = Simulation::new(&NotSplit, point).until(1.0).method(ADAPTIVE).run().unwrap_err().to_string();
    assert!(halt.contains("write `emit(splitting)`"), "{halt}");
}

/// A centre of mass whose momentum stretches and turns the body, with all of it large: what cancels in the flows leaves ten
/// and more roundings of the placement in each, however short they are.
#[test]
fn rounding_does_not_drive_steps_down() {
    let model = VibratingMissile { m: 2.0, kappa: 10.0 }.prepare().unwrap();
    let turning = (spin3() - spin3().transpose()) * 5e5;
    let start = model.at_momentum(Vector::<3>::zeros(), phi3(), p3() * 1e6, Comoving(turning)).unwrap();
    let simulation = |tolerance: f64| {
        let run = Simulation::new(&model, start).until(1e-4).tolerance(tolerance).output([]);
        run.max_steps(100_000)
    };
    let exact = simulation(1e-15).method(Method::RungeKutta8).run().unwrap();
    let [loose, tight] =
        [1e-13, 1e-15].map(|tolerance| simulation(tolerance).method(ADAPTIVE).run().unwrap());
    let tried = |run: &Trajectory<3, Missiles>| run.statistics().steps + run.statistics().rejected;
    assert!(tried(&tight) < 3 * tried(&loose), "{:?} for {:?}", tight.statistics(), loose.statistics());
    let error = |run: &Trajectory<3, Missiles>| difference(run.end().1, exact.end().1);
    assert!(error(&tight) < 1e-11, "{:e}, {:e} at 1e-13", error(&tight), error(&loose));
}
