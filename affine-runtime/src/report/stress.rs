//! The table of stiff and extreme cases, of any model.

mod judge;

use core::fmt;

use self::judge::{Judge, Leg};
use super::method_name;
use super::stability::{Demand, Finding, Oracle, Scene, StabilityReport};
use super::work_precision::has_tolerance;
use crate::error::{Error, Result};
use crate::inner::DEFAULT_MAX_STEPS;
use crate::model::{Conserved, Model, Quantity};
use crate::simulate::{DEFAULT_TOLERANCE, Method, Simulation};

const DEFAULT_TOLERANCES: [f64; 7] = [1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14];
const DEFAULT_SPEEDS: [f64; 4] = [1e-6, 1e-3, 1e3, 1e6];
/// A long run, in runs.
const LONGER: f64 = 10.0;
/// Tolerances that an error may have, unless said otherwise.
const DEFAULT_WITHIN: f64 = 100.0;
/// Smaller tolerances are held to this one: the run that judges is rounded too, and the motion multiplies that.
const FINEST_JUDGED: f64 = 1e-12;
/// The largest error of an end that is one.
const WORST: f64 = 0.5;

/// What methods make of one model and one start under stress, to be run: a [`StabilityReport`] without an oracle of one's own.
///
/// ```
/// use affine_runtime::report::{StabilityReport, Stress};
/// use affine_runtime::{Model, Result};
///
/// fn stressed<M: Model<3>>(model: &M, start: M::Point<f64>) -> Result<StabilityReport> {
///     let report = Stress::new(model, start).until(10.0).progress(|done, of| eprintln!("{done} of {of}")).run()?;
///     println!("{report}");
///     report.save_csv("stress.csv")?;
///     Ok(report)
/// }
/// ```
///
/// # Cases
/// Every method goes through these, at every tolerance; one that takes equal steps or a closed form goes once:
///
/// - to the end;
/// - the same with momenta times powers of ten, and where they are larger in a time that is shorter by as much;
/// - to ten times the time;
/// - forward and back, where the model conserves its energy: back in time, friction multiplies errors by what it took;
/// - to the end with other [`fields`](Self::fields), where these are given.
///
/// # Verdicts
/// The error is the largest of `|a - b|/max(|b|, |start|)` over the parts of the phase point at the end, `phi`, the momenta
/// and `x`, in the Frobenius norm; that of a run forward and back is
/// [`RoundTrip::worst`](crate::simulate::RoundTrip::worst). `b` is the closed form where there is one and it is not under test,
/// [`Oracle::ClosedForm`], else a run at 1e-14 by another method of high order, [`Oracle::TighterRun`]: Taylor series where they
/// were emitted, Runge-Kutta 8, Radau of seven stages, or of five.
///
/// - **Held:** an error of at most [`within`](Self::within) tolerances, 100 if not set; ten times as much in a long run; at most
///   0.5 in any. Tolerances below 1e-12 are held to what is asked of 1e-12, for what judges is rounded too. Equal steps, which
///   follow no tolerance, are held to the largest one, and the closed form to the smallest.
/// - **Refused:** the run, or [`prepare`](Self::fields), ended in words, which the table prints.
/// - **Fell short:** a larger error, or one that is no number, or an end that every method that could judge it refuses to go
///   to; the words are those of the first of these.
///
/// A verdict is about the run at its tolerance, not about the method: a motion that doubles an error at every turn falls
/// short of any multiple, and no method is to blame.
pub struct Stress<'a, const N: usize, M: Model<N>> {
    model: &'a M,
    start: M::Point<f64>,
    t0: f64,
    t_end: Option<f64>,
    methods: Vec<Method>,
    tolerances: Vec<f64>,
    speeds: Vec<f64>,
    fields: Vec<(f64, Result<M>)>,
    within: f64,
    max_steps: u64,
    progress: Option<Box<dyn FnMut(usize, usize) + 'a>>,
}

/// What every method goes through: one leg at every tolerance.
struct Trial<'a, const N: usize, M: Model<N>> {
    quantity: &'static str,
    /// The extreme in words; empty for the start as it is.
    extreme: String,
    /// What is demanded, in units of what is demanded to the end.
    allowed: f64,
    /// Where to, or why there is no model.
    judge: core::result::Result<Judge<'a, N, M>, String>,
    /// And back again.
    returns: bool,
}

/// An error, what it is held against and the steps; or words and whether they are a refusal.
type Outcome = core::result::Result<(f64, Oracle, u64), (String, bool)>;

impl<'a, const N: usize, M: Model<N>> Stress<'a, N, M> {
    /// Stress on the motions of `model` from the phase point `start` at time 0: by [`Method::Automatic`],
    /// [`Method::RungeKutta8`], [`Method::Radau`] and whatever follows a tolerance and was emitted for the model, at tolerances
    /// 1e-2, 1e-4, ..., 1e-14, with momenta times 1e-6, 1e-3, 1e3 and 1e6. Methods of equal steps have to be
    /// [named](Self::methods), and so has the baseline, [`Method::RungeKutta5`].
    #[must_use]
    pub fn new(model: &'a M, start: M::Point<f64>) -> Self {
        Self {
            model,
            start,
            t0: 0.0,
            t_end: None,
            methods: methods_of(model),
            tolerances: DEFAULT_TOLERANCES.to_vec(),
            speeds: DEFAULT_SPEEDS.to_vec(),
            fields: Vec::new(),
            within: DEFAULT_WITHIN,
            max_steps: DEFAULT_MAX_STEPS,
            progress: None,
        }
    }

    /// Time of the start; 0 if not set.
    #[must_use]
    pub fn from(self, t0: f64) -> Self {
        Self { t0, ..self }
    }

    /// Time of the end, which has to be set. The long run goes ten times as far.
    #[must_use]
    pub fn until(self, t_end: f64) -> Self {
        Self { t_end: Some(t_end), ..self }
    }

    /// The methods, in this order. One that the model lacks is refused in words.
    #[must_use]
    pub fn methods(self, methods: impl IntoIterator<Item = Method>) -> Self {
        Self { methods: methods.into_iter().collect(), ..self }
    }

    /// The tolerances, in this order, for each method.
    #[must_use]
    pub fn tolerances(self, tolerances: impl IntoIterator<Item = f64>) -> Self {
        Self { tolerances: tolerances.into_iter().collect(), ..self }
    }

    /// What momenta are multiplied by, in this order.
    #[must_use]
    pub fn speeds(self, factors: impl IntoIterator<Item = f64>) -> Self {
        Self { speeds: factors.into_iter().collect(), ..self }
    }

    /// The model with other fields, at each of these factors: `fields([1e-3, 1e3, 1e6], |k| Body { r: 0.1 * k }.prepare())`. Phase
    /// points keep their numbers, so that the start is one of momenta. What `prepare` refuses is a case that is refused.
    #[must_use]
    pub fn fields(self, factors: impl IntoIterator<Item = f64>, model: impl Fn(f64) -> Result<M>) -> Self {
        Self { fields: factors.into_iter().map(|factor| (factor, model(factor))).collect(), ..self }
    }

    /// How many tolerances an error may have at the end; 100 if not set.
    #[must_use]
    pub fn within(self, tolerances: f64) -> Self {
        Self { within: tolerances, ..self }
    }

    /// Largest number of steps of every run; a million if not set.
    #[must_use]
    pub fn max_steps(self, max_steps: u64) -> Self {
        Self { max_steps, ..self }
    }

    /// Called after every case with their number so far and the number of all.
    #[must_use]
    pub fn progress(mut self, callback: impl FnMut(usize, usize) + 'a) -> Self {
        self.progress = Some(Box::new(callback));
        self
    }

    /// Tries every case, under a heading for every method.
    ///
    /// # Errors
    /// [`Error::Stopped`] with [`Reason::Setting`](crate::simulate::Reason::Setting) where times or tolerances make no sense, and with
    /// what is wrong with the start.
    pub fn run(mut self) -> Result<StabilityReport> {
        for &tolerance in &self.tolerances {
            let simulation = Simulation::new(self.model, self.start).from(self.t0).tolerance(tolerance);
            self.t_end.into_iter().fold(simulation, Simulation::until).max_steps(self.max_steps).checked()?;
        }
        let mut progress = self.progress.take();
        let mut trials = self.trials();
        let runs: usize = self.methods.iter().map(|&method| self.tolerances_of(method).len()).sum();
        let (mut done, of) = (0, runs * trials.len());
        let mut report = StabilityReport::new();
        for &method in &self.methods {
            report.heading(method_name(method));
            for trial in &mut trials {
                for &tolerance in self.tolerances_of(method) {
                    let (scene, demand, finding) = self.case(trial, method, tolerance);
                    report.add(scene, demand, finding);
                    done += 1;
                    progress.iter_mut().for_each(|callback| callback(done, of));
                }
            }
        }
        Ok(report)
    }

    /// The tolerances that a method is held to.
    fn tolerances_of(&self, method: Method) -> &[f64] {
        let by = |other: &usize| self.tolerances[*other];
        let all = 0..self.tolerances.len();
        let only = match method {
            _ if has_tolerance(method) => return &self.tolerances,
            Method::ClosedForm => all.min_by(|a, b| by(a).total_cmp(&by(b))),
            _ => all.max_by(|a, b| by(a).total_cmp(&by(b))),
        };
        only.map_or(&[], |only| &self.tolerances[only..=only])
    }

    fn trials(&self) -> Vec<Trial<'_, N, M>> {
        let (t0, t_end) = (self.t0, self.t_end.unwrap_or(self.t0));
        let after = |times: f64| (t0, t0 + times * (t_end - t0));
        let leg = |model, start, interval| {
            Ok(Judge::new(Leg { model, start, interval, max_steps: self.max_steps }))
        };
        let trial =
            |quantity, extreme, judge| Trial { quantity, extreme, allowed: 1.0, judge, returns: false };
        let as_it_is = |interval| leg(self.model, self.start, interval);

        let mut trials = vec![trial("end", String::new(), as_it_is(after(1.0)))];
        trials.extend(self.speeds.iter().map(|&factor| {
            let interval = after(if factor.abs() > 1.0 { 1.0 / factor.abs() } else { 1.0 });
            let judge = leg(self.model, sped_up(self.model, &self.start, factor), interval);
            trial("end at another speed", format!("momenta x {factor:e}"), judge)
        }));
        let long = trial("end of a long run", format!("time x {LONGER}"), as_it_is(after(LONGER)));
        trials.push(Trial { allowed: LONGER, ..long });
        if M::DESCRIPTION.conserved.contains(&Conserved::Energy) {
            let back = trial("start come back to", "forward and back".to_owned(), as_it_is(after(1.0)));
            trials.push(Trial { returns: true, ..back });
        }
        trials.extend(self.fields.iter().map(|(factor, model)| {
            let judge = match model {
                Ok(model) => leg(model, self.start, after(1.0)),
                Err(error) => Err(error.to_string()),
            };
            trial("end with other fields", format!("fields x {factor:e}"), judge)
        }));
        trials
    }

    fn case(&self, trial: &mut Trial<'_, N, M>, method: Method, tolerance: f64) -> (Scene, Demand, Finding) {
        let most = (self.within * tolerance.max(FINEST_JUDGED) * trial.allowed).min(WORST);
        let (oracle, demand, finding) = match trial.outcome(method, tolerance) {
            Ok((error, oracle, steps)) => {
                (oracle, Demand::HeldOrRefused(most), Finding::Ran { error, steps })
            }
            Err((words, true)) => {
                (Oracle::Documentation, Demand::HeldOrRefused(most), Finding::Stopped(words))
            }
            Err((words, false)) => (Oracle::TighterRun, Demand::Held(most), Finding::Stopped(words)),
        };
        let how = match method.step() {
            Some(step) => format!("steps of {step}"),
            None if method == Method::ClosedForm => String::new(),
            None => format!("{tolerance:e}"),
        };
        let parts = [trial.extreme.as_str(), how.as_str()].into_iter().filter(|part| !part.is_empty());
        let scene = parts.collect::<Vec<_>>().join(", ");
        let scene = Scene { model: M::DESCRIPTION.name, n: N, scene, quantity: trial.quantity, oracle };
        (scene, demand, finding)
    }
}

impl<const N: usize, M: Model<N>> Trial<'_, N, M> {
    fn outcome(&mut self, method: Method, tolerance: f64) -> Outcome {
        let judge = self.judge.as_mut().map_err(|words| (words.clone(), true))?;
        let tolerance = if has_tolerance(method) { tolerance } else { DEFAULT_TOLERANCE };
        let simulation = judge.leg.simulation(method, tolerance);
        let refused = |error: Error| (error.to_string(), true);
        if self.returns {
            let trip = simulation.forward_and_back().map_err(|halt| refused(halt.into()))?;
            let steps = trip.forward.statistics().steps + trip.back.statistics().steps;
            return Ok((trip.worst(), Oracle::Invariance, steps));
        }
        let run = simulation.run().map_err(|halt| refused(halt.into()))?;
        let steps = run.statistics().steps;
        match judge.error(run.computation().method, run.end().1) {
            Ok((error, oracle)) => Ok((error, oracle, steps)),
            Err(words) => {
                Err((format!("ran in {steps} steps, to where no other method goes; {words}"), false))
            }
        }
    }
}

impl<const N: usize, M: Model<N>> fmt::Debug for Stress<'_, N, M> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Stress")
            .field("model", &M::DESCRIPTION.name)
            .field("start", &self.start)
            .field("interval", &(self.t0, self.t_end))
            .field("methods", &self.methods)
            .field("tolerances", &self.tolerances)
            .finish_non_exhaustive()
    }
}

/// The methods that follow a tolerance and serve a model, but for the baseline.
fn methods_of<const N: usize, M: Model<N>>(model: &M) -> Vec<Method> {
    let has_halves = M::second_order(model).is_some();
    let serves = [
        (Method::Automatic, true),
        (Method::RungeKutta8, true),
        (Method::Radau { stages: None }, true),
        (Method::Taylor { order: None }, M::taylor(model).is_some()),
        (Method::AdaptiveSplitting { order: None }, M::splitting(model).is_some()),
        (Method::RungeKuttaNystrom12, has_halves),
        (Method::RungeKuttaNystrom8, has_halves),
    ];
    serves.into_iter().filter(|(_, serves)| *serves).map(|(method, _)| method).collect()
}

/// The same placement with all momenta times a factor.
fn sped_up<const N: usize, M: Model<N>>(model: &M, start: &M::Point<f64>, factor: f64) -> M::Point<f64> {
    let mut full = model.flatten(start);
    let mut rest = full.as_mut();
    for group in M::DESCRIPTION.full {
        let (components, behind) = rest.split_at_mut(group.len);
        if is_momentum(group.quantity) {
            components.iter_mut().for_each(|component| *component *= factor);
        }
        rest = behind;
    }
    model.unflatten(&full)
}

/// Is linear in the velocities?
fn is_momentum(quantity: Quantity) -> bool {
    matches!(
        quantity,
        Quantity::LinearMomentum
            | Quantity::ComovingLinearMomentum
            | Quantity::CanonicalMomentum
            | Quantity::AffineSpin
            | Quantity::ComovingAffineSpin
    )
}
