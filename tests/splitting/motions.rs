//! Motions by splitting: orders, references, what is kept.

use affine_runtime::capability::Splitting;
use affine_runtime::model::Conserved;
use affine_runtime::prelude::*;

use crate::models::*;

fn run<const N: usize, M: Model<N>>(
    model: &M,
    start: M::Point<f64>,
    t_end: f64,
    method: Method,
) -> Trajectory<N, M::Point<f64>> {
    let run = Simulation::new(model, start).until(t_end).tolerance(1e-15).output([t_end]).method(method);
    run.max_steps(10_000_000).run().unwrap()
}

pub(crate) fn difference<const N: usize, P: Phase<N>>(one: &P, other: &P) -> f64 {
    let placement = (one.phi() - other.phi()).norm();
    let spin = (one.sigma().0.0 - other.sigma().0.0).norm();
    let centre = (one.x() - other.x()).norm() + (one.p() - other.p()).norm();
    (placement + spin + centre) / (1.0 + other.phi().norm() + other.sigma().0.0.norm())
}

/// Halving the step divides the error by `2^order`, up to the next term of the error; 0.42 is the largest difference
/// found, of SRKN14a. Shorter steps of order 8 meet the rounding of the missile.
const ORDER: f64 = 0.45;

fn assert_orders<const N: usize, M: Model<N>>(name: &str, model: &M, start: M::Point<f64>) {
    let exact = *run(model, start, 2.0, Method::RungeKutta8).end().1;
    for (order, step) in [(2, 0.02), (4, 0.1), (6, 0.2), (8, 2.0 / 9.0)] {
        let error = |step: f64| {
            let end = run(model, start, 2.0, Method::Splitting { order, step });
            difference(end.end().1, &exact)
        };
        let errors = [error(step), error(step / 2.0)];
        let measured = (errors[0] / errors[1]).log2();
        assert!((measured - order as f64).abs() < ORDER, "{name}: order {order}: {measured} from {errors:?}");
    }
}

#[test]
fn orders_on_nonlinear_problems() {
    let mut count = 0;
    macro_rules! visit {
        ($name:literal, $n:literal, $model:expr, $start:expr) => {
            assert_orders::<$n, _>($name, $model, $start);
            count += 1;
        };
    }
    each_model!(visit);
    assert_eq!(count, 43);
}

/// The rows of a reference solution: time, `phi`, affine spin.
fn rows(data: &str) -> Vec<(f64, Matrix<3>, Matrix<3>)> {
    let lines = data.lines().filter(|line| !line.starts_with('#')).skip(1);
    let row = |line: &str| {
        let numbers: Vec<f64> = line.split(',').map(|number| number.parse().unwrap()).collect();
        let matrix = |from: usize| Matrix::<3>::from_row_slice(&numbers[from..from + 9]);
        (numbers[0], matrix(1), matrix(10))
    };
    lines.map(row).collect()
}

/// Relative error of `phi` against 45 digits at the rows up to t = 10, at order 8 and a step of 0.05: what rounding
/// and the exponential growth of errors leave.
const REFERENCE: f64 = 5e-12;

#[test]
fn reference_solutions() {
    let elastic = Elastic { kappa: 10.0 }.prepare().unwrap();
    let data = rows(include_str!("../data/p3.csv"));
    let start = elastic.at_momentum(data[0].1, TwoPoint(data[0].2)).unwrap();
    assert_reference(&elastic, start, &data);
    let data = rows(include_str!("../data/p2.csv"));
    let start = Vibrating.at_momentum(data[0].1, Comoving(data[0].2)).unwrap();
    assert_reference(&Vibrating, start, &data);
}

fn assert_reference<M: Model<3>>(model: &M, start: M::Point<f64>, data: &[(f64, Matrix<3>, Matrix<3>)]) {
    let due: Vec<_> = data.iter().filter(|row| row.0 > 0.0 && row.0 <= 10.0).collect();
    let step = 0.03;
    let run = Simulation::new(model, start).until(10.0).output(due.iter().map(|row| row.0));
    let run = run.method(Method::Splitting { order: 8, step }).run().unwrap();
    assert_eq!(run.len(), due.len());
    for ((t, phi, _), point) in due.into_iter().zip(run.points()) {
        let error = (point.phi() - phi).norm() / phi.norm();
        assert!(error < REFERENCE, "t = {t}: {error:e}");
    }
}

/// What 40 steps of order 4 leave of a motion to t = 1 whose dilatation swings 4 to 1900 times.
const UNRESOLVED: f64 = 1e-6;

#[test]
fn a_stiff_dilatation_does_not_limit_the_step() {
    // Translation couples the dilatation to the rest and keeps it in the state; it moves along its own flow.
    const { assert!(<PreparedVibratingMissile as Splitting<3>>::DILATES) };
    let [(_, phi, momentum), ..] = rows(include_str!("../data/p2.csv"))[..] else { panic!("no rows") };
    let (x, p) = (Vector::<3>::zeros(), Vector::<3>::new(0.3, -0.2, 0.5));
    for kappa in [1e3, 1e4, 1e6, 1e8] {
        let missile = VibratingMissile { m: 1.0, kappa }.prepare().unwrap();
        let start = missile.at_momentum(x, phi, p, Comoving(momentum)).unwrap();
        let at_the_end = |method| {
            let run = Simulation::new(&missile, start).until(1.0).tolerance(1e-12).max_steps(1_000_000);
            run.method(method).output([1.0]).run().unwrap()
        };
        let split = at_the_end(Method::Splitting { order: 4, step: 1.0 / 40.0 });
        let resolved = at_the_end(Method::RungeKutta8);
        let error = (split.end().1.phi() - resolved.end().1.phi()).norm();
        assert!(error < UNRESOLVED, "kappa = {kappa:e}: {error:e}");
        assert_eq!(split.statistics().evaluations, 280);
    }
}

/// Of steps that resolve every swing: by some hundred times less than they are held against.
const RESOLVING: f64 = 1e-9;

/// What 40 steps leave of `phi` at t = 1, against a motion whose steps resolve every swing.
fn unresolved<M: Model<3>>(model: &M, start: M::Point<f64>, order: usize) -> f64 {
    let at_the_end = |method| {
        let run = Simulation::new(model, start).until(1.0).tolerance(RESOLVING).max_steps(1_000_000);
        run.method(method).output([1.0]).run().unwrap()
    };
    let split = at_the_end(Method::Splitting { order, step: 1.0 / 40.0 });
    let resolved = at_the_end(Method::RungeKutta8);
    (split.end().1.phi() - resolved.end().1.phi()).norm()
}

/// At order 4: 5e-11 to 7e-9 as long as the swings are resolved, then the displacement by kicks, of which 9e-6 is the
/// largest below.
const KICKED: f64 = 2e-5;

#[test]
fn a_stiff_dilatation_does_not_limit_the_step_beside_forces_that_change_with_it() {
    let [(_, phi, momentum), ..] = rows(include_str!("../data/p2.csv"))[..] else { panic!("no rows") };
    for kappa in [1e3, 1e4, 1e5, 1e6, 1e7, 1e8] {
        let model = Inflated { kappa }.prepare().unwrap();
        let error = unresolved(&model, model.at_momentum(phi, Comoving(momentum)).unwrap(), 4);
        assert!(error < KICKED, "inflated, kappa = {kappa:e}: {error:e}");
        let model = Pulled { kappa }.prepare().unwrap();
        let error = unresolved(&model, model.at_momentum(phi, Comoving(momentum)).unwrap(), 4);
        assert!(error < KICKED, "pulled, kappa = {kappa:e}: {error:e}");
        // Over the total affine momentum, translation moving both.
        let model = Towed { kappa, m: 1.0 }.prepare().unwrap();
        let error = unresolved(&model, model.at_momentum(x3(), phi, p3(), Spatial(momentum)).unwrap(), 4);
        assert!(error < KICKED, "towed, kappa = {kappa:e}: {error:e}");
    }
}

/// The error of order 2 in what its steps resolve: 2e-5 at stiffnesses that are at no resonance.
const RESOLVED: f64 = 1e-4;

#[test]
fn kicks_in_step_with_a_stiff_dilatation_move_it_no_further_than_they_push() {
    let [(_, phi, momentum), ..] = rows(include_str!("../data/p2.csv"))[..] else { panic!("no rows") };
    // 3 (I + A + 3 B), the largest trace of G along the motion, and the largest |phi|.
    let (mass, trace, size) = (4.5, 4.0, 2.0);
    for swings in [1.0, 2.0, 3.0] {
        // A step of 1/40 takes so many whole swings.
        let frequency = 40.0 * swings * std::f64::consts::TAU;
        let model = Inflated { kappa: mass * frequency * frequency }.prepare().unwrap();
        let start = model.at_momentum(phi, Comoving(momentum)).unwrap();
        // The kicks add up to the momentum t dW/dq, by which q swings over m w.
        let push = 0.6 * trace / (mass * frequency) * size;
        let [second, fourth] = [2, 4].map(|order| unresolved(&model, start, order));
        assert!(second < push + RESOLVED && fourth < push, "{swings}: {second:e}, {fourth:e}, push {push:e}");
        // They do: where a part of the potential changes with the dilatation, some steps resolve less than others.
        assert!(swings > 1.0 || second > 5.0 * RESOLVED, "{second:e}");
    }
}

/// Steps of the long runs.
const STEPS: u32 = 100_000;
/// Momentum maps are kept to `c eps sqrt(steps)` times their size, `c` this: a tenth, since increments are summed with
/// compensation.
const MOMENTA: f64 = 0.1;

pub(crate) fn assert_kept<const N: usize, M: Model<N>>(
    name: &str,
    model: &M,
    start: M::Point<f64>,
    (order, step): (usize, f64),
    energy: f64,
) -> M::Point<f64> {
    let t_end = step * f64::from(STEPS);
    let run = Simulation::new(model, start).until(t_end).every(t_end / 400.0).max_steps(1_000_000);
    let run = run.method(Method::Splitting { order, step }).run().unwrap();
    assert_eq!(run.statistics().steps, u64::from(STEPS));
    let conservation = run.conservation();
    for drift in conservation.drifts() {
        let allowed = match drift.quantity {
            Conserved::Energy => energy,
            _ => MOMENTA * f64::EPSILON * f64::from(STEPS).sqrt(),
        };
        assert!(drift.relative() <= allowed, "{name}: {:?}: {:e}", drift.quantity, drift.relative());
    }
    // No drift: the second half errs no more than the first.
    let drift = conservation.of(Conserved::Energy).unwrap();
    let errors = run.relative_drifts(drift);
    let half = errors.len() / 2;
    let worst = |part: &[f64]| part.iter().fold(0.0, |worst: f64, e| worst.max(e.abs()));
    let (first, second) = (worst(&errors[..half]), worst(&errors[half..]));
    assert!(second < 1.5 * first, "{name}: energy errors grow from {first:e} to {second:e}");
    *run.end().1
}

#[test]
fn a_hundred_thousand_steps() {
    let start = Vibrating.at_momentum(phi3(), Comoving(spin3())).unwrap();
    assert_kept("vibrating", &Vibrating, start, (2, 0.02), 2e-4);
    let start = PlanarMirrored.at_momentum(phi2(), Spatial(spin2())).unwrap();
    assert_kept("planar mirrored", &PlanarMirrored, start, (4, 0.05), 1e-10);
    let model = Elastic { kappa: 10.0 }.prepare().unwrap();
    let start = model.at_momentum(phi3(), Comoving(spin3())).unwrap();
    assert_kept("elastic", &model, start, (2, 0.02), 2e-4);
    let start = Fibred.at_momentum(phi3(), Comoving(spin3())).unwrap();
    assert_kept("fibred", &Fibred, start, (2, 0.02), 2e-4);
    let start = Attracted.at_momentum(x3(), phi3(), p3(), Comoving(spin3())).unwrap();
    assert_kept("attracted", &Attracted, start, (2, 0.01), 2e-4);
}

#[test]
fn forth_and_back() {
    let model = VibratingMissile { m: 2.0, kappa: 10.0 }.prepare().unwrap();
    let start = model.at_momentum(x3(), phi3(), p3(), Comoving(spin3())).unwrap();
    for order in [2, 4, 6, 8] {
        let method = Method::Splitting { order, step: 0.1 };
        let there = run(&model, start, 20.0, method);
        let back =
            Simulation::new(&model, *there.end().1).from(20.0).until(0.0).method(method).run().unwrap();
        let error = difference(back.end().1, &start);
        // Rounding of 200 steps there and back, as the motion magnifies it.
        assert!(error < 1e-12, "order {order}: {error:e}");
    }
}

#[test]
fn outputs_leave_the_steps_as_they_are() {
    let start = Vibrating.at_momentum(phi3(), Comoving(spin3())).unwrap();
    let method = Method::Splitting { order: 4, step: 0.1 };
    let run = |times: &[f64]| {
        let run = Simulation::new(&Vibrating, start).until(2.0).method(method);
        run.output(times.iter().copied()).run().unwrap()
    };
    let (many, one) = (run(&[0.05, 0.33, 1.0, 1.99, 2.0]), run(&[2.0]));
    assert_eq!(many.end(), one.end());
    assert_eq!(many.statistics().steps, 20);
    // Seven kicks in each step of SRKN6b, and in each of the three shorter ones.
    assert_eq!((one.statistics().evaluations, many.statistics().evaluations), (140, 161));
    let why = one.why().to_string();
    assert!(why.contains("splitting of order 4") && why.contains("a Poisson map"), "{why}");
}

/// Friction takes the energy, and a drive changes it: `why` claims neither that it is kept nor that it is bounded.
#[test]
fn what_is_said_of_the_energy() {
    #[affine_model(dim = 2, kinetic(dalembert = 1), dissipation(dalembert = 1), emit(splitting))]
    struct Damped;
    #[affine_model(dim = 2, kinetic(dalembert = 1), potential = (2 + cos(t))*tr(G))]
    struct Shaken;

    let said = |run: &dyn Fn(Method) -> String| {
        let fixed = run(Method::Splitting { order: 4, step: 0.1 });
        (fixed, run(Method::AdaptiveSplitting { order: None }))
    };
    let by_gauss = Method::Gauss { stages: 2, step: 0.1 };
    let start = Vibrating.at_momentum(phi3(), Comoving(spin3())).unwrap();
    let (fixed, adaptive) = said(&|method| run(&Vibrating, start, 0.5, method).why().to_string());
    assert!(fixed.contains("energy error stays bounded") && adaptive.contains("the energy is kept to"));
    let start = Driven.at_momentum(phi2(), Comoving(spin2())).unwrap();
    let (fixed, adaptive) = said(&|method| run(&Driven, start, 0.5, method).why().to_string());
    assert!(fixed.contains("a Poisson map") && !(fixed + &adaptive).contains("energy"));
    let start = Damped.at_momentum(phi2(), Comoving(spin2())).unwrap();
    let (fixed, adaptive) = said(&|method| run(&Damped, start, 0.5, method).why().to_string());
    assert!(adaptive.contains("energy and work balance to the tolerance"), "{adaptive}");
    let claims = ["Casimirs", "the energy"];
    assert!(
        !claims.into_iter().any(|claim| (fixed.clone() + &adaptive).contains(claim)),
        "{fixed}{adaptive}"
    );
    let gauss = run(&Damped, start, 0.5, by_gauss).why().to_string();
    assert!(gauss.contains("symplectic but for forces that no potential has"), "{gauss}");
    // Its work is integrated beside canonical variables.
    let start = Shaken.at_momentum(phi2(), Comoving(spin2())).unwrap();
    let gauss = run(&Shaken, start, 0.5, by_gauss).why().to_string();
    assert!(gauss.contains("the reduced variables are canonical") && !gauss.contains("energy"), "{gauss}");
}

/// Steps of a motion that has a closed form leave out no integration.
#[test]
fn what_is_left_out_by_steps() {
    let start = Missile.at_momentum(x3(), phi3(), Vector::zeros(), Comoving(spin3())).unwrap();
    let why = |method| run(&Missile, start, 0.5, method).why().to_string();
    assert!(why(Method::Automatic).contains("left out of the model: integration"));
    assert!(!why(Method::Splitting { order: 4, step: 0.1 }).contains("integration"));
}

#[affine_model(dim = 3, kinetic(casimir2 = 0.2, body_inertia = 1), potential = tr(G))]
struct Plain;

#[test]
fn what_is_refused() {
    let start = Plain.at_momentum(phi3(), Comoving(spin3())).unwrap();
    let method = Method::Splitting { order: 4, step: 0.1 };
    let halt = Simulation::new(&Plain, start).until(1.0).method(method).run().unwrap_err().to_string();
    assert!(halt.contains("Plain was not given `splitting`: write `emit(splitting)`"), "{halt}");
    let start = Vibrating.at_momentum(phi3(), Comoving(spin3())).unwrap();
    let run = |order, step| {
        let run = Simulation::new(&Vibrating, start).until(1.0).method(Method::Splitting { order, step });
        run.run().unwrap_err().to_string()
    };
    assert!(run(3, 0.1).contains("order 3: RATTLE and splitting have the orders 2, 4, 6 and 8"));
    assert!(run(4, 0.0).contains("a step of 0"));
}
