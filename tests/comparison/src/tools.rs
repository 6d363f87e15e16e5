//! Other integrators on the right-hand sides written by hand, timed in the same run.

use std::time::{Duration, Instant};

use differential_equations::methods::ExplicitRungeKutta;
use differential_equations::prelude::{IVP, ODE};
use nalgebra::{Matrix3, SVector};
use ode_solvers::dop_shared::OutputType;
use ode_solvers::{Dop853, System};

use crate::by_hand::matrix;

/// What is integrated, and what `phi` should be in the end.
pub(crate) struct Problem<const D: usize> {
    pub(crate) start: SVector<f64, D>,
    pub(crate) t_end: f64,
    /// Where `phi` begins in the state.
    pub(crate) phi_at: usize,
    pub(crate) end: Matrix3<f64>,
}

/// One run.
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
    ) -> Vec<(&'static str, Vec<Measured>)> {
        vec![
            ("ode_solvers DOP853", self.sweep(|tolerance| self.dop853(system(), tolerance))),
            ("differential-equations RKV 9(8)", self.sweep(|tolerance| self.verner(system(), tolerance))),
        ]
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

    fn sweep(&self, run: impl Fn(f64) -> Reached<D>) -> Vec<Measured> {
        let measured = |k: i32| {
            let tolerance = 10f64.powf(-0.5 * f64::from(k));
            let (reached, evaluations) = run(tolerance)?;
            let error = (matrix(reached.as_slice(), self.phi_at) - self.end).norm() / self.end.norm();
            let time = median_time(|| {
                std::hint::black_box(run(tolerance));
            });
            Some(Measured { tolerance, error, evaluations, time })
        };
        (4..=29).filter_map(measured).collect()
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

/// Median of up to 15 repeats, fewer where they take long.
fn median_time(run: impl Fn()) -> Duration {
    let begun = Instant::now();
    let mut times = Vec::new();
    while times.len() < 15 && (times.is_empty() || begun.elapsed() < Duration::from_millis(150)) {
        let now = Instant::now();
        run();
        times.push(now.elapsed());
    }
    times.sort_unstable();
    times[times.len() / 2]
}
