//! Settings that make no sense, or look as if they did not, for every method.

use affine_runtime::lattice::{LatticeFlow, TwoPolarForm};
use affine_runtime::prelude::*;
use affine_runtime::report::{Demand, Oracle, StabilityReport, relative_distance};
use affine_runtime::simulate::Method;
use affine_runtime::{Error, lattice};

use super::shared::scene;

#[affine_model(
    dim = 2,
    kinetic(casimir2 = 0.2, body_inertia = 1),
    potential = harmonic_dilatation(10) + neo_hookean(0.5),
    emit(taylor, splitting, lanes, two_polar),
)]
pub(crate) struct Disc;

#[affine_model(dim = 2, kinetic(casimir2 = 0.2, body_inertia = 1))]
pub(crate) struct Free;

#[affine_model(dim = 2, constraint = isochoric, kinetic(dalembert = 1), potential = 0.5*tr(G))]
pub(crate) struct Isochoric;

#[affine_model(dim = 2, constraint = rigid, kinetic(dalembert = 1))]
pub(crate) struct Rigid;

const STEP: f64 = 0.3;

/// Every method, with those whose step is the given one.
fn methods(step: f64) -> Vec<(Who, Method)> {
    let mut list = vec![
        (Who::Disc, Method::Automatic),
        (Who::Disc, Method::RungeKutta8),
        (Who::Disc, Method::Taylor { order: None }),
        (Who::Disc, Method::Taylor { order: Some(12) }),
        (Who::Free, Method::ClosedForm),
        (Who::Isochoric, Method::RungeKutta8),
        (Who::Rigid, Method::RungeKutta8),
    ];
    list.extend(with_steps(step));
    list
}

/// The methods of fixed steps.
fn with_steps(step: f64) -> Vec<(Who, Method)> {
    let mut list = Vec::new();
    for stages in [2, 3] {
        let method = Method::Gauss { stages, step };
        list.extend([(Who::Disc, method), (Who::Isochoric, method), (Who::Rigid, method)]);
    }
    for order in [2, 4, 6, 8] {
        list.push((Who::Disc, Method::Splitting { order, step }));
        list.push((Who::Isochoric, Method::Rattle { order, step }));
    }
    list
}

/// Whose motion.
#[derive(Clone, Copy, Debug)]
enum Who {
    Disc,
    Free,
    Isochoric,
    Rigid,
}

/// What is set besides the method.
#[derive(Clone, Copy)]
struct Settings {
    from: f64,
    until: f64,
    tolerance: f64,
    every: f64,
    max_steps: u64,
}

/// Settings that make sense.
const SOUND: Settings =
    Settings { from: 0.0, until: 1.0, tolerance: 1e-12, every: 0.25, max_steps: 1_000_000 };

fn phi() -> Matrix<2> {
    Matrix::<2>::new(1.25, 0.25, 0.25, 0.85)
}

fn spin() -> Matrix<2> {
    Matrix::<2>::new(0.3, -0.4, 0.6, -0.1)
}

impl Who {
    fn run(self, method: Method, settings: Settings) -> Result<Outcome, Error> {
        let unit = Matrix::<2>::identity();
        let shear = Matrix::<2>::new(0.3, 0.2, 0.4, -0.3);
        match self {
            Self::Disc => end(&Disc, Disc.at_momentum(phi(), Comoving(spin()))?, method, settings),
            Self::Free => end(&Free, Free.at_momentum(phi(), Comoving(spin()))?, method, settings),
            Self::Isochoric => end(&Isochoric, Isochoric.at_velocity(unit, shear)?, method, settings),
            Self::Rigid => {
                let turn = Matrix::<2>::new(0.0, -1.0, 1.0, 0.0);
                end(&Rigid, Rigid.at_velocity(unit, turn)?, method, settings)
            }
        }
    }
}

/// Start and end of a run, and the time that it came to.
struct Outcome {
    start: Matrix<2>,
    end: Matrix<2>,
    t: f64,
    steps: u64,
}

fn end<M: Model<2>>(
    model: &M,
    start: M::Point<f64>,
    method: Method,
    settings: Settings,
) -> Result<Outcome, Error> {
    let Settings { from, until, tolerance, every, max_steps } = settings;
    let simulation = Simulation::new(model, start).from(from).until(until).tolerance(tolerance);
    let run = simulation.every(every).max_steps(max_steps).method(method).run()?;
    let (t, point) = run.end();
    Ok(Outcome { start: *start.phi(), end: *point.phi(), t, steps: run.statistics().steps })
}

pub(super) fn cases(report: &mut StabilityReport) -> affine_runtime::Result<()> {
    report.heading("bad settings, every method");
    let bad: [(&str, &str, Settings); 15] = [
        ("tolerance 0", "tolerance 0", Settings { tolerance: 0.0, ..SOUND }),
        ("tolerance -1e-6", "tolerance -1e-6", Settings { tolerance: -1e-6, ..SOUND }),
        ("tolerance 1e-30", "at least 1e-15", Settings { tolerance: 1e-30, ..SOUND }),
        ("tolerance 1", "below 1", Settings { tolerance: 1.0, ..SOUND }),
        ("tolerance NaN", "tolerance NaN", Settings { tolerance: f64::NAN, ..SOUND }),
        ("end NaN", "times are finite", Settings { until: f64::NAN, ..SOUND }),
        ("end infinite", "times are finite", Settings { until: f64::INFINITY, ..SOUND }),
        ("start NaN", "times are finite", Settings { from: f64::NAN, ..SOUND }),
        ("start infinite", "times are finite", Settings { from: f64::NEG_INFINITY, ..SOUND }),
        ("1e9 outputs", "at most 1e8 outputs", Settings { every: 1e-9, ..SOUND }),
        ("output every 0", "positive number", Settings { every: 0.0, ..SOUND }),
        ("output every -0.1", "positive number", Settings { every: -0.1, ..SOUND }),
        ("output every NaN", "positive number", Settings { every: f64::NAN, ..SOUND }),
        ("output every infinity", "positive number", Settings { every: f64::INFINITY, ..SOUND }),
        ("no steps", "allows no step", Settings { max_steps: 0, ..SOUND }),
    ];
    for (what, words, settings) in bad {
        refused(report, what, words, methods(STEP), settings);
    }
    for (what, step) in [
        ("step 0", 0.0),
        ("step -0.1", -0.1),
        ("step NaN", f64::NAN),
        ("step infinite", f64::INFINITY),
        ("step 1e-300", 1e-300),
    ] {
        refused(report, what, "a step of", with_steps(step), SOUND);
    }
    let orders = |order| {
        vec![
            (Who::Disc, Method::Taylor { order: Some(order) }),
            (Who::Disc, Method::Splitting { order, step: STEP }),
            (Who::Isochoric, Method::Rattle { order, step: STEP }),
        ]
    };
    for order in [0, 1, 33, usize::MAX] {
        refused(report, &format!("order {order}"), "order ", orders(order), SOUND);
    }
    let few = Settings { max_steps: 10, ..SOUND };
    refused(report, "steps of 1e-7, 10 of them", "10, is used up", with_steps(1e-7), few);
    points(report);
    harmless(report);
    flows(report)
}

/// Refused with the words by every one of the methods.
fn refused(
    report: &mut StabilityReport,
    what: &str,
    words: &'static str,
    methods: Vec<(Who, Method)>,
    settings: Settings,
) {
    let named = scene("four models", 2, what.to_owned(), "run()", Oracle::Documentation);
    report.case(named, Demand::Refused(words), || {
        let mut last = None;
        for (who, method) in methods {
            match who.run(method, settings) {
                // A run that should have been refused is an answer, and falls short.
                Ok(run) => return Ok((f64::NAN, run.steps)),
                Err(error) if !error.to_string().contains(words) => return Err(error),
                Err(error) => last = Some(error),
            }
        }
        last.map_or(Ok((f64::NAN, 0)), Err)
    });
}

/// Points that a start is not made of, put together by `unflatten`, which does not look at them.
fn points(report: &mut StabilityReport) {
    let flawed = |phi: Matrix<2>, spin: Matrix<2>| {
        let by_rows = |m: &Matrix<2>| [m[(0, 0)], m[(0, 1)], m[(1, 0)], m[(1, 1)]];
        let ([a, b, c, d], [e, f, g, h]) = (by_rows(&phi), by_rows(&spin));
        Disc.unflatten(&[a, b, c, d, e, f, g, h])
    };
    let nan = |m: Matrix<2>, value: f64| Matrix::<2>::new(m[(0, 0)], value, m[(1, 0)], m[(1, 1)]);
    for (what, words, start) in [
        ("NaN in phi", "not finite", flawed(nan(phi(), f64::NAN), spin())),
        ("infinity in phi", "not finite", flawed(nan(phi(), f64::INFINITY), spin())),
        ("NaN in Sigma_hat", "not finite", flawed(phi(), nan(spin(), f64::NAN))),
        ("infinity in Sigma_hat", "not finite", flawed(phi(), nan(spin(), f64::INFINITY))),
        ("det phi = 0", "not positive", flawed(Matrix::<2>::new(1.0, 1.0, 1.0, 1.0), spin())),
        ("det phi < 0", "not positive", flawed(Matrix::<2>::new(0.0, 1.0, 1.0, 0.0), spin())),
    ] {
        let named = scene("body-metric", 2, format!("{what}, unchecked"), "run()", Oracle::Documentation);
        report.case(named, Demand::Refused(words), || {
            let mut last = None;
            for (_, method) in methods(STEP).into_iter().filter(|(who, _)| matches!(who, Who::Disc)) {
                match end(&Disc, start, method, SOUND) {
                    Ok(run) => return Ok((f64::NAN, run.steps)),
                    Err(error) if !error.to_string().contains(words) => return Err(error),
                    Err(error) => last = Some(error),
                }
            }
            last.map_or(Ok((f64::NAN, 0)), Err)
        });
    }
}

/// What looks odd and is right: the largest error over all methods.
fn harmless(report: &mut StabilityReport) {
    let all = |measure: &dyn Fn(Who, Method) -> Result<(f64, u64), Error>| {
        let mut worst = (0.0_f64, 0);
        for (who, method) in methods(STEP) {
            let (error, steps) = measure(who, method)?;
            // Not `f64::max`, which would drop a NaN.
            worst = (if error <= worst.0 { worst.0 } else { error }, worst.1 + steps);
        }
        Ok(worst)
    };
    let named = |what: &str, quantity| scene("four models", 2, what.to_owned(), quantity, Oracle::Invariance);
    report.case(named("an interval of length 0", "the start"), Demand::Held(0.0), || {
        all(&|who, method| {
            let run = who.run(method, Settings { from: 2.0, until: 2.0, ..SOUND })?;
            Ok((relative_distance(&run.end, &run.start) + (run.t - 2.0).abs(), run.steps))
        })
    });
    // Equal steps of 0.25; the coarsest method has order 2.
    for (what, until, most) in [("end 1 of steps of 0.3", 1.0, 0.02), ("backward to -1", -1.0, 0.02)] {
        report.case(named(what, "end, and its time"), Demand::Held(most), || {
            all(&|who, method| {
                let exact = match method {
                    Method::ClosedForm => method,
                    _ => Method::RungeKutta8,
                };
                let expected = who.run(exact, Settings { until, ..SOUND })?;
                let run = who.run(method, Settings { until, ..SOUND })?;
                let missed = if run.t == until { 0.0 } else { f64::NAN };
                Ok((relative_distance(&run.end, &expected.end) + missed, run.steps))
            })
        });
    }
}

/// The flow of the lattice, which has settings of its own.
fn flows(report: &mut StabilityReport) -> affine_runtime::Result<()> {
    let start = Disc.lattice(&Disc.at_momentum(phi(), Comoving(spin()))?)?;
    let stopped = |stop: lattice::LatticeStop<2>| match stop.reason {
        lattice::StopReason::Conversion(error) => Err(error),
        // Other reasons are no errors of the library: their words are what counts.
        reason => Ok(reason.to_string()),
    };
    for (what, words, tolerance, t) in [
        ("tolerance 0", "tolerance 0", 0.0, 1.0),
        ("tolerance -1e-6", "tolerance -1e-6", -1e-6, 1.0),
        ("tolerance 1e-30", "at least 1e-15", 1e-30, 1.0),
        ("tolerance NaN", "tolerance NaN", f64::NAN, 1.0),
        ("end NaN", "t is not finite", 1e-12, f64::NAN),
        ("end infinite", "t is not finite", 1e-12, f64::INFINITY),
    ] {
        let named = scene("lattice", 2, what.to_owned(), "advance_to()", Oracle::Documentation);
        // Held: the words are there.
        let demand = Demand::HeldOrRefused(0.0);
        report.case(named, demand, || {
            let mut flow = LatticeFlow::new(&Disc, 0.0, start).tolerance(tolerance);
            match flow.advance_to(t).copied() {
                Ok(_) => Ok((f64::NAN, 0)),
                Err(stop) => {
                    let text = stopped(stop)?;
                    Ok((if text.contains(words) { 0.0 } else { f64::NAN }, 0))
                }
            }
        });
    }
    report.case(
        scene("lattice", 2, "forth and back".to_owned(), "the start", Oracle::Invariance),
        Demand::Held(1e-11),
        || {
            let mut flow = LatticeFlow::new(&Disc, 0.0, start).tolerance(1e-13);
            let there = flow.advance_to(1.0).is_ok();
            let back = if there { flow.advance_to(0.0).ok() } else { None };
            Ok((back.map_or(f64::NAN, |end| (end.q - start.q).norm()), flow.steps().0))
        },
    );
    Ok(())
}
