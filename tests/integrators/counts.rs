//! Evaluations as they are counted, and as a potential counts them that is asked for its derivatives.

use std::sync::atomic::{AtomicU64, Ordering};

use affine_runtime::potential::{Class, Place, Potential, Slopes};
use affine_runtime::prelude::*;
use affine_runtime::scalar::Scalar;

static ASKED: AtomicU64 = AtomicU64::new(0);

/// `(tr G - 3)/2`, and how often its derivatives were asked for.
#[derive(Clone, Debug)]
struct Asked;

impl Potential<3> for Asked {
    const CLASS: Class = Class::Isotropic;
    // All that a potential is told. Of the time it knows nothing, for `H` is conserved under it.
    fn energy<T: Scalar>(&self, Place { x: _, phi }: &Place<3, T>) -> T {
        let square = phi.iter().fold(T::zero(), |sum, entry| sum + *entry * *entry);
        (square - T::constant(3.0, 0.0)) * T::constant(0.5, 0.0)
    }
    fn slopes<T: Scalar>(&self, place: &Place<3, T>) -> Slopes<3, T> {
        ASKED.fetch_add(1, Ordering::Relaxed);
        Slopes { x: Vector::<3, T>::from_fn(|_, _| T::zero()), phi: place.phi }
    }
}

#[affine_model(
    dim = 3,
    kinetic(casimir2 = a, casimir1_squared = 0.1, body_inertia = 1),
    potential = q^2 + custom(asked, isotropic)
)]
struct Free {
    a: f64,
    asked: Asked,
}

#[affine_model(
    dim = 3,
    constraint = isochoric,
    kinetic(dalembert = i),
    potential = custom(asked, isotropic)
)]
struct Isochoric {
    i: f64,
    asked: Asked,
}

#[affine_model(
    dim = 3,
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1),
    potential = hyperbolic_dilatation(10) + neo_hookean(0.5),
    emit(taylor)
)]
struct Vibrating;

/// The momentum of the centre leaves the dilatation in the state.
#[affine_model(
    dim = 3,
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, body_translation = 1),
    potential = hyperbolic_dilatation(kappa) + neo_hookean(0.5),
    emit(splitting)
)]
struct Missile {
    kappa: f64,
}

fn strained() -> (Matrix<3>, Matrix<3>) {
    let phi = Matrix::<3>::new(1.1, 0.2, 0.0, -0.1, 0.95, 0.1, 0.05, 0.0, 1.02);
    (phi, Matrix::<3>::new(0.1, 0.4, 0.0, -0.3, 0.2, 0.1, 0.0, 0.2, -0.1))
}

/// Evaluations of a run as it counts them, and as the potential does.
fn counts<const N: usize, P: Phase<N>>(run: impl FnOnce() -> Trajectory<N, P>) -> (u64, u64) {
    let before = ASKED.load(Ordering::Relaxed);
    let run = run();
    (run.statistics().evaluations, ASKED.load(Ordering::Relaxed) - before)
}

/// One test, since the potential counts for all threads.
#[test]
fn what_is_counted_is_what_was_asked() {
    let (phi, phi_dot) = strained();
    let model = Free { a: 0.2, asked: Asked }.prepare().unwrap();
    let start = model.at_velocity(phi, phi_dot).unwrap();
    for method in [
        Method::Automatic,
        Method::RungeKutta5,
        Method::Gauss { stages: 3, step: 0.05 },
        Method::Gauss { stages: 2, step: 2.0 },
        Method::Radau { stages: None },
    ] {
        let run = || Simulation::new(&model, start).until(4.0).method(method).every(0.3).run().unwrap();
        let (counted, asked) = counts(run);
        assert_eq!(counted, asked, "{method:?}");
    }
    let model = Isochoric { i: 1.0, asked: Asked }.prepare().unwrap();
    let phi = phi / phi.determinant().cbrt();
    let phi_dot = phi * (phi_dot - Matrix::<3>::identity() * (phi_dot.trace() / 3.0));
    let start = model.at_velocity(phi, phi_dot).unwrap();
    for method in [
        Method::Automatic,
        Method::Gauss { stages: 2, step: 0.05 },
        Method::Rattle { order: 4, step: 0.05 },
        Method::Radau { stages: None },
    ] {
        let run = || Simulation::new(&model, start).until(1.0).method(method).every(0.3).run().unwrap();
        let (counted, asked) = counts(run);
        assert_eq!(counted, asked, "isochoric, {method:?}");
    }
}

/// Series are counted as such; what they are worth stands beside evaluations.
#[test]
fn series_and_evaluations_can_be_compared() {
    let (phi, phi_dot) = strained();
    let start = Vibrating.at_velocity(phi, phi_dot).unwrap();
    for tolerance in [1e-8, 1e-11, 1e-14] {
        let cost = |method| {
            let run = Simulation::new(&Vibrating, start).until(10.0).tolerance(tolerance).method(method);
            run.output([]).run().unwrap().statistics()
        };
        let (series, explicit) = (cost(Method::Taylor { order: None }), cost(Method::RungeKutta8));
        assert_eq!((explicit.series, explicit.series_worth), (0, 0));
        assert_eq!(explicit.equivalent_evaluations(), explicit.evaluations);
        assert_eq!(series.series, series.steps);
        // At the start: the slope, and one for each component of the momentum.
        assert!(series.evaluations < 12, "{series:?}");
        let ratio = series.equivalent_evaluations() as f64 / explicit.evaluations as f64;
        assert!((0.5..8.0).contains(&ratio), "{tolerance:e}: {ratio}, {series:?}, {explicit:?}");
    }
}

/// Flows of the last piece in a step of order 4 and in its halves.
const FLOWS: u64 = 3 * 7;
/// The slope, one evaluation for each component of the spin, and the fastest rate.
const START: u64 = 1 + 9 + FASTEST;
const FASTEST: u64 = 4;

/// Whether a stiff dilatation is worth splitting is tried, and the trial is a part of the cost.
#[test]
fn trials_are_counted() {
    let (phi, phi_dot) = strained();
    let (x, v) = (Vector::<3>::new(0.4, -0.1, 0.3), Vector::<3>::new(0.3, -0.2, 0.5));
    for (kappa, tolerance, t_end, is_taken) in
        [(1e8, 1e-2, 3.0, true), (1e8, 1e-10, 0.3, false), (10.0, 1e-4, 0.3, false)]
    {
        let model = Missile { kappa }.prepare().unwrap();
        let run = |method| {
            let start = model.at_velocity(x, phi, v, phi_dot).unwrap();
            let run = Simulation::new(&model, start).until(t_end).tolerance(tolerance).method(method);
            run.output([]).run().unwrap()
        };
        let chosen = run(Method::Automatic);
        let taken = chosen.computation().method;
        assert_eq!(taken == Method::AdaptiveSplitting { order: None }, is_taken, "{}", chosen.why());
        let (chosen, named) = (chosen.statistics(), run(taken).statistics());
        if is_taken {
            assert_eq!(named.evaluations, START + FLOWS * (named.steps + named.rejected));
        }
        // Of an interval of a few turns alone the fastest rate decides.
        let trial = if kappa > 1e6 { FASTEST + START + FLOWS } else { FASTEST };
        assert_eq!(chosen.evaluations, named.evaluations + trial, "kappa = {kappa:e}, {tolerance:e}");
    }
}
