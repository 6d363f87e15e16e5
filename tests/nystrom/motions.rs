//! The halves of the equations against the reduced equations, motions against reference solutions.

use core::ops::ControlFlow;

use affine_runtime::capability::SecondOrderEquations;
use affine_runtime::force::{Force, Motion, Translation};
use affine_runtime::prelude::*;
use affine_runtime::scalar::Scalar;
use affine_runtime::simulate::Reason;

#[affine_model(
    dim = 3,
    kinetic(dalembert = diag(1, 1.5, 2)),
    potential = hyperbolic_dilatation(kappa) + neo_hookean(0.5),
    emit(nystrom),
)]
struct Elastic {
    kappa: f64,
}

/// The centre of mass is held by springs that pull the body as well.
#[affine_model(
    dim = 2,
    kinetic(dalembert = [[1, 0.25], [0.25, 2]], space_translation = 2),
    potential = tr(G)/2 - ln(det) + x[1]^2/2 + x[2]^4/4 + x[1]*phi[1,2],
    emit(nystrom),
)]
struct Anchored;

/// The centre of mass moves in a straight line, in closed form; the potential is driven.
#[affine_model(
    dim = 2,
    kinetic(dalembert = diag(m, 1), space_translation = m),
    potential = (1 + sin(t)/4) * tr(G)/2 - ln(det),
    emit(nystrom),
)]
struct Driven {
    m: f64,
}

/// Without forces on two of its components.
#[affine_model(dim = 2, kinetic(dalembert = 1), potential = (phi[1,1] - 1)^2 + phi[1,2]^2, emit(nystrom))]
struct Partly;

fn rows() -> Vec<(f64, Matrix<3>, Matrix<3>)> {
    let lines = include_str!("../data/p3.csv").lines().filter(|line| !line.starts_with('#')).skip(1);
    let row = |line: &str| {
        let numbers: Vec<f64> = line.split(',').map(|number| number.parse().unwrap()).collect();
        let matrix = |from: usize| Matrix::<3>::from_row_slice(&numbers[from..from + 9]);
        (numbers[0], matrix(1), matrix(10))
    };
    lines.map(row).collect()
}

fn placement() -> Matrix<2> {
    Matrix::<2>::new(1.1, 0.2, -0.1, 0.9)
}

fn momentum() -> TwoPoint<Matrix<2>> {
    TwoPoint(Matrix::<2>::new(0.3, -0.2, 0.5, 0.1))
}

/// The halves give the reduced equations, but for the rate of `1/D`.
fn assert_halves<const N: usize, M: SecondOrderEquations<N>>(model: &M, point: &M::Point<f64>, t: f64) {
    use affine_runtime::model::StateVector;
    let (reduced, constants) = model.reduce(t, point);
    let expected = model.reduced_equations(t, &constants, &reduced);
    let size = M::Half::<f64>::LEN;
    let [mut positions, mut momenta] = [M::Half::<f64>::zeros(); 2];
    positions.as_mut().copy_from_slice(&reduced.as_ref()[..size]);
    momenta.as_mut().copy_from_slice(&reduced.as_ref()[size..2 * size]);
    let rates = [model.drift(&constants, &momenta), model.force(t, &constants, &positions)];
    for (rate, expected) in rates.iter().flat_map(|half| half.as_ref()).zip(expected.as_ref()) {
        assert!((rate - expected).abs() < 1e-14 * (1.0 + expected.abs()), "{rate} {expected}");
    }
    let rest = reduced.as_ref().len() - 2 * size;
    assert!(rest <= 1, "nothing but 1/D beside the halves");
    // Steps leave it as it is at the start, and points do not read it.
    let mut halves = reduced;
    halves.as_mut()[2 * size..].fill(f64::NAN);
    let [point, of_halves] = [reduced, halves].map(|state| model.expand(t, &constants, &state));
    assert_eq!(model.flatten(&of_halves), model.flatten(&point));
}

/// A run by order 8 at the finest tolerance.
fn assert_motion<const N: usize, M: SecondOrderEquations<N>>(model: &M, start: M::Point<f64>) {
    let run = |method: Method, tolerance: f64| {
        Simulation::new(model, start)
            .from(0.2)
            .until(4.0)
            .every(0.3)
            .tolerance(tolerance)
            .method(method)
            .run()
    };
    let exact = run(Method::RungeKutta8, 1e-14).unwrap();
    for method in [Method::RungeKuttaNystrom12, Method::RungeKuttaNystrom8] {
        let found = run(method, 1e-11).unwrap();
        assert_eq!(found.times(), exact.times());
        for (found, exact) in found.points().iter().zip(exact.points()) {
            let error = (found.phi() - exact.phi()).norm() + (found.pi().0.0 - exact.pi().0.0).norm();
            let centre = (found.x() - exact.x()).norm() + (found.p() - exact.p()).norm();
            assert!(error + centre < 1e-9, "{method:?}: {error:e} {centre:e}");
        }
    }
}

#[test]
fn halves_and_motions() {
    let elastic = Elastic { kappa: 10.0 }.prepare().unwrap();
    let driven = Driven { m: 1.5 }.prepare().unwrap();
    let (_, phi, pi) = rows()[0];
    let start = elastic.at_momentum(phi, TwoPoint(pi)).unwrap();
    assert_halves(&elastic, &start, 0.0);
    assert_motion(&elastic, start);
    let (x, p) = (Vector::<2>::new(0.3, -0.4), Vector::<2>::new(0.2, 0.7));
    let start = Anchored.at_momentum(x, placement(), p, momentum()).unwrap();
    assert_halves(&Anchored, &start, 0.0);
    assert_motion(&Anchored, start);
    let start = driven.at_momentum(x, placement(), p, momentum()).unwrap();
    assert_halves(&driven, &start, 0.7);
    assert_motion(&driven, start);
    let start = Partly.at_momentum(placement(), momentum()).unwrap();
    assert_halves(&Partly, &start, 0.0);
    assert_motion(&Partly, start);
}

/// Relative error of `phi` at t = 10 against 45 digits, and evaluations, at tolerances for which Runge-Kutta steps of order
/// 8 take twice as many for the same error: by order 8 at the coarsest, by order 12 at the others.
#[test]
fn problem_p3() {
    let model = Elastic { kappa: 10.0 }.prepare().unwrap();
    let data = rows();
    let start = model.at_momentum(data[0].1, TwoPoint(data[0].2)).unwrap();
    let (_, end, _) = data.iter().find(|row| row.0 == 10.0).unwrap();
    for (tolerance, error, evaluations, method) in [
        (1e-2, 1e-3, 90, Method::RungeKuttaNystrom8),
        (1e-6, 1e-6, 1200, Method::RungeKuttaNystrom12),
        (1e-9, 1e-10, 2100, Method::RungeKuttaNystrom12),
        (1e-12, 5e-14, 3500, Method::RungeKuttaNystrom12),
    ] {
        let run =
            Simulation::new(&model, start).until(10.0).tolerance(tolerance).output([10.0]).run().unwrap();
        assert_eq!(run.computation().method, method);
        let found = (run.end().1.phi() - end).norm() / end.norm();
        assert!(found < error, "{tolerance:e}: {found:e}");
        assert!(run.statistics().evaluations <= evaluations, "{:?}", run.statistics());
        assert!(run.why().to_string().contains("equations are q'' = f(t, q)"), "{}", run.why());
    }
}

#[test]
fn interrupted_runs_go_on_with_the_same_bits() {
    let model = Elastic { kappa: 10.0 }.prepare().unwrap();
    let (_, phi, pi) = rows()[0];
    let start = model.at_momentum(phi, TwoPoint(pi)).unwrap();
    for method in [Method::RungeKuttaNystrom12, Method::RungeKuttaNystrom8] {
        let simulation =
            || Simulation::new(&model, start).until(3.0).tolerance(1e-9).every(0.17).method(method);
        let whole = simulation().run().unwrap();
        let mut steps = 0;
        let halt = simulation()
            .progress(|_| {
                steps += 1;
                if steps == 7 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            })
            .run()
            .unwrap_err();
        assert!(matches!(halt.stop.reason, Reason::Interrupted(_)));
        let rest = simulation().resume(halt.trajectory.checkpoint().unwrap()).run().unwrap();
        assert_eq!(rest.end(), whole.end());
        assert_eq!(rest.statistics(), whole.statistics());
        let points: Vec<_> = halt.trajectory.points().iter().chain(rest.points()).copied().collect();
        assert_eq!(points, whole.points());
    }
}

#[test]
fn what_was_not_emitted_is_named() {
    #[affine_model(dim = 2, kinetic(dalembert = 1), potential = tr(G)/2)]
    struct Plain;

    let start = Plain.at_momentum(placement(), momentum()).unwrap();
    let run = Simulation::new(&Plain, start).until(1.0).method(Method::RungeKuttaNystrom12).run();
    let halt = run.unwrap_err().to_string();
    assert!(halt.contains("Plain was not given `nystrom`: write `emit(nystrom)`"), "{halt}");
    let of_itself = Simulation::new(&Plain, start).until(1.0).run().unwrap().why().to_string();
    assert!(of_itself.contains("not emitted: `emit(nystrom)`"), "{of_itself}");
    let run =
        Simulation::new(&Plain, start).until(1.0).method(Method::RungeKutta5).tolerance(1e-6).run().unwrap();
    assert!(run.why().to_string().contains("Runge-Kutta of order 5"), "{}", run.why());
}

/// A force of positions alone, whose work depends on velocities.
#[derive(Clone, Debug)]
struct Pull;

impl Force<2> for Pull {
    type Form = Translation;
    fn force<T: Scalar>(&self, motion: &Motion<2, T>) -> Vector<2, T> {
        -motion.x
    }
}

/// Which equations are of second order is a fact of the model, asked for or not: `why` names no `emit(..)` that would be refused.
#[test]
fn what_is_of_second_order_says_so() {
    #[affine_model(
        dim = 2,
        kinetic(dalembert = 1, space_translation = 1),
        potential = tr(G)/2,
        forces = custom(pull, translation, position)
    )]
    #[derive(Clone, Debug)]
    struct Kicked {
        pull: Pull,
    }
    #[affine_model(dim = 2, kinetic(dalembert = 1), potential = tr(G)/2*(2 + cos(t)))]
    struct Shaken;
    #[affine_model(dim = 2, kinetic(dalembert = 1), potential = tr(G)/2)]
    struct Plain;
    #[affine_model(dim = 2, kinetic(body_inertia = 1), potential = tr(G)/2)]
    struct Affine;
    #[affine_model(dim = 2, kinetic(dalembert = 1, body_inertia = 1), potential = tr(G)/2)]
    struct Sum;
    #[affine_model(dim = 2, kinetic(dalembert = 1, body_translation = 1), potential = tr(G)/2)]
    struct Pushed;
    #[affine_model(dim = 2, constraint = isochoric, kinetic(dalembert = 1), potential = tr(G)/2)]
    struct Incompressible;
    #[affine_model(dim = 2, kinetic(dalembert = 1), potential = tr(G)/2, dissipation(body_inertia = 1))]
    struct Damped;
    let facts = [Anchored::DESCRIPTION, Partly::DESCRIPTION, Plain::DESCRIPTION, Shaken::DESCRIPTION];
    assert!(facts.iter().all(|description| description.second_order));
    let facts = [
        Affine::DESCRIPTION,
        Sum::DESCRIPTION,
        Pushed::DESCRIPTION,
        Incompressible::DESCRIPTION,
        Damped::DESCRIPTION,
        Kicked::DESCRIPTION,
    ];
    for description in facts {
        assert!(!description.second_order, "{}", description.name);
    }
}

/// The name of a field decides nothing.
#[test]
fn a_field_may_be_called_omega() {
    #[affine_model(dim = 2, kinetic(dalembert = Omega), potential = orthogonality(inverse_1_1_1))]
    #[allow(non_snake_case)]
    struct Named {
        Omega: f64,
        inverse_1_1_1: f64,
    }

    let model = Named { Omega: 1.0, inverse_1_1_1: 5.0 }.prepare().unwrap();
    let start = model.at_momentum(placement(), momentum()).unwrap();
    let why = Simulation::new(&model, start).until(1.0).run().unwrap().why().to_string();
    assert!(why.contains("not emitted: `emit(nystrom)`"), "{why}");
}

/// Events look at times within steps, which would cost a step each.
#[test]
fn events_are_left_to_the_method_with_a_dense_output() {
    let model = Elastic { kappa: 10.0 }.prepare().unwrap();
    let (_, phi, pi) = rows()[0];
    let start = model.at_momentum(phi, TwoPoint(pi)).unwrap();
    let run = |method: Method| {
        let event =
            Event::new("level", |_, p: &<PreparedElastic as Model<3>>::Point<f64>| p.phi()[(0, 0)] - 1.0);
        Simulation::new(&model, start).until(3.0).tolerance(1e-10).method(method).event(event).run().unwrap()
    };
    let (chosen, asked) = (run(Method::Automatic), run(Method::RungeKuttaNystrom12));
    assert_eq!(chosen.computation().method, Method::RungeKutta8);
    assert!(!chosen.events().is_empty() && chosen.events().len() == asked.events().len());
    for (a, b) in chosen.events().iter().zip(asked.events()) {
        assert!((a.t - b.t).abs() < 1e-8, "{} {}", a.t, b.t);
    }
}
