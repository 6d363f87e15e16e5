//! What a method in equal steps, splitting or Gauss collocation, costs at the errors of the automatic choice.

use std::time::Duration;

use affine_runtime::capability::InLanes;
use affine_runtime::prelude::*;
use affine_runtime::report::WorkPrecision;

use crate::frontier::least_cost;
use crate::problems::Visitor;

/// Orders of splitting, all there are.
const ORDERS: [usize; 4] = [2, 4, 6, 8];
/// Numbers of stages of Gauss collocation, all there are.
const STAGES: [usize; 4] = [2, 3, 4, 6];
/// A method that needs more evaluations than this many times those of the automatic choice at its finest is out.
const HOPELESS: u64 = 16;
/// The error from which on rounding ends what shorter steps gain.
const NEAR_ROUNDING: f64 = 1e-11;

/// One problem.
pub(crate) struct Motion<'a, M: InLanes<3>> {
    pub(crate) model: &'a M,
    pub(crate) ends: [M::Point<f64>; 2],
    pub(crate) t_end: f64,
    /// Timed repeats, and the time after which no further one begins.
    pub(crate) repeats: (usize, Duration),
}

/// A method over its tolerances or lengths of steps.
pub(crate) struct Curve {
    pub(crate) name: String,
    /// Error of `phi` and evaluations.
    pub(crate) evaluations: Vec<(f64, f64)>,
    /// Error of `phi` and seconds.
    pub(crate) seconds: Vec<(f64, f64)>,
}

impl<M: InLanes<3>> Motion<'_, M> {
    /// The automatic choice, then splitting of every order, then Gauss collocation of every number of stages.
    ///
    /// # Errors
    /// Those of the runs, but for those that stop on their way, which are left out.
    pub(crate) fn curves(&self) -> affine_runtime::Result<Vec<Curve>> {
        let tolerances = (2..=29).map(|k| 10f64.powf(-0.5 * f64::from(k)));
        let mut automatic = Curve::new("automatic".to_owned());
        for tolerance in tolerances {
            automatic.add(self.measured(Method::Automatic, tolerance)?);
        }
        let most = automatic.evaluations.iter().map(|(_, n)| *n as u64).max().unwrap_or(0) * HOPELESS;
        let mut curves = vec![automatic];
        for order in ORDERS {
            let name = format!("splitting {order}");
            curves.push(self.in_equal_steps(name, most, |step| Method::Splitting { order, step })?);
        }
        for stages in STAGES {
            let name = format!("Gauss {}", 2 * stages);
            curves.push(self.in_equal_steps(name, most, |step| Method::Gauss { stages, step })?);
        }
        Ok(curves)
    }

    /// From four steps on, each time the square root of 2 as many.
    fn in_equal_steps(
        &self,
        name: String,
        most: u64,
        method: impl Fn(f64) -> Method,
    ) -> affine_runtime::Result<Curve> {
        let mut curve = Curve::new(name);
        let (mut least, mut idle) = (f64::INFINITY, 0);
        for k in 4.. {
            let steps = 2f64.powf(0.5 * f64::from(k)).round();
            let measured = self.measured(method(self.t_end / steps), 1e-9)?;
            curve.add(measured);
            let (error, evaluations) = measured.map_or((f64::INFINITY, steps as u64), |m| (m.0, m.1));
            idle = if error < least { 0 } else { idle + 1 };
            least = least.min(error);
            if evaluations > most || (least < NEAR_ROUNDING && idle == 2) {
                break;
            }
        }
        Ok(curve)
    }

    /// Error, evaluations and seconds; `None` for a run that stops.
    fn measured(&self, method: Method, tolerance: f64) -> affine_runtime::Result<Option<(f64, u64, f64)>> {
        let ([start, end], (repeats, cap)) = (self.ends, self.repeats);
        let report = WorkPrecision::new(self.model, start, self.t_end)
            .against(end)
            .methods([method])
            .tolerances([tolerance])
            .repeats(repeats)
            .time_cap(cap)
            .run()?;
        let row = report.rows().first();
        Ok(row.and_then(|row| {
            let measured = row.outcome.as_ref().ok()?;
            let error = report.error(row, "phi")?;
            Some((error, measured.statistics.evaluations, measured.run_time.as_secs_f64()))
        }))
    }
}

impl Curve {
    fn new(name: String) -> Self {
        Self { name, evaluations: Vec::new(), seconds: Vec::new() }
    }

    fn add(&mut self, measured: Option<(f64, u64, f64)>) {
        if let Some((error, evaluations, seconds)) = measured {
            self.evaluations.push((error, evaluations as f64));
            self.seconds.push((error, seconds));
        }
    }
}

/// Prints a table of each problem.
pub(crate) struct EqualSteps {
    /// Names of the problems; all if there are none.
    pub(crate) only: Vec<String>,
}

/// Errors of the table: at the last ones of double precision steps of equal length end in rounding.
const LEVELS: [f64; 6] = [1e-3, 1e-6, 1e-9, 1e-11, 1e-12, 1e-13];

impl Visitor for EqualSteps {
    fn visit<M: InLanes<3>>(
        &mut self,
        name: &'static str,
        model: &M,
        ends: [M::Point<f64>; 2],
        t_end: f64,
    ) -> affine_runtime::Result<()> {
        if !self.only.is_empty() && !self.only.iter().any(|asked| asked == name) {
            return Ok(());
        }
        let motion = Motion { model, ends, t_end, repeats: (5, Duration::from_millis(20)) };
        let curves = motion.curves()?;
        println!(
            "{name}: evaluations, and run time over that of the automatic choice, at equal errors of phi"
        );
        print!("{:14}", "");
        LEVELS.iter().for_each(|error| print!("{error:>18.0e}"));
        println!();
        for curve in &curves {
            print!("{:14}", curve.name);
            for error in LEVELS {
                let cost = |runs: &[(f64, f64)]| least_cost(runs, error);
                let time = cost(&curve.seconds).zip(cost(&curves[0].seconds)).map(|(own, least)| own / least);
                match (cost(&curve.evaluations), time) {
                    (Some(evaluations), Some(time)) => print!("{evaluations:>10.0} {time:>7.2}"),
                    (Some(evaluations), None) => print!("{evaluations:>10.0} {:>7}", "alone"),
                    _ => print!("{:>18}", "-"),
                }
            }
            println!();
        }
        println!();
        Ok(())
    }
}
