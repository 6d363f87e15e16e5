//! Error against run time of this project beside ode_solvers' DOP853 and the Verner pair of orders 9 and 8 of
//! differential-equations, with right-hand sides written by hand over nalgebra, problem by problem in one run; and the
//! ratio of the run time to the least of theirs at equal errors, of the best method, of the automatic choice, of splitting
//! and of Gauss collocation.
//!
//! `cargo run --release -p affine-comparison [P1 P2 ...] [--peers FILE]`. A file has results of other tools, measured
//! elsewhere: they go into the pictures, not into the ratios.
//!
//! `cargo run --release -p affine-comparison rhs`: times of single evaluations instead, beside those written by hand.

mod by_hand;
#[path = "../../../examples/work_precision/equal_steps.rs"]
mod equal_steps;
#[cfg(test)]
#[allow(clippy::unwrap_used, clippy::expect_used)]
mod evaluations;
#[path = "../../../examples/work_precision/frontier.rs"]
mod frontier;
mod peers;
#[path = "../../../examples/work_precision/problems.rs"]
mod problems;
mod right_hand_sides;
mod timing;
mod tools;

use std::fs;
use std::time::Duration;

use affine_runtime::capability::InLanes;
use affine_runtime::prelude::*;
use affine_runtime::report::{WorkPrecision, WorkPrecisionDiagram, WorkPrecisionPoint, WorkPrecisionSeries};

use equal_steps::{Curve, Curves, Motion};
use frontier::{ERRORS, front, least_cost};
use peers::Peer;
use problems::Visitor;
use right_hand_sides::RightHandSides;
use tools::Measured;

fn main() -> affine_runtime::Result<()> {
    // A folder that cannot be made shows in the first file that cannot be written.
    let _ = fs::create_dir_all("output");
    let mut only: Vec<String> = std::env::args().skip(1).collect();
    if only.first().is_some_and(|first| first == "rhs") {
        right_hand_sides::print_head();
        return problems::visit(&mut RightHandSides);
    }
    let peers = match peers_of(&mut only) {
        Ok(peers) => peers,
        Err(wrong) => {
            eprintln!("{wrong}");
            return Ok(());
        }
    };
    let mut comparison = Comparison { only, peers, rows: Vec::new(), csv: CSV_HEAD.to_owned() };
    problems::visit(&mut comparison)?;
    println!(
        "run time over the least of DOP853 and RKV 9(8) at equal errors of phi, the best method and tolerance for each; below it \
         Method::Automatic, and the best of splitting and of Gauss collocation:\n"
    );
    print!("{:14}", "problem");
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

/// Takes `--peers FILE` out of the arguments.
fn peers_of(arguments: &mut Vec<String>) -> Result<Vec<Peer>, String> {
    let Some(at) = arguments.iter().position(|argument| argument == "--peers") else { return Ok(Vec::new()) };
    let path = arguments.get(at + 1).cloned().ok_or("--peers wants a file")?;
    arguments.drain(at..at + 2);
    let text = fs::read_to_string(&path).map_err(|error| format!("{path}: {error}"))?;
    peers::read(&text).map_err(|wrong| format!("{path}: {wrong}"))
}

const CSV_HEAD: &str = "tool,problem,tolerance,error_phi,evaluations,microseconds\n";

struct Comparison {
    /// Names of the problems to run; all if there are none.
    only: Vec<String>,
    /// Results from elsewhere.
    peers: Vec<Peer>,
    rows: Vec<String>,
    csv: String,
}

impl Visitor for Comparison {
    fn visit<M: InLanes<3>>(
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
            ours.push((error, measured.run_time.as_secs_f64()));
            self.record(
                &format!("affine {}", row.name()),
                name,
                row.tolerance,
                error,
                measured.statistics.equivalent_evaluations(),
                measured.run_time,
            );
        }
        let theirs = by_hand::measure(name, nalgebra::Matrix3::from(<[[f64; 3]; 3]>::from(*end.phi())));
        for (tool, runs) in &theirs {
            for run in runs {
                self.record(tool, name, Some(run.tolerance), run.error, run.evaluations, run.time);
            }
        }
        let runs = theirs.iter().flat_map(|(_, runs)| runs);
        let pairs: Vec<(f64, f64)> = runs.map(|run| (run.error, run.time.as_secs_f64())).collect();
        self.rows.push(ratios(name, &ours, &pairs));
        let motion = Motion { model, ends: [start, end], t_end, repeats: (7, Duration::from_millis(20)) };
        let Curves { automatic, splitting, gauss } = motion.curves()?;
        for (method, curves) in [("automatic", vec![automatic]), ("splitting", splitting), ("Gauss", gauss)] {
            let runs: Vec<(f64, f64)> = curves.iter().flat_map(|curve| curve.seconds.clone()).collect();
            self.rows.push(ratios(&format!("  {method}"), &runs, &pairs));
            curves.iter().for_each(|curve| self.record_curve(name, curve));
        }
        let diagram = WorkPrecisionDiagram::new(
            format!("{name}: error against run time"),
            format!("relative error of phi at t = {t_end}"),
        )
        .all(report.series("affine, "))
        .all(theirs.iter().map(|(tool, runs)| series(tool, runs)))
        .all(self.elsewhere(name));
        let stem = name.replace(' ', "_").to_lowercase();
        diagram.save_svg(format!("output/comparison_{stem}.svg"))
    }
}

impl Comparison {
    /// What other tools reached on a problem, one series each: repeats and settings that others of the tool beat left
    /// out.
    fn elsewhere(&self, problem: &str) -> Vec<WorkPrecisionSeries> {
        let mut tools: Vec<(&str, Vec<(f64, f64)>)> = Vec::new();
        for peer in self.peers.iter().filter(|peer| peer.problem.replace('_', " ") == problem) {
            match tools.iter_mut().find(|(tool, _)| *tool == peer.tool) {
                Some((_, runs)) => runs.push((peer.error, peer.time.as_secs_f64())),
                None => tools.push((&peer.tool, vec![(peer.error, peer.time.as_secs_f64())])),
            }
        }
        let series = |(tool, runs): (&str, Vec<_>)| {
            let points =
                front(&runs).into_iter().map(|(error, seconds)| WorkPrecisionPoint { error, seconds });
            WorkPrecisionSeries { name: tool.to_owned(), points: points.collect() }
        };
        tools.into_iter().map(series).collect()
    }

    fn record_curve(&mut self, problem: &str, curve: &Curve) {
        for ((error, evaluations), (_, seconds)) in curve.evaluations.iter().zip(&curve.seconds) {
            let (tool, time) = (format!("affine {}", curve.name), Duration::from_secs_f64(*seconds));
            self.record(&tool, problem, None, *error, *evaluations as u64, time);
        }
    }

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

fn series(tool: &str, runs: &[Measured]) -> WorkPrecisionSeries {
    let point = |run: &Measured| WorkPrecisionPoint { error: run.error, seconds: run.time.as_secs_f64() };
    WorkPrecisionSeries { name: format!("{tool}, by hand"), points: runs.iter().map(point).collect() }
}

fn ratios(name: &str, ours: &[(f64, f64)], theirs: &[(f64, f64)]) -> String {
    let mut row = format!("{name:14}");
    for error in ERRORS {
        row += &match (least_cost(ours, error), least_cost(theirs, error)) {
            (Some(ours), Some(theirs)) => format!("{:>10.4}", ours / theirs),
            (Some(_), None) => format!("{:>10}", "only us"),
            _ => format!("{:>10}", "-"),
        };
    }
    row
}
