//! What all sweeps share: the models, what a run is asked for, and what must come of it.

use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

use affine_runtime::prelude::*;
use affine_runtime::simulate::{Halt, Reason};

use affine_tests::models::{self, Served};

/// Length of the equal steps where nothing else is asked for.
pub(crate) const STEP: f64 = 0.01;
/// Long for an unoptimised build on a busy machine, short for a hang.
const PATIENCE: Duration = Duration::from_secs(240);

/// A sweep over models, their starts and the methods that serve them.
pub(crate) trait Sweep {
    fn over<const N: usize, M: Model<N>>(&self, model: &M, start: M::Point<f64>, methods: &[Method]);
}

/// Sweeps over all models, whose methods are all there are; whatever hangs fails.
pub(crate) fn sweep(sweep: impl Sweep + Send + 'static) {
    within_patience(move || {
        over(&sweep, models::anchored(STEP));
        over(&sweep, models::vibrating(STEP));
        over(&sweep, models::springs(STEP));
        over(&sweep, models::driven(STEP));
        over(&sweep, models::free(STEP));
        over(&sweep, models::top(STEP));
        over(&sweep, models::droplet(STEP));
    });
}

fn over<const N: usize, M: Model<N>>(sweep: &impl Sweep, served: Served<M, M::Point<f64>>) {
    sweep.over(&served.model, served.start, &served.methods);
}

/// Fails where the work does, and where it does not come to an end.
pub(crate) fn within_patience(work: impl FnOnce() + Send + 'static) {
    let (done, end) = channel();
    let worker = thread::spawn(move || {
        work();
        // Nobody waits any more where patience is at an end.
        let _ = done.send(());
    });
    if end.recv_timeout(PATIENCE) == Err(RecvTimeoutError::Timeout) {
        panic!("hangs");
    }
    if let Err(panic) = worker.join() {
        std::panic::resume_unwind(panic);
    }
}

/// Outputs as asked for.
#[derive(Clone, Debug)]
pub(crate) enum Outputs {
    Steps,
    Every(f64),
    At(Vec<f64>),
}

/// What is asked of a run besides its method.
#[derive(Clone, Debug)]
pub(crate) struct Ask {
    pub(crate) from: f64,
    pub(crate) until: f64,
    pub(crate) tolerance: f64,
    pub(crate) outputs: Outputs,
    pub(crate) max_steps: u64,
}

/// What makes sense.
pub(crate) fn sound() -> Ask {
    Ask { from: 0.0, until: 0.5, tolerance: 1e-9, outputs: Outputs::Steps, max_steps: 1000 }
}

impl Ask {
    pub(crate) fn of<'a, const N: usize, M: Model<N>>(
        &self,
        model: &'a M,
        start: M::Point<f64>,
        method: Method,
    ) -> Simulation<'a, N, M> {
        let simulation = Simulation::new(model, start).from(self.from).until(self.until).method(method);
        let simulation = simulation.tolerance(self.tolerance).max_steps(self.max_steps);
        match &self.outputs {
            Outputs::Steps => simulation,
            Outputs::Every(dt) => simulation.every(*dt),
            Outputs::At(times) => simulation.output(times.iter().copied()),
        }
    }
}

/// Refused before the first step, in these words, with nothing recorded; and what is left can be looked at.
pub(crate) fn refused<const N: usize, M: Model<N>>(
    simulation: Simulation<'_, N, M>,
    words: &[&str],
    label: &str,
) -> Reason {
    let label = format!("{} {label}", M::DESCRIPTION.name);
    let halt = simulation.run().err().unwrap_or_else(|| panic!("{label}: runs"));
    let message = halt.to_string();
    for word in words {
        assert!(message.contains(word), "{label}: `{word}` is not in `{message}`");
    }
    assert!(halt.trajectory.is_empty() && halt.stop.steps == 0, "{label}: {message}");
    looked_at(&halt);
    halt.stop.reason
}

/// Stops on its way, with a last good state, whose time is that of the stop.
pub(crate) fn stops<const N: usize, M: Model<N>>(
    simulation: Simulation<'_, N, M>,
    label: &str,
) -> Halt<N, M::Point<f64>> {
    let label = format!("{} {label}", M::DESCRIPTION.name);
    let halt = simulation.run().err().unwrap_or_else(|| panic!("{label}: runs"));
    let (t, point) = halt.trajectory.end();
    assert!(t.is_finite() && t == halt.stop.t, "{label}: {halt}");
    assert!(point.is_finite() && determinant(point.phi()) > 0.0, "{label}: {halt}");
    looked_at(&halt);
    halt
}

/// By the first row.
fn determinant<const N: usize>(phi: &Matrix<N>) -> f64 {
    match N {
        2 => phi[(0, 0)] * phi[(1, 1)] - phi[(0, 1)] * phi[(1, 0)],
        3 => {
            let minor = |a: usize, b: usize| phi[(1, a)] * phi[(2, b)] - phi[(1, b)] * phi[(2, a)];
            phi[(0, 0)] * minor(1, 2) - phi[(0, 1)] * minor(0, 2) + phi[(0, 2)] * minor(0, 1)
        }
        _ => panic!("n = {N}"),
    }
}

/// Comes to the end that was asked for, at times in order.
pub(crate) fn arrives<const N: usize, M: Model<N>>(
    simulation: Simulation<'_, N, M>,
    until: f64,
    label: &str,
) -> Trajectory<N, M::Point<f64>> {
    let label = format!("{} {label}", M::DESCRIPTION.name);
    let run = simulation.run().unwrap_or_else(|halt| panic!("{label}: {halt}"));
    assert_eq!(run.end().0.to_bits(), until.to_bits(), "{label}");
    let direction = (until - run.start().0).signum();
    assert!(run.times().windows(2).all(|w| (w[1] - w[0]) * direction > 0.0), "{label}: {:?}", run.times());
    run
}

/// Reports and files of a run that has nothing in it.
fn looked_at<const N: usize, P: Phase<N>>(halt: &Halt<N, P>) {
    let run = &halt.trajectory;
    assert!(!run.why().to_string().is_empty());
    let _ = (run.conservation().to_string(), run.power_balance());
    run.csv(Vec::new()).unwrap();
    run.events_csv(Vec::new()).unwrap();
}
