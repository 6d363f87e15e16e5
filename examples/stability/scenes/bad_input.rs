//! Input that makes no sense, or looks as if it did not.

use affine_runtime::Error;
use affine_runtime::prelude::*;
use affine_runtime::report::{Demand, Oracle, StabilityReport};
use affine_runtime::simulate::Method;

use super::shared::{relative_distance, scene};

#[affine_model(dim = 2, kinetic(casimir2 = 0.2, body_inertia = i), potential = hyperbolic_dilatation(10) + neo_hookean(0.5))]
pub(crate) struct Disc {
    i: f64,
}

#[affine_model(
    dim = 3,
    kinetic(casimir2 = 0.2, body_inertia = diag(1, 1.5, 2), body_translation = 1),
    potential = hyperbolic_dilatation(10) + neo_hookean(0.5),
)]
pub(crate) struct Missile;

type Point = <Missile as Model<3>>::Point<f64>;
type Sim<'a> = Simulation<'a, 3, Missile>;

fn start() -> affine_runtime::Result<Point> {
    let phi = Matrix::<3>::new(1.1, 0.2, -0.1, 0.05, 0.9, 0.15, -0.2, 0.1, 1.05);
    let spin = Matrix::<3>::new(0.1, 0.4, -0.3, -0.2, -0.15, 0.25, 0.35, -0.1, 0.05);
    Missile.at_momentum(Vector::<3>::zeros(), phi, Vector::<3>::new(0.3, -0.2, 0.5), Comoving(spin))
}

pub(super) fn cases(report: &mut StabilityReport) -> affine_runtime::Result<()> {
    report.heading("bad input");
    points(report)?;
    fields(report);
    settings(report)?;
    harmless(report)
}

fn points(report: &mut StabilityReport) -> affine_runtime::Result<()> {
    let good = start()?;
    let (x, p, phi, spin) = (good.x(), good.p(), *good.phi(), good.sigma_hat());
    let mut refused = |what: &str, words, attempt: Result<Point, Error>| {
        let named = scene("drunk missile", 3, what.to_owned(), "start", Oracle::Documentation);
        report.case(named, Demand::Refused(words), || attempt.map(|_| (0.0, 0)));
    };
    for (name, bad) in [("NaN", f64::NAN), ("infinity", f64::INFINITY)] {
        let mut broken = phi;
        broken[(1, 2)] = bad;
        refused(&format!("{name} in phi"), "finite", Missile.at_momentum(x, broken, p, spin));
        let mut broken = spin.0.0;
        broken[(1, 2)] = bad;
        refused(
            &format!("{name} in Sigma_hat"),
            "not finite",
            Missile.at_momentum(x, phi, p, Comoving(broken)),
        );
        let mut broken = p;
        broken[1] = bad;
        refused(&format!("{name} in p"), "p is not finite", Missile.at_momentum(x, phi, broken, spin));
        let mut broken = x;
        broken[1] = bad;
        refused(&format!("{name} in x"), "x is not finite", Missile.at_momentum(broken, phi, p, spin));
    }
    let mut flat = phi;
    flat.set_column(0, &phi.column(1).into_owned());
    refused("det phi = 0", "positive determinant", Missile.at_momentum(x, flat, p, spin));
    refused("det phi < 0", "positive determinant", Missile.at_momentum(x, -phi, p, spin));
    Ok(())
}

fn fields(report: &mut StabilityReport) {
    for (i, words) in
        [(f64::NAN, "`i` is NaN"), (f64::INFINITY, "`i` is inf"), (0.2, "I - A"), (-0.2, "I + A")]
    {
        let named = scene("body-metric", 2, format!("I = {i}, A = 0.2"), "prepare()", Oracle::Documentation);
        report.case(named, Demand::Refused(words), || Disc { i }.prepare().map(|_| (0.0, 0)));
    }
}

fn settings(report: &mut StabilityReport) -> affine_runtime::Result<()> {
    type Change = fn(Sim<'static>) -> Sim<'static>;
    let changes: [(&str, &str, Change); 16] = [
        ("no end", "no end time", |s| s),
        ("tolerance 0", "tolerance 0", |s| s.until(1.0).tolerance(0.0)),
        ("tolerance -1e-6", "tolerance -1e-6", |s| s.until(1.0).tolerance(-1e-6)),
        ("tolerance 1e-30", "at least 1e-15", |s| s.until(1.0).tolerance(1e-30)),
        ("tolerance NaN", "tolerance NaN", |s| s.until(1.0).tolerance(f64::NAN)),
        ("end NaN", "times are finite", |s| s.until(f64::NAN)),
        ("end infinite", "times are finite", |s| s.until(f64::INFINITY)),
        ("start infinite", "times are finite", |s| s.from(f64::INFINITY).until(1.0)),
        ("1e9 outputs", "at most 1e8 outputs", |s| s.until(1.0).every(1e-9)),
        ("output every 0", "positive number", |s| s.until(1.0).every(0.0)),
        ("output every -0.1", "positive number", |s| s.until(1.0).every(-0.1)),
        ("output outside", "outside the run", |s| s.until(1.0).output([2.0])),
        ("step 0", "positive number", |s| s.until(1.0).method(Method::Gauss { stages: 3, step: 0.0 })),
        ("step NaN", "positive number", |s| s.until(1.0).method(Method::Gauss { stages: 3, step: f64::NAN })),
        ("7 stages", "give 2, 3, 4 or 6 stages", |s| {
            s.until(1.0).method(Method::Gauss { stages: 7, step: 0.1 })
        }),
        ("no steps", "allows no step", |s| s.until(1.0).max_steps(0)),
    ];
    let start = start()?;
    for (what, words, change) in changes {
        let named = scene("drunk missile", 3, what.to_owned(), "run()", Oracle::Documentation);
        report.case(named, Demand::Refused(words), || {
            let run = change(Simulation::new(&Missile, start)).run()?;
            Ok((0.0, run.statistics().steps))
        });
    }
    let named = scene("drunk missile", 3, "3 steps".to_owned(), "run()", Oracle::Documentation);
    report.case(named, Demand::Refused("3, is used up"), || {
        let run = Simulation::new(&Missile, start).until(100.0).max_steps(3).run()?;
        Ok((0.0, run.statistics().steps))
    });
    Ok(())
}

/// What looks odd and is right.
fn harmless(report: &mut StabilityReport) -> affine_runtime::Result<()> {
    let start = start()?;
    let named =
        |what: &str, quantity| scene("drunk missile", 3, what.to_owned(), quantity, Oracle::Invariance);
    let simulation = || Simulation::new(&Missile, start).tolerance(1e-13);
    report.case(named("an interval of length 0", "the start"), Demand::Held(0.0), || {
        let run = simulation().from(2.0).until(2.0).run()?;
        Ok((relative_distance(run.end().1.phi(), start.phi()), run.statistics().steps))
    });
    report.case(named("an interval of 1e-300", "the start"), Demand::Held(1e-15), || {
        let run = simulation().until(1e-300).run()?;
        Ok((relative_distance(run.end().1.phi(), start.phi()), run.statistics().steps))
    });
    report.case(named("backward and forward", "the start"), Demand::Held(1e-11), || {
        let back = simulation().until(-3.0).run()?;
        let forth = Simulation::new(&Missile, *back.end().1).tolerance(1e-13).from(-3.0).until(0.0).run()?;
        Ok((relative_distance(forth.end().1.phi(), start.phi()), forth.statistics().steps))
    });
    for (what, method) in [
        ("end 1 of steps of 0.3, Gauss", Method::Gauss { stages: 3, step: 0.3 }),
        ("end 1, Runge-Kutta", Method::RungeKutta8),
    ] {
        report.case(named(what, "time of the end"), Demand::Held(0.0), || {
            let run = simulation().until(1.0).every(0.3).method(method).run()?;
            let times = run.times();
            let expected = [0.0, 0.3, 0.6, 0.9, 1.0];
            let near = times.len() == 5 && times.iter().zip(expected).all(|(t, e)| (t - e).abs() < 1e-15);
            let error = if near { (run.end().0 - 1.0).abs() } else { f64::NAN };
            Ok((error, run.statistics().steps))
        });
    }
    report.case(named("the same run twice", "phi, bit by bit"), Demand::Held(0.0), || {
        let (a, b) = (simulation().until(5.0).run()?, simulation().until(5.0).run()?);
        let bits = |run: &Trajectory<3, Point>| -> Vec<u64> {
            run.points().iter().flat_map(|point| Missile.flatten(point)).map(f64::to_bits).collect()
        };
        Ok((f64::from(u8::from(bits(&a) != bits(&b))), a.statistics().steps))
    });
    Ok(())
}
