//! Error against run time of this project beside ode_solvers' DOP853 with right-hand sides written by hand over
//! nalgebra, problem by problem in one run; and the ratio of the two run times at equal errors.
//! With the argument `rhs`, the times of single evaluations instead.

mod by_hand;
mod frontier;
#[path = "../../../examples/work_precision/problems.rs"]
mod problems;
mod right_hand_sides;
mod timing;

use std::fs;
use std::time::Duration;

use affine_runtime::prelude::*;
use affine_runtime::report::{Series, WorkPrecision, WorkPrecisionDiagram, WorkPrecisionPoint};

use by_hand::Measured;
use frontier::{ERRORS, least_time};
use problems::Visitor;
use right_hand_sides::RightHandSides;

fn main() -> affine_runtime::Result<()> {
    // A folder that cannot be made shows in the first file that cannot be written.
    let _ = fs::create_dir_all("output");
    if std::env::args().nth(1).as_deref() == Some("rhs") {
        right_hand_sides::print_head();
        return problems::visit(&mut RightHandSides);
    }
    let mut comparison =
        Comparison { only: std::env::args().skip(1).collect(), rows: Vec::new(), csv: CSV_HEAD.to_owned() };
    problems::visit(&mut comparison)?;
    println!(
        "run time over that of DOP853 at equal errors of phi, the best method and tolerance for each:\n"
    );
    print!("{:10}", "problem");
    ERRORS.iter().for_each(|error| print!("{error:>10.0e}"));
    println!();
    for row in &comparison.rows {
        println!("{row}");
    }
    let path = "output/comparison.csv";
    match fs::write(path, comparison.csv) {
        Ok(()) => println!("\nwritten: {path} and a picture of each problem"),
        Err(error) => println!("\nnot written: {path}: {error}"),
    }
    Ok(())
}

const CSV_HEAD: &str = "tool,problem,tolerance,error_phi,evaluations,microseconds\n";

struct Comparison {
    /// Names of the problems to run; all if there are none.
    only: Vec<String>,
    rows: Vec<String>,
    csv: String,
}

impl Visitor for Comparison {
    fn visit<M: Model<3>>(
        &mut self,
        name: &'static str,
        model: &M,
        [start, end]: [M::Point<f64>; 2],
        t_end: f64,
    ) -> affine_runtime::Result<()> {
        if !self.only.is_empty() && !self.only.iter().any(|asked| asked == name) {
            return Ok(());
        }
        let tolerances: Vec<f64> = (2..=29).map(|k| 10f64.powf(-0.5 * f64::from(k))).collect();
        let report = WorkPrecision::new(model, start, t_end)
            .against(end)
            .tolerances(tolerances)
            .repeats(15)
            .time_cap(Duration::from_millis(150))
            .run()?;
        let mut ours = Vec::new();
        for row in report.rows() {
            let (Some(error), Ok(measured)) = (report.error(row, "phi"), &row.outcome) else { continue };
            ours.push((error, measured.run_time));
            self.record(
                "affine",
                name,
                row.tolerance,
                error,
                measured.statistics.evaluations,
                measured.run_time,
            );
        }
        let theirs = by_hand::measure(name, &end.phi().transpose().into());
        for run in &theirs {
            self.record(
                "ode_solvers_dop853",
                name,
                Some(run.tolerance),
                run.error,
                run.evaluations,
                run.time,
            );
        }
        let pairs: Vec<(f64, Duration)> = theirs.iter().map(|run| (run.error, run.time)).collect();
        self.rows.push(ratios(name, &ours, &pairs));
        let diagram = WorkPrecisionDiagram::new(
            format!("{name}: error against run time"),
            format!("relative error of phi at t = {t_end}"),
        )
        .all(report.series("affine, "))
        .series(series(&theirs));
        let stem = name.replace(' ', "_").to_lowercase();
        diagram.save_svg(format!("output/comparison_{stem}.svg"))
    }
}

impl Comparison {
    fn record(
        &mut self,
        tool: &str,
        problem: &str,
        tolerance: Option<f64>,
        error: f64,
        evaluations: u64,
        time: Duration,
    ) {
        let tolerance = tolerance.map(|tolerance| format!("{tolerance:e}")).unwrap_or_default();
        let microseconds = time.as_secs_f64() * 1e6;
        self.csv += &format!("{tool},{problem},{tolerance},{error:e},{evaluations},{microseconds:.3}\n");
    }
}

fn series(runs: &[Measured]) -> Series {
    let point = |run: &Measured| WorkPrecisionPoint { error: run.error, seconds: run.time.as_secs_f64() };
    Series { name: "ode_solvers DOP853, by hand".to_owned(), points: runs.iter().map(point).collect() }
}

fn ratios(name: &str, ours: &[(f64, Duration)], theirs: &[(f64, Duration)]) -> String {
    let mut row = format!("{name:10}");
    for error in ERRORS {
        row += &match (least_time(ours, error), least_time(theirs, error)) {
            (Some(ours), Some(theirs)) => format!("{:>10.4}", ours / theirs),
            (Some(_), None) => format!("{:>10}", "only us"),
            _ => format!("{:>10}", "-"),
        };
    }
    row
}
