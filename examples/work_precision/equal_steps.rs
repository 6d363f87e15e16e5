//! What methods in equal steps, splitting and Gauss collocation, cost at the errors of the automatic choice.

use std::hint::black_box;
use std::time::{Duration, Instant};

use affine_integrators::Statistics;
use affine_runtime::capability::InLanes;
use affine_runtime::prelude::*;
use affine_runtime::simulate::Reason;

/// Orders of splitting, all there are.
const ORDERS: [usize; 4] = [2, 4, 6, 8];
/// Numbers of stages of Gauss collocation, all there are.
const STAGES: [usize; 4] = [2, 3, 4, 6];
/// Steps are no longer shortened once two lengths in turn take this many times the evaluations of any automatic run: few steps
/// that are far too long may take many corrections.
const HOPELESS: u64 = 8;
/// The error below which two lengths in turn that gain nothing tell that rounding is reached.
const NEAR_ROUNDING: f64 = 1e-11;

/// A benchmark problem.
pub(crate) struct Motion<'a, M: InLanes<3>> {
    /// The model.
    pub(crate) model: &'a M,
    /// Start, and end by the reference.
    pub(crate) ends: [M::Point<f64>; 2],
    /// Time of the end.
    pub(crate) t_end: f64,
    /// Repeats of a run, and the time after which no further one begins.
    pub(crate) repeats: (usize, Duration),
}

/// A method over its tolerances or lengths of steps.
pub(crate) struct Curve {
    /// What it is called.
    pub(crate) name: String,
    /// Error of `phi`, and evaluations, or what Taylor series are worth of them.
    pub(crate) evaluations: Vec<(f64, f64)>,
    /// The most evaluations that were counted, without Taylor series.
    most_counted: u64,
    /// Error of `phi`, and seconds.
    pub(crate) seconds: Vec<(f64, f64)>,
}

/// Error of `phi`, cost, and seconds.
type Measured = (f64, Statistics, f64);

/// The methods on one problem.
pub(crate) struct Curves {
    /// [`Method::Automatic`].
    pub(crate) automatic: Curve,
    /// Every order.
    pub(crate) splitting: Vec<Curve>,
    /// Every number of stages.
    pub(crate) gauss: Vec<Curve>,
}

impl<M: InLanes<3>> Motion<'_, M> {
    /// Every method.
    ///
    /// # Errors
    /// Those of settings. A run that stops on its way is left out.
    pub(crate) fn curves(&self) -> affine_runtime::Result<Curves> {
        let automatic = self.over_tolerances("automatic", Method::Automatic)?;
        let most = HOPELESS * automatic.most_counted;
        let mut splitting = Vec::new();
        for order in ORDERS {
            let name = format!("splitting {order}");
            splitting.push(self.over_steps(name, most, |step| Method::Splitting { order, step })?);
        }
        let mut gauss = Vec::new();
        for stages in STAGES {
            let name = format!("Gauss {}", 2 * stages);
            gauss.push(self.over_steps(name, most, |step| Method::Gauss { stages, step })?);
        }
        Ok(Curves { automatic, splitting, gauss })
    }

    /// A method over tolerances, two for each power of ten.
    ///
    /// # Errors
    /// Those of settings.
    pub(crate) fn over_tolerances(&self, name: &str, method: Method) -> affine_runtime::Result<Curve> {
        let mut curve = Curve::new(name.to_owned());
        for k in 2..=29 {
            curve.add(self.measured(method, 10f64.powf(-0.5 * f64::from(k)))?);
        }
        Ok(curve)
    }

    /// From four steps on, each time the square root of 2 as many.
    fn over_steps(
        &self,
        name: String,
        most: u64,
        method: impl Fn(f64) -> Method,
    ) -> affine_runtime::Result<Curve> {
        let mut curve = Curve::new(name);
        let (mut least, mut idle, mut costly) = (f64::INFINITY, 0, 0);
        for k in 4.. {
            let steps = 2f64.powf(0.5 * f64::from(k)).round();
            let measured = self.measured(method(self.t_end / steps), 1e-9)?;
            curve.add(measured);
            let (error, evaluations) =
                measured.map_or((f64::INFINITY, steps as u64), |(e, cost, _)| (e, cost.evaluations));
            idle = if error < least { 0 } else { idle + 1 };
            least = least.min(error);
            costly = if evaluations > most { costly + 1 } else { 0 };
            if costly == 2 || (least < NEAR_ROUNDING && idle == 2) {
                break;
            }
        }
        Ok(curve)
    }

    /// Error, cost and seconds, the median of the repeats; `None` for a run that stops.
    fn measured(&self, method: Method, tolerance: f64) -> affine_runtime::Result<Option<Measured>> {
        let ([start, exact], (repeats, cap)) = (self.ends, self.repeats);
        let (mut seconds, mut found, begun) = (Vec::new(), None, Instant::now());
        while seconds.is_empty() || (seconds.len() < repeats && begun.elapsed() < cap) {
            let simulation = Simulation::new(self.model, start).until(self.t_end).output([self.t_end]);
            let now = Instant::now();
            let run = black_box(simulation.method(method).tolerance(tolerance).run());
            seconds.push(now.elapsed().as_secs_f64());
            match run {
                Ok(run) => {
                    let error = (run.end().1.phi() - exact.phi()).norm() / exact.phi().norm();
                    found = Some((error, run.statistics()));
                }
                Err(halt) if matches!(halt.stop.reason, Reason::Setting(_)) => return Err(halt.into()),
                Err(_) => return Ok(None),
            }
        }
        seconds.sort_by(f64::total_cmp);
        Ok(found.map(|(error, cost)| (error, cost, seconds[seconds.len() / 2])))
    }
}

impl Curve {
    fn new(name: String) -> Self {
        Self { name, evaluations: Vec::new(), most_counted: 0, seconds: Vec::new() }
    }

    fn add(&mut self, measured: Option<Measured>) {
        if let Some((error, cost, seconds)) = measured {
            self.evaluations.push((error, cost.equivalent_evaluations() as f64));
            self.most_counted = self.most_counted.max(cost.evaluations);
            self.seconds.push((error, seconds));
        }
    }
}
