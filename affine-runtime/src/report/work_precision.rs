//! Measuring error against run time.

use std::time::{Duration, Instant};

use super::diagram::WorkPrecisionDiagram;
use super::local_error::share_above;
use super::reference::reference_solution;
use super::{method_name, save};
use crate::error::Result;
use crate::inner::norm;
use crate::integrate::Statistics;
use crate::integrate::splitting::Pieces;
use crate::model::{Conserved, Group, Model};
use crate::simulate::{Halt, Method, Reason, Simulation, Stop, Trajectory};

/// Tolerances of a report that names none.
const DEFAULT_TOLERANCES: [f64; 7] = [1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-13, 1e-14];
/// Time for which a run is repeated before it is timed: short ones are else timed while the processor wakes.
const WARM_UP: Duration = Duration::from_millis(1);
/// Timed repeats of each run unless said otherwise.
const DEFAULT_REPEATS: usize = 15;
/// No further repeat begins once the repeats of a run have taken this long, unless said otherwise.
const DEFAULT_TIME_CAP: Duration = Duration::from_secs(2);

/// What a run gives.
type Attempt<const N: usize, P> = core::result::Result<Trajectory<N, P>, Halt<N, P>>;

/// A comparison of methods and tolerances on one problem, to be run: model, start and time interval.
///
/// ```
/// use affine_runtime::report::WorkPrecision;
/// use affine_runtime::{Method, Model, Result};
///
/// fn compare<M: Model<3>>(model: &M, start: M::Point<f64>, exact_end: M::Point<f64>) -> Result<()> {
///     let report = WorkPrecision::new(model, start, 10.0)
///         .methods([Method::RungeKutta8])
///         .tolerances([1e-6, 1e-9, 1e-12])
///         .against(exact_end)
///         .run()?;
///     println!("{report}");
///     report.save_csv("precision.csv")?;
///     report.save_svg("precision.svg")
/// }
/// ```
///
/// What is measured, and how, is in the [module's description](super).
#[derive(Debug)]
pub struct WorkPrecision<'a, const N: usize, M: Model<N>> {
    model: &'a M,
    start: M::Point<f64>,
    t0: f64,
    t_end: f64,
    methods: Vec<Method>,
    tolerances: Vec<f64>,
    reference: Option<M::Point<f64>>,
    repeats: usize,
    time_cap: Duration,
}

impl<'a, const N: usize, M: Model<N>> WorkPrecision<'a, N, M> {
    /// A comparison on the motion of `model` from the phase point `start` at time 0 to `t_end`, of
    /// [`Method::RungeKutta8`] at seven tolerances from 1e-3 to 1e-14, of [`Method::RungeKuttaNystrom8`],
    /// [`Method::RungeKuttaNystrom12`] and [`Method::Taylor`] where they were emitted, of [`Method::AdaptiveSplitting`] where a
    /// dilatation has a closed form in what was emitted and, where there is one, of the closed form.
    #[must_use]
    pub fn new(model: &'a M, start: M::Point<f64>, t_end: f64) -> Self {
        Self {
            model,
            start,
            t0: 0.0,
            t_end,
            methods: Vec::new(),
            tolerances: DEFAULT_TOLERANCES.to_vec(),
            reference: None,
            repeats: DEFAULT_REPEATS,
            time_cap: DEFAULT_TIME_CAP,
        }
    }

    /// Time of the start; 0 if not set.
    #[must_use]
    pub fn from(self, t0: f64) -> Self {
        Self { t0, ..self }
    }

    /// The methods, in this order. A closed form has no tolerance and gives one row, and so does a method whose
    /// accuracy is its step: list it once for each step.
    #[must_use]
    pub fn methods(self, methods: impl IntoIterator<Item = Method>) -> Self {
        Self { methods: methods.into_iter().collect(), ..self }
    }

    /// The tolerances, in this order, for each method.
    #[must_use]
    pub fn tolerances(self, tolerances: impl IntoIterator<Item = f64>) -> Self {
        Self { tolerances: tolerances.into_iter().collect(), ..self }
    }

    /// The reference: the phase point at `t_end`, known better than any row will be. Without one, it is the
    /// closed form of the model where that exists, else the [`reference_solution`].
    #[must_use]
    pub fn against(self, exact_end: M::Point<f64>) -> Self {
        Self { reference: Some(exact_end), ..self }
    }

    /// The reference from a solution as a function of time.
    #[must_use]
    pub fn against_solution(self, exact: impl FnOnce(f64) -> M::Point<f64>) -> Self {
        let t_end = self.t_end;
        self.against(exact(t_end))
    }

    /// Number of timed repeats of each run, at least 1; 15 if not set.
    #[must_use]
    pub fn repeats(self, repeats: usize) -> Self {
        Self { repeats: repeats.max(1), ..self }
    }

    /// No further repeat of a run begins once its repeats have taken this long; 2 seconds if not set.
    /// One repeat is always timed.
    #[must_use]
    pub fn time_cap(self, time_cap: Duration) -> Self {
        Self { time_cap, ..self }
    }

    /// Measures every row. A run that stops gives a row that says so.
    ///
    /// # Errors
    /// [`Error::NoReference`](crate::Error::NoReference) where none was given, there is no closed form and the [`reference_solution`] does not
    /// reach the end;
    /// [`Error::Stopped`](crate::Error::Stopped) with [`Reason::Setting`] where a setting makes no sense: a tolerance out of range, times
    /// that are not finite, a method that does not apply.
    pub fn run(&self) -> Result<WorkPrecisionReport> {
        // A reference to a time that is none takes for ever.
        let named = if self.methods.is_empty() { &[Method::RungeKutta8] } else { &self.methods[..] };
        for method in named {
            for tolerance in &self.tolerances {
                self.simulation(*method, *tolerance).checked()?;
            }
        }
        let geodesic = self.model.geodesic(self.t0, &self.start);
        let reference = match (&self.reference, &geodesic) {
            (Some(point), _) => *point,
            (None, Some(geodesic)) => self.model.on_geodesic(geodesic, self.t_end, &self.start),
            (None, None) => reference_solution(self.model, &self.start, (self.t0, self.t_end))?,
        };
        let mut methods = self.methods.clone();
        if methods.is_empty() {
            methods.push(Method::RungeKutta8);
            if M::second_order(self.model).is_some() {
                methods.extend([Method::RungeKuttaNystrom8, Method::RungeKuttaNystrom12]);
            }
            methods.extend(M::taylor(self.model).map(|_| Method::Taylor { order: None }));
            methods.extend(passes_over_stiffness(M::splitting(self.model)));
            methods.extend(geodesic.map(|_| Method::ClosedForm));
        }
        let mut rows = Vec::new();
        for method in methods {
            for &tolerance in &self.tolerances {
                let row = self.row(method, tolerance, &reference)?;
                let has_tolerance = row.tolerance.is_some();
                rows.push(row);
                if !has_tolerance {
                    break;
                }
            }
        }
        let quantities = M::DESCRIPTION.full.iter().map(Group::name).collect();
        let interval = (self.t0, self.t_end);
        Ok(WorkPrecisionReport { model: M::DESCRIPTION.name, quantities, interval, rows })
    }

    fn row(&self, method: Method, tolerance: f64, reference: &M::Point<f64>) -> Result<Row> {
        // The run that is looked at is not timed: it fills the caches and wakes the processor, where it is short by repeats.
        let begun = Instant::now();
        let run = match self.attempt(method, tolerance) {
            Ok(run) => run,
            Err(halt) if matches!(halt.stop.reason, Reason::Setting(_)) => return Err(halt.into()),
            Err(halt) => {
                let tolerance = has_tolerance(method).then_some(tolerance);
                return Ok(Row { method, tolerance, outcome: Err(halt.stop) });
            }
        };
        while begun.elapsed() < WARM_UP {
            drop(core::hint::black_box(self.attempt(method, tolerance)));
        }
        let method = run.computation().method;
        let times = self.times(method, tolerance);
        let above_tolerance = self.above_tolerance(method, tolerance);
        let measurement = Measurement {
            errors: self.errors(run.end().1, reference),
            statistics: run.statistics(),
            run_time: median(times.clone()),
            repeats: times.len(),
            energy_drift: run.conservation().of(Conserved::Energy).map(|drift| drift.relative()),
            above_tolerance,
        };
        let tolerance = has_tolerance(method).then_some(tolerance);
        Ok(Row { method, tolerance, outcome: Ok(measurement) })
    }

    /// From start to end, without output on the way.
    fn attempt(&self, method: Method, tolerance: f64) -> Attempt<N, M::Point<f64>> {
        self.simulation(method, tolerance).output([self.t_end]).run()
    }

    fn simulation(&self, method: Method, tolerance: f64) -> Simulation<'_, N, M> {
        Simulation::new(self.model, self.start)
            .from(self.t0)
            .until(self.t_end)
            .method(method)
            .tolerance(tolerance)
    }

    fn above_tolerance(&self, method: Method, tolerance: f64) -> Option<f64> {
        if !has_tolerance(method) {
            return None;
        }
        let steps = self.simulation(method, tolerance).run().ok()?;
        share_above(self.model, &steps, tolerance)
    }

    fn times(&self, method: Method, tolerance: f64) -> Vec<Duration> {
        let mut times = Vec::with_capacity(self.repeats);
        let begun = Instant::now();
        loop {
            let now = Instant::now();
            let run = core::hint::black_box(self.attempt(method, tolerance));
            times.push(now.elapsed());
            drop(run);
            if times.len() >= self.repeats || begun.elapsed() >= self.time_cap {
                return times;
            }
        }
    }

    fn errors(&self, end: &M::Point<f64>, reference: &M::Point<f64>) -> Vec<f64> {
        let (end, exact) = (self.model.flatten(end), self.model.flatten(reference));
        let mut offset = 0;
        let groups = M::DESCRIPTION.full.iter().map(|group| {
            let range = offset..offset + group.len;
            offset = range.end;
            relative_error(&end.as_ref()[range.clone()], &exact.as_ref()[range])
        });
        groups.collect()
    }
}

/// Accuracy is set by a tolerance: not by the step, and not exact.
pub(super) fn has_tolerance(method: Method) -> bool {
    !matches!(method, Method::ClosedForm) && method.step().is_none()
}

/// `|a - b|/|b|`, 0 where they agree even in a vanishing reference.
fn relative_error(a: &[f64], b: &[f64]) -> f64 {
    let differences: Vec<f64> = a.iter().zip(b).map(|(a, b)| a - b).collect();
    let distance = norm(&differences);
    if distance == 0.0 { 0.0 } else { distance / norm(b) }
}

/// The middle value, or the mean of the two middle ones.
fn median(mut times: Vec<Duration>) -> Duration {
    times.sort_unstable();
    let middle = times.len() / 2;
    match times.len() {
        0 => Duration::ZERO,
        count if count % 2 == 1 => times[middle],
        _ => (times[middle - 1] + times[middle]) / 2,
    }
}

/// Error against run time, row by row; displays as a table.
#[derive(Clone, Debug, PartialEq)]
pub struct WorkPrecisionReport {
    model: &'static str,
    quantities: Vec<&'static str>,
    interval: (f64, f64),
    rows: Vec<Row>,
}

/// One method at one tolerance.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// The method that ran.
    pub method: Method,
    /// Its tolerance; `None` for a closed form and for fixed steps.
    pub tolerance: Option<f64>,
    /// What was measured, or why the run did not reach its end.
    pub outcome: core::result::Result<Measurement, Stop>,
}

/// What was measured of one method at one tolerance.
#[derive(Clone, Debug, PartialEq)]
pub struct Measurement {
    /// Relative error at the end of each of the report's quantities, `|a - b|/|b|` in the Euclidean (Frobenius)
    /// norm with `b` the reference; infinite where `b` vanishes and `a` does not.
    pub errors: Vec<f64>,
    /// Steps, rejected steps, evaluations and series.
    pub statistics: Statistics,
    /// Median of the repeats.
    pub run_time: Duration,
    /// Repeats that were timed.
    pub repeats: usize,
    /// Relative drift of the energy over the run; `None` where the model does not conserve it.
    pub energy_drift: Option<f64>,
    /// Share of the steps whose true local error exceeds the tolerance, between 0 and 1; `None` where steps follow no
    /// tolerance, or one below 1e-13.
    pub above_tolerance: Option<f64>,
}

/// Splitting in adaptive steps, where one of the pieces has a stiff motion in closed form.
fn passes_over_stiffness<S, C, R: Pieces<S, C>>(pieces: Option<R>) -> Option<Method> {
    pieces.filter(|_| R::DILATES).map(|_| Method::AdaptiveSplitting { order: None })
}

impl Row {
    /// What the method is called in tables and legends.
    #[must_use]
    pub fn name(&self) -> &'static str {
        method_name(self.method)
    }
}

impl WorkPrecisionReport {
    /// Name of the model.
    #[must_use]
    pub fn model(&self) -> &'static str {
        self.model
    }

    /// What errors are measured in: the parts of a phase point as the model stores it, `phi`, the momenta, and
    /// `x` with translation.
    #[must_use]
    pub fn quantities(&self) -> &[&'static str] {
        &self.quantities
    }

    /// Times of start and end.
    #[must_use]
    pub fn interval(&self) -> (f64, f64) {
        self.interval
    }

    /// Rows, method by method.
    #[must_use]
    pub fn rows(&self) -> &[Row] {
        &self.rows
    }

    /// The error of one of the [`quantities`](Self::quantities) in a row; `None` for another name, or a run that
    /// stopped.
    #[must_use]
    pub fn error(&self, row: &Row, quantity: &str) -> Option<f64> {
        let index = self.quantities.iter().position(|name| *name == quantity)?;
        row.outcome.as_ref().ok().and_then(|measured| measured.errors.get(index).copied())
    }

    /// One series per method for a [`WorkPrecisionDiagram`]: its name, and errors of `phi` with run times in seconds. With
    /// `prefix`, say the problem's name, several reports keep apart in one picture.
    #[must_use]
    pub fn series(&self, prefix: &str) -> Vec<(String, Vec<(f64, f64)>)> {
        let mut all: Vec<(String, Vec<(f64, f64)>)> = Vec::new();
        for row in &self.rows {
            let (Some(error), Ok(measured)) = (self.error(row, "phi"), &row.outcome) else { continue };
            let name = format!("{prefix}{}", method_name(row.method));
            let point = (error, measured.run_time.as_secs_f64());
            match all.iter_mut().find(|series| series.0 == name) {
                Some(series) => series.1.push(point),
                None => all.push((name, vec![point])),
            }
        }
        all
    }

    /// The report as a diagram of its own.
    #[must_use]
    pub fn diagram(&self) -> WorkPrecisionDiagram {
        let (_, t_end) = self.interval;
        WorkPrecisionDiagram::new(
            format!("{}: error against run time", self.model),
            format!("relative error of phi at t = {t_end}"),
        )
        .all(self.series(""))
    }

    /// Writes the [`diagram`](Self::diagram) as an SVG document.
    ///
    /// # Errors
    /// [`Error::File`](crate::Error::File) with path and kind of the failure.
    pub fn save_svg(&self, path: impl AsRef<std::path::Path>) -> Result<()> {
        save(path.as_ref(), &self.diagram().to_svg())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_median_is_the_middle() {
        let of = |times: &[u64]| median(times.iter().copied().map(Duration::from_nanos).collect()).as_nanos();
        assert_eq!([of(&[7]), of(&[9, 1, 4]), of(&[8, 2]), of(&[1, 1000, 3, 5])], [7, 4, 5, 4]);
    }

    #[test]
    fn errors_are_relative_to_the_reference() {
        assert_eq!(relative_error(&[3.0, 4.5], &[3.0, 4.0]), 0.1);
        assert_eq!(relative_error(&[0.0, 0.0], &[0.0, 0.0]), 0.0);
        assert_eq!(relative_error(&[0.0, 1e-9], &[0.0, 0.0]), f64::INFINITY);
        assert!(relative_error(&[f64::NAN], &[1.0]).is_nan());
    }
}
