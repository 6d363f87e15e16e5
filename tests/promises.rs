//! What every run promises, whatever the method, the direction of time and the outputs: the times that were asked for,
//! the points that lie there, events where they are, and the same bits after an interruption.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use core::cell::RefCell;
use core::ops::ControlFlow;

use affine_runtime::prelude::*;
use affine_runtime::simulate::Reason;
use affine_tests::models::{self, Served};

/// Of a method of high order at this tolerance, or of equal steps as short as below.
const CLOSE: f64 = 2e-6;
const TOLERANCE: f64 = 1e-9;
const STEP: f64 = 0.01;
const SPAN: f64 = 1.9;

/// Outputs as asked for, and the times that they mean.
#[derive(Clone, Debug)]
enum Asked {
    Steps,
    Every(f64),
    At(Vec<f64>),
}

impl Asked {
    fn all(t0: f64, t_end: f64) -> [Self; 5] {
        let along = |part: f64| t0 + part * (t_end - t0);
        [
            Asked::Steps,
            Asked::Every(SPAN / 4.0),
            Asked::Every(0.7),
            Asked::At([0.13, 0.5, 0.501, 0.92].map(along).to_vec()),
            Asked::At(vec![t0, along(0.77), t_end]),
        ]
    }

    fn times(&self, t0: f64, t_end: f64) -> Option<Vec<f64>> {
        match self {
            Asked::Steps => None,
            Asked::Every(dt) => {
                let count = (SPAN / dt).ceil() as usize;
                let inner = (0..count).map(|k| t0 + k as f64 * dt.copysign(t_end - t0));
                Some(inner.chain([t_end]).collect())
            }
            Asked::At(times) => Some(times.clone()),
        }
    }
}

/// A run as asked for.
struct Case<'a, M, P> {
    model: &'a M,
    start: P,
    method: Method,
    asked: Asked,
    interval: (f64, f64),
}

impl<'a, M, P: Copy> Case<'a, M, P> {
    fn simulation<const N: usize>(&self) -> Simulation<'a, N, M>
    where
        M: Model<N, Point<f64> = P>,
    {
        let simulation = Simulation::new(self.model, self.start)
            .from(self.interval.0)
            .until(self.interval.1)
            .tolerance(TOLERANCE)
            .method(self.method);
        match &self.asked {
            Asked::Steps => simulation,
            Asked::Every(dt) => simulation.every(*dt),
            Asked::At(times) => simulation.output(times.iter().copied()),
        }
    }
}

/// Points of a motion, each the end of a run of order 8 that goes on from the nearest one before it.
struct Exact<'a, M, P> {
    model: &'a M,
    /// Times and points, the start first.
    ends: RefCell<Vec<(f64, P)>>,
}

impl<M, P: Copy> Exact<'_, M, P> {
    fn at<const N: usize>(&self, t: f64) -> P
    where
        M: Model<N, Point<f64> = P>,
        P: Phase<N>,
    {
        let mut ends = self.ends.borrow_mut();
        let t0 = ends[0].0;
        let place = ends.partition_point(|(known, _)| (known - t0).abs() <= (t - t0).abs());
        let (known, point) = ends[place - 1];
        if known == t {
            return point;
        }
        let run = Simulation::new(self.model, point).from(known).until(t);
        let end = *run.tolerance(1e-13).method(Method::RungeKutta8).run().unwrap().end().1;
        ends.insert(place, (t, end));
        end
    }
}

/// Runs a model by its methods in every way, and holds each run against one of order 8 that ends where it is looked at.
fn keeps_its_promises<const N: usize, M>(model: &M, start: M::Point<f64>, methods: &[Method])
where
    M: Model<N>,
{
    for interval in [(0.0, SPAN), (0.3, 0.3 - SPAN)] {
        let (t0, t_end) = interval;
        let exact = Exact { model, ends: RefCell::new(vec![(t0, start)]) };
        let middle = t0 + 0.61 * (t_end - t0);
        for &method in methods {
            for asked in Asked::all(t0, t_end) {
                let case = Case { model, start, method, asked, interval };
                let label = format!("{} {method:?} {:?} {interval:?}", M::DESCRIPTION.name, case.asked);
                let run = case.simulation().run().unwrap_or_else(|halt| panic!("{label}: {halt}"));
                outputs(&run, &case.asked, interval, &label);
                run.iter().for_each(|(t, point)| close(point, &exact.at(t), &format!("{label} t = {t}")));
                assert_eq!(run.end().0.to_bits(), t_end.to_bits(), "{label}");
                assert!(balanced(&run), "{label}: {:?}", run.power_balance());
                events(&case, middle, &exact, &label);
                interruptions(&case, &run, &label);
            }
        }
    }
}

/// The work of forces is accounted for.
fn balanced<const N: usize, P: Phase<N>>(run: &Trajectory<N, P>) -> bool {
    run.power_balance().is_none_or(|balance| balance.relative() < CLOSE)
}

fn outputs<const N: usize, P: Phase<N>>(
    run: &Trajectory<N, P>,
    asked: &Asked,
    (t0, t_end): (f64, f64),
    label: &str,
) {
    match asked.times(t0, t_end) {
        Some(times) => {
            assert_eq!(run.len(), times.len(), "{label}: {:?}", run.times());
            let off = run.times().iter().zip(&times).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(off < 1e-14, "{label}: {:?}", run.times());
        }
        None => {
            assert_eq!((run.times()[0], run.times()[run.len() - 1]), (t0, t_end), "{label}");
            assert!(run.times().windows(2).all(|w| (w[1] - w[0]) * (t_end - t0) > 0.0), "{label}");
        }
    }
    assert_eq!(run.energies().len(), run.len(), "{label}");
}

/// One that records, one that puts the point where it is, and one that stops.
fn events<const N: usize, M: Model<N>>(
    case: &Case<'_, M, M::Point<f64>>,
    middle: f64,
    exact: &Exact<'_, M, M::Point<f64>>,
    label: &str,
) {
    let at = |t: f64| Event::new("at a time", move |now, _: &M::Point<f64>| now - t);
    let changed = case.simulation().event(at(middle)).event(at(middle).named("again").change(|_, p| Ok(*p)));
    let run = changed.run().unwrap_or_else(|halt| panic!("{label}: {halt}"));
    let names: Vec<&str> = run.events().iter().map(|event| event.name).collect();
    assert_eq!(names, ["at a time", "again"], "{label}");
    for event in run.events() {
        assert!((event.t - middle).abs() < 1e-9, "{label}: {} at {}", event.name, event.t);
        close(&event.point, &exact.at(middle), &format!("{label}: {}", event.name));
    }
    run.iter().for_each(|(t, point)| close(point, &exact.at(t), &format!("{label}, changed, t = {t}")));
    assert!(balanced(&run), "{label}, changed: {:?}", run.power_balance());
    if !matches!(case.asked, Asked::Steps) {
        outputs(&run, &case.asked, case.interval, label);
    }
    let run =
        case.simulation().event(at(middle).stop()).run().unwrap_or_else(|halt| panic!("{label}: {halt}"));
    assert_eq!(run.stopped_by(), Some("at a time"), "{label}");
    assert!((run.end().0 - middle).abs() < 1e-9, "{label}");
    close(run.end().1, &exact.at(middle), label);
    let beyond = |t: &f64| (t - case.interval.0).abs() > (middle - case.interval.0).abs() + 1e-9;
    assert!(!run.times().iter().any(beyond), "{label}: {:?}", run.times());
}

/// Interrupted after its third step and gone on with, a run gives what it gives uninterrupted.
fn interruptions<const N: usize, M: Model<N>>(
    case: &Case<'_, M, M::Point<f64>>,
    whole: &Trajectory<N, M::Point<f64>>,
    label: &str,
) {
    let third = |progress: &affine_runtime::simulate::Progress| match progress.steps {
        3.. => ControlFlow::Break(()),
        _ => ControlFlow::Continue(()),
    };
    let halt = case.simulation().progress(third).run().unwrap_err();
    assert!(matches!(halt.stop.reason, Reason::Interrupted(_)), "{label}: {halt}");
    let first = &halt.trajectory;
    let Some(checkpoint) = first.checkpoint() else { panic!("{label}: no checkpoint") };
    let rest = case.simulation().resume(checkpoint).run().unwrap_or_else(|halt| panic!("{label}: {halt}"));
    let times: Vec<f64> = first.times().iter().chain(rest.times()).copied().collect();
    assert_eq!(times, whole.times(), "{label}");
    let points = first.points().iter().chain(rest.points());
    assert!(points.zip(whole.points()).all(|(a, b)| a == b), "{label}: other points");
    let work = |run: &Trajectory<N, _>| run.power_balance().map(|balance| balance.work);
    assert_eq!((rest.end(), work(&rest)), (whole.end(), work(whole)), "{label}");
    assert!(balanced(&rest), "{label}, resumed: {:?}", rest.power_balance());
}

fn close<const N: usize, P: Phase<N>>(point: &P, exact: &P, label: &str) {
    let off = [
        (point.phi() - exact.phi()).norm(),
        (point.mixed_spin() - exact.mixed_spin()).norm(),
        (point.x() - exact.x()).norm(),
        (point.p() - exact.p()).norm(),
    ];
    assert!(off.iter().all(|off| *off < CLOSE), "{label}: {off:?}");
}

#[test]
fn by_nystrom_steps() {
    let Served { model, start, methods } = models::anchored(STEP);
    keeps_its_promises(&model, start, &fine(methods));
}

#[test]
fn by_taylor_series() {
    let Served { model, start, methods } = models::vibrating(STEP);
    keeps_its_promises(&model, start, &fine(methods));
}

#[test]
fn by_exact_flows_of_pieces() {
    let Served { model, start, methods } = models::springs(STEP);
    keeps_its_promises(&model, start, &fine(methods));
}

#[test]
fn under_forces_that_depend_on_time() {
    let Served { model, start, methods } = models::driven(STEP);
    let run = Simulation::new(&model, start).until(1.0).run().unwrap();
    assert!(
        run.power_balance().is_some_and(|balance| balance.work.abs() > 0.01),
        "{:?}",
        run.power_balance()
    );
    keeps_its_promises(&model, start, &fine(methods));
}

#[test]
fn in_closed_form() {
    let Served { model, start, methods } = models::free(STEP);
    keeps_its_promises(&model, start, &fine(methods));
}

#[test]
fn on_groups() {
    let Served { model, start, methods } = models::top(STEP);
    keeps_its_promises(&model, start, &fine(methods));
}

#[test]
fn by_rattle() {
    let Served { model, start, methods } = models::droplet(STEP);
    keeps_its_promises(&model, start, &fine(methods));
}

/// Those that come close in steps of that length: order 2 does not.
fn fine(methods: Vec<Method>) -> Vec<Method> {
    let is_fine = |method: &Method| {
        !matches!(method, Method::Splitting { order: 2, .. } | Method::Rattle { order: 2, .. })
    };
    methods.into_iter().filter(is_fine).collect()
}
