//! Other integrators, timed in the same run: DOP853 in C over generated equations, and two crates on right-hand sides
//! written by hand.

use std::hint::black_box;
use std::time::{Duration, Instant};

use differential_equations::methods::ExplicitRungeKutta;
use differential_equations::prelude::{IVP, ODE};
use nalgebra::{Matrix3, SVector};
use ode_solvers::dop_shared::OutputType;
use ode_solvers::{Dop853, System};

use crate::by_hand::matrix;
use crate::compiled::{Compiled, STATEMENTS};

/// What is integrated, and what `phi` should be in the end.
pub(crate) struct Problem<const D: usize> {
    pub(crate) name: &'static str,
    pub(crate) start: SVector<f64, D>,
    pub(crate) t_end: f64,
    /// Where `phi` begins in the state.
    pub(crate) phi_at: usize,
    pub(crate) end: Matrix3<f64>,
}

/// A tool, and its runs from loose tolerances to tight ones.
pub(crate) type Swept = (&'static str, Vec<Measured>);

/// One run.
#[derive(Clone)]
pub(crate) struct Measured {
    pub(crate) tolerance: f64,
    pub(crate) error: f64,
    pub(crate) evaluations: u64,
    pub(crate) time: Duration,
}

/// State reached, and evaluations.
type Reached<const D: usize> = Option<(SVector<f64, D>, u64)>;

/// More steps than any problem takes.
const MOST_STEPS: u32 = 10_000_000;

impl<const D: usize> Problem<D> {
    /// Every tool at every tolerance.
    pub(crate) fn measure<F: System<f64, SVector<f64, D>>>(
        &self,
        system: impl Fn() -> F,
        compiled: Option<&mut Compiled>,
    ) -> Vec<Swept> {
        let mut tools = Vec::new();
        if let Some(compiled) = compiled {
            for (tool, name) in STATEMENTS {
                tools.push((name, sweep(|tolerance| self.compiled(compiled, tool, tolerance))));
            }
        }
        tools.push((
            "ode_solvers DOP853",
            sweep(|tolerance| self.timed(tolerance, || self.dop853(system(), tolerance))),
        ));
        tools.push((
            "differential-equations RKV 9(8)",
            sweep(|tolerance| self.timed(tolerance, || self.verner(system(), tolerance))),
        ));
        tools
    }

    fn compiled(&self, compiled: &mut Compiled, tool: &str, tolerance: f64) -> Option<Measured> {
        let settings = [tolerance, self.t_end, BURST.as_secs_f64()];
        let run = compiled.run(tool, self.name, settings, self.start.as_slice())?;
        let (error, time) = (self.error(&run.end), run.time);
        Some(Measured { tolerance, error, evaluations: run.evaluations, time })
    }

    fn timed(&self, tolerance: f64, run: impl Fn() -> Reached<D>) -> Option<Measured> {
        let (time, reached) = least_time(run);
        let (end, evaluations) = reached?;
        Some(Measured { tolerance, error: self.error(end.as_slice()), evaluations, time })
    }

    fn error(&self, end: &[f64]) -> f64 {
        (matrix(end, self.phi_at) - self.end).norm() / self.end.norm()
    }

    fn dop853(&self, system: impl System<f64, SVector<f64, D>>, tolerance: f64) -> Reached<D> {
        let mut solver = Dop853::from_param(
            system,
            0.0,
            self.t_end,
            self.t_end,
            self.start,
            tolerance,
            tolerance,
            0.9,
            0.0,
            0.333,
            6.0,
            self.t_end,
            0.0,
            MOST_STEPS,
            u32::MAX,
            OutputType::Sparse,
        );
        let evaluations = solver.integrate().ok()?.num_eval;
        Some((*solver.y_out().last()?, u64::from(evaluations)))
    }

    /// Verner's efficient pair of orders 9 and 8.
    fn verner(&self, system: impl System<f64, SVector<f64, D>>, tolerance: f64) -> Reached<D> {
        let start: [f64; D] = self.start.into();
        let method =
            ExplicitRungeKutta::rkv988e().rtol(tolerance).atol(tolerance).max_steps(MOST_STEPS as usize);
        let solution = IVP::ode(&InArrays(system), 0.0, self.t_end, start)
            .method(method)
            .t_eval([self.t_end])
            .solve()
            .ok()?;
        Some((SVector::from(*solution.y.last()?), solution.evals.function as u64))
    }
}

/// A system over plain arrays.
struct InArrays<F>(F);

impl<const D: usize, F: System<f64, SVector<f64, D>>> ODE<f64, [f64; D]> for InArrays<F> {
    fn diff(&self, t: f64, y: &[f64; D], dydt: &mut [f64; D]) {
        let mut rate = SVector::zeros();
        self.0.system(t, &SVector::from(*y), &mut rate);
        *dydt = rate.into();
    }
}

/// Runs at two tolerances for each power of ten.
pub(crate) fn sweep(run: impl FnMut(f64) -> Option<Measured>) -> Vec<Measured> {
    (2..=29).map(|k| 10f64.powf(-0.5 * f64::from(k))).filter_map(run).collect()
}

/// As long as one run is repeated.
const BURST: Duration = Duration::from_millis(6);

/// The least time of runs within a burst, as the program in C measures it, and what came out.
pub(crate) fn least_time<T>(run: impl Fn() -> T) -> (Duration, T) {
    let begun = Instant::now();
    let mut least = Duration::MAX;
    loop {
        let now = Instant::now();
        let reached = black_box(run());
        least = least.min(now.elapsed());
        if begun.elapsed() >= BURST {
            return (least, reached);
        }
    }
}

/// Of interleaved rounds of the same runs, the median time of each run.
pub(crate) fn medians(mut rounds: Vec<Vec<Swept>>) -> Vec<Swept> {
    let mut tools = rounds.pop().unwrap_or_default();
    for (which, (_, runs)) in tools.iter_mut().enumerate() {
        for run in runs {
            let same = |round: &Vec<Swept>| {
                round
                    .get(which)?
                    .1
                    .iter()
                    .find(|other| other.tolerance == run.tolerance)
                    .map(|other| other.time)
            };
            let mut times: Vec<Duration> = rounds.iter().filter_map(same).chain([run.time]).collect();
            times.sort_unstable();
            run.time = times[times.len() / 2];
        }
    }
    tools
}
