//! Motions by Taylor series against reference solutions of 45 digits.

use affine_runtime::prelude::*;

/// Relative error of `phi` at every row of a reference, `T = 50` and 180 to 260 steps: some tens of roundings.
const MOTION: f64 = 1e-13;

#[affine_model(
    dim = 3,
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, body_translation = 1),
    emit(taylor)
)]
struct Missile;

#[affine_model(
    dim = 3,
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1),
    potential = hyperbolic_dilatation(10) + neo_hookean(0.5),
    emit(taylor),
)]
struct Vibrating;

#[affine_model(
    dim = 3,
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, space_inertia = 1),
    potential = hyperbolic_dilatation(10) + neo_hookean(0.5),
    emit(taylor),
)]
struct Mirrored;

#[affine_model(
    dim = 3,
    kinetic(dalembert = diag(1, 1.5, 2)),
    potential = hyperbolic_dilatation(kappa) + neo_hookean(0.5),
    emit(taylor),
)]
struct Elastic {
    kappa: f64,
}

#[affine_model(
    dim = 3,
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1),
    potential = hyperbolic_dilatation(10) + neo_hookean(0.5)
)]
struct Plain;

/// A drive, whose work stands beside the motion.
#[affine_model(
    dim = 3,
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1),
    potential = hyperbolic_dilatation(10) + neo_hookean(0.5) + 0.3*sin(5*t)*G[1,2],
    emit(taylor),
)]
struct Driven;

/// Time is one more variable: long steps against short ones of another method, forth and back, with the balance of energy.
#[test]
fn driven_bodies() {
    let phi = Matrix::<3>::new(1.1, 0.2, -0.1, 0.05, 0.9, 0.15, -0.2, 0.1, 1.05);
    let spin = Matrix::<3>::new(0.1, 0.4, -0.3, -0.2, -0.15, 0.25, 0.35, -0.1, 0.05);
    let start = Driven.at_momentum(phi, Comoving(spin)).unwrap();
    let to = |from: f64, until: f64, method| {
        let run = Simulation::new(&Driven, start).from(from).until(until).tolerance(1e-14).method(method);
        run.output([0.4 * from + 0.6 * until, until]).run().unwrap()
    };
    for (from, until) in [(0.0, 10.0), (-3.0, 4.0), (2.0, -5.0)] {
        let [series, steps] =
            [Method::Taylor { order: None }, Method::RungeKutta8].map(|method| to(from, until, method));
        for (one, other) in series.points().iter().zip(steps.points()) {
            let error = (one.phi() - other.phi()).norm();
            assert!(error < 1e-12, "{from} to {until}: {error:e}");
        }
        let balance = series.power_balance().unwrap();
        assert!(balance.relative() < 1e-13, "{balance}");
    }
}

/// Time, `phi` and the affine spin of each row; `x` and `p_hat` between them are left aside.
fn rows(data: &str) -> Vec<(f64, Matrix<3>, Matrix<3>)> {
    let lines = data.lines().filter(|line| !line.starts_with('#')).skip(1);
    let row = |line: &str| {
        let numbers: Vec<f64> = line.split(',').map(|number| number.parse().unwrap()).collect();
        let phi = if numbers.len() == 25 { 4 } else { 1 };
        let spin = numbers.len() - 9;
        (
            numbers[0],
            Matrix::<3>::from_row_slice(&numbers[phi..phi + 9]),
            Matrix::<3>::from_row_slice(&numbers[spin..]),
        )
    };
    lines.map(row).collect()
}

/// Output at the rows, which lie between steps; the number of steps.
fn assert_is_the_motion<M: Model<3>>(
    model: &M,
    data: &str,
    start: impl FnOnce(Matrix<3>, Matrix<3>) -> M::Point<f64>,
) -> u64 {
    let rows = rows(data);
    let start = start(rows[0].1, rows[0].2);
    assert_eq!(rows[0].0, 0.0, "the start comes first");
    let run = Simulation::new(model, start)
        .until(rows[rows.len() - 1].0)
        .tolerance(1e-15)
        .output(rows[1..].iter().map(|row| row.0))
        .run()
        .unwrap();
    assert_eq!(run.computation().method, Method::Taylor { order: None });
    assert_eq!(run.len(), rows.len() - 1);
    for ((t, exact, _), point) in rows[1..].iter().zip(run.points()) {
        let error = (point.phi() - exact).norm() / exact.norm();
        assert!(error <= MOTION, "t = {t}: {error:e}");
    }
    assert_eq!(run.statistics().rejected, 0);
    run.statistics().steps
}

/// The reference with its start, which the file has in words.
fn drunk_missile() -> String {
    let data = include_str!("../data/p1.csv");
    let start =
        "0,0,0,0,1.1,0.2,-0.1,0.05,0.9,0.15,-0.2,0.1,1.05,0,0,0,0.1,0.4,-0.3,-0.2,-0.15,0.25,0.35,-0.1,0.05";
    let names = data.lines().position(|line| line.starts_with('t')).unwrap();
    let mut lines: Vec<&str> = data.lines().collect();
    lines.insert(names + 1, start);
    lines.join("\n")
}

fn missile(phi: Matrix<3>, spin: Matrix<3>) -> <Missile as Model<3>>::Point<f64> {
    Missile.at_momentum(Vector::<3>::zeros(), phi, Vector::<3>::new(0.3, -0.2, 0.5), Comoving(spin)).unwrap()
}

fn vibrating(phi: Matrix<3>, spin: Matrix<3>) -> <Vibrating as Model<3>>::Point<f64> {
    Vibrating.at_momentum(phi, Comoving(spin)).unwrap()
}

#[test]
fn benchmark_problems() {
    let elastic = Elastic { kappa: 10.0 }.prepare().unwrap();
    let steps = [
        assert_is_the_motion(&Missile, &drunk_missile(), missile),
        assert_is_the_motion(&Vibrating, include_str!("../data/p2.csv"), vibrating),
        assert_is_the_motion(&Mirrored, include_str!("../data/p2r.csv"), |phi, spin| {
            Mirrored.at_momentum(phi, Spatial(spin)).unwrap()
        }),
        assert_is_the_motion(&elastic, include_str!("../data/p3.csv"), |phi, spin| {
            elastic.at_momentum(phi, TwoPoint(spin)).unwrap()
        }),
    ];
    // As many evaluations of the recurrence; a change of the step size control shows here.
    assert_eq!(steps, [10, 119, 115, 157]);
}

fn start() -> <Vibrating as Model<3>>::Point<f64> {
    let (_, phi, spin) = rows(include_str!("../data/p2.csv"))[0];
    vibrating(phi, spin)
}

#[test]
fn forth_and_back() {
    let there = Simulation::new(&Vibrating, start()).until(10.0).tolerance(1e-15).run().unwrap();
    let back =
        Simulation::new(&Vibrating, *there.end().1).from(10.0).until(0.0).tolerance(1e-15).run().unwrap();
    let error = (back.end().1.phi() - start().phi()).norm();
    assert!(error < MOTION, "{error:e}");
}

#[test]
fn outputs_between_steps_are_as_good_as_steps() {
    let at = |times: &[f64]| {
        let run = Simulation::new(&Vibrating, start()).until(5.0).tolerance(1e-13);
        run.output(times.iter().copied()).run().unwrap()
    };
    let times: Vec<f64> = (1..=100).map(|k| f64::from(k) / 20.0).collect();
    let dense = at(&times);
    assert_eq!(dense.statistics(), at(&[5.0]).statistics(), "outputs cost nothing");
    let fine = Simulation::new(&Vibrating, start()).until(5.0).tolerance(1e-15).output(times).run().unwrap();
    for (one, other) in dense.points().iter().zip(fine.points()) {
        assert!((one.phi() - other.phi()).norm() < 1e-12);
    }
}

#[test]
fn what_runs_and_why() {
    let run = |tolerance: f64, method: Method| {
        Simulation::new(&Vibrating, start()).until(1.0).tolerance(tolerance).method(method).run().unwrap()
    };
    let fine = run(1e-12, Method::Automatic);
    assert_eq!(fine.computation().method, Method::Taylor { order: None });
    let why = fine.why().to_string();
    assert!(why.contains("Taylor series of order 21, relative error 1e-12 per step"), "{why}");
    assert_eq!(run(1e-6, Method::Automatic).computation().method, Method::RungeKutta8);
    let given = run(1e-6, Method::Taylor { order: Some(6) });
    assert!(given.why().to_string().contains("Taylor series of order 6"), "{}", given.why());
    // Where it was not emitted, `why` names the key, and asking for it is an error that does.
    let start = Plain.at_momentum(*start().phi(), start().sigma_hat()).unwrap();
    let plain = Simulation::new(&Plain, start).until(1.0).tolerance(1e-12);
    let why = plain.run().unwrap().why().to_string();
    assert!(why.contains("Runge-Kutta of order 8") && why.contains("`emit(taylor)`"), "{why}");
    let plain = Simulation::new(&Plain, start).until(1.0).method(Method::Taylor { order: None });
    let halt = plain.run().unwrap_err().to_string();
    assert!(halt.contains("Plain was not given `taylor`: write `emit(taylor)`"), "{halt}");
}

/// Stretches are called for, of which no series is known: `emit(taylor)` would be refused, and is not named.
#[test]
fn what_has_no_series_is_not_named() {
    #[affine_model(dim = 2, kinetic(casimir2 = 0.2, body_inertia = 1), potential = q1^4 + q2^4)]
    struct Single;

    let start = Single.at_momentum(Matrix::<2>::identity(), Comoving(Matrix::<2>::identity())).unwrap();
    let why = Simulation::new(&Single, start).until(0.1).tolerance(1e-12).run().unwrap().why().to_string();
    assert!(why.contains("Runge-Kutta of order 8") && !why.contains("not emitted"), "{why}");
    const { assert!(!Single::DESCRIPTION.series && Plain::DESCRIPTION.series) };
}

#[test]
fn orders_out_of_range_are_refused() {
    for order in [0, 1, 33] {
        let run =
            Simulation::new(&Vibrating, start()).until(1.0).method(Method::Taylor { order: Some(order) });
        let halt = run.run().unwrap_err().to_string();
        assert!(
            halt.contains(&format!("order {order}: ")) && halt.contains("Taylor series have 2 to 32"),
            "{halt}"
        );
    }
}

#[test]
fn a_body_at_rest_stays() {
    let start = Vibrating.at_momentum(Matrix::<3>::identity(), Comoving(Matrix::<3>::zeros())).unwrap();
    let run = Simulation::new(&Vibrating, start).until(5.0).tolerance(1e-12).run().unwrap();
    assert!((run.end().1.phi() - Matrix::<3>::identity()).norm() < 1e-14);
    assert!(run.statistics().steps < 20, "{}", run.statistics().steps);
}

#[affine_model(
    dim = 3,
    constraint = rigid,
    kinetic(dalembert = diag(1, 1.5, 2)),
    potential = 2*phi[3,3] + phi[3,1]/2,
    emit(taylor)
)]
struct Top;

#[affine_model(
    dim = 3,
    constraint = isochoric,
    kinetic(casimir2 = 0.2, body_inertia = 1),
    potential = tr(G)/2 + G[1,1]^2/4,
    emit(taylor)
)]
struct Incompressible;

/// Rounding of some hundred steps; 3e-14 is what the top leaves after a time of 100, 3e-13 after 1000.
const OFF_THE_GROUP: f64 = 2e-13;

/// On a group the series are those of the equations around it, which keep it: against steps in charts, and far along.
#[test]
fn on_groups() {
    fn assert_on_group<M: Model<3>>(model: &M, start: M::Point<f64>, defect: impl Fn(&Matrix<3>) -> f64) {
        let run = |until: f64, method| {
            let run = Simulation::new(model, start).until(until).tolerance(1e-13).output([until]);
            *run.method(method).run().unwrap().end().1
        };
        let [series, steps] = [Method::Taylor { order: None }, Method::RungeKutta8].map(|m| run(5.0, m));
        let error = (series.phi() - steps.phi()).norm();
        assert!(error < 1e-11, "{error:e}");
        let off = defect(run(50.0, Method::Taylor { order: None }).phi()).abs();
        assert!(off < OFF_THE_GROUP, "{off:e}");
    }
    let skew = |m: Matrix<3>| m - m.transpose();
    let x = Matrix::<3>::new(0.2, 0.5, -0.3, 0.1, -0.5, 0.7, 0.4, -0.2, 0.3);
    let start = Top.at_momentum(Matrix::identity(), Comoving(skew(x))).unwrap();
    assert_on_group(&Top, start, |phi| (phi.tr_mul(phi) - Matrix::identity()).norm());
    let start = Incompressible.at_momentum(Matrix::identity(), Comoving(x)).unwrap();
    assert_on_group(&Incompressible, start, |phi| phi.determinant() - 1.0);
}
