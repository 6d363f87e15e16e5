//! Error against run time of this project beside the fastest other tools, problem by problem in one run, and the ratio of the
//! run time of the automatic choice to the least of theirs at equal errors. Beside it stand:
//!
//! - DOP853 in C, made for each problem: inlined over equations that SymPy and CasADi have taken common subexpressions out of,
//!   compiled by gcc for the processor at hand with `-O3 -march=native -ffast-math`;
//! - ode_solvers' DOP853 and the Verner pair of orders 9 and 8 of differential-equations, with right-hand sides written by
//!   hand over nalgebra.
//!
//! `cargo run --release -p affine-comparison [P1 P2 ...] [--methods] [--peers FILE]`. With `--methods` the best of all methods of
//! this project, splitting and Gauss collocation have rows of their own. A file has results of single bodies by other tools,
//! measured elsewhere, which count as those of this run: they should come from a machine of its kind.
//!
//! `cargo run --release -p affine-comparison rhs`: times of single evaluations instead, beside the generated C.
//!
//! `cargo run --release -p affine-comparison peak`: which share of the arithmetic of one core is reached.
//!
//! `cargo run --release -p affine-comparison one-step P1 1000`: so many runs of one step, for callgrind.

mod by_hand;
mod compiled;
#[path = "../../../examples/work_precision/equal_steps.rs"]
mod equal_steps;
#[cfg(test)]
#[allow(clippy::unwrap_used, clippy::expect_used)]
mod evaluations;
#[path = "../../../examples/work_precision/frontier.rs"]
mod frontier;
mod one_step;
mod peak;
mod peers;
#[path = "../../../examples/work_precision/problems.rs"]
mod problems;
mod right_hand_sides;
mod timing;
mod tools;

use std::fs;
use std::time::Duration;

use affine_runtime::capability::{InLanes, Taylor};
use affine_runtime::prelude::*;
use affine_runtime::report::{WorkPrecision, WorkPrecisionDiagram};

use compiled::Compiled;
use equal_steps::{Curve, Curves, Motion};
use frontier::{ERRORS, front, least_cost};
use peers::Peer;
use problems::Visitor;
use right_hand_sides::RightHandSides;
use tools::{Measured, Swept, least_time, medians, sweep};

/// Interleaved rounds of all tools, of which the median counts.
const ROUNDS: usize = 5;

fn main() -> affine_runtime::Result<()> {
    // A folder that cannot be made shows in the first file that cannot be written.
    let _ = fs::create_dir_all("output");
    let only: Vec<String> = std::env::args().skip(1).collect();
    if let Err(wrong) = compare(only)? {
        eprintln!("{wrong}");
        std::process::exit(1);
    }
    Ok(())
}

/// What went wrong outside of models, in words.
fn compare(mut only: Vec<String>) -> affine_runtime::Result<Result<(), String>> {
    if only.first().is_some_and(|first| first == "peak") {
        peak::print_head();
        return problems::visit(&mut peak::Shares).map(Ok);
    }
    if let [first, of, count] = &*only
        && first == "one-step"
    {
        let Ok(count) = count.parse() else { return Ok(Err(format!("no number of runs: {count}"))) };
        let mut runs = one_step::Runs { of: of.clone(), count, steps: 0 };
        problems::visit(&mut runs)?;
        println!("{count} runs of {of}, {} steps", runs.steps);
        return Ok(Ok(()));
    }
    let compiled = match Compiled::start() {
        Ok(compiled) => compiled,
        Err(wrong) => return Ok(Err(wrong)),
    };
    if only.first().is_some_and(|first| first == "rhs") {
        let Some(compiled) = compiled else {
            return Ok(Err("nothing to compare evaluations with".to_owned()));
        };
        right_hand_sides::print_head();
        return problems::visit(&mut RightHandSides { compiled }).map(Ok);
    }
    let peers = match peers_of(&mut only) {
        Ok(peers) => peers,
        Err(wrong) => return Ok(Err(wrong)),
    };
    let methods = only.iter().any(|argument| argument == "--methods");
    only.retain(|argument| argument != "--methods");
    println!(
        "run time of Method::Automatic over the least of other tools at equal errors of phi, the best tolerance \
         for each; medians of {ROUNDS} interleaved rounds\n"
    );
    print!("{:14}", "problem");
    ERRORS.iter().for_each(|error| print!("{error:>10.0e}"));
    println!();
    let mut comparison = Comparison {
        only,
        all: Vec::new(),
        methods,
        peers,
        compiled,
        fastest: Vec::new(),
        csv: CSV_HEAD.to_owned(),
    };
    problems::visit(&mut comparison)?;
    let Comparison { only, all, .. } = &comparison;
    if let Some(wrong) = only.iter().find(|asked| !all.contains(&asked.as_str())) {
        let all = all.join(", ");
        return Ok(Err(format!(
            "no problem `{wrong}`: there are {all}; `--methods`, `--peers FILE`; or `rhs`"
        )));
    }
    println!("\nleast of other tools, in microseconds\n");
    comparison.fastest.iter().for_each(|row| println!("{row}"));
    let path = "output/comparison.csv";
    match fs::write(path, comparison.csv) {
        Ok(()) => println!("\nwritten: {path} and a picture of each problem"),
        Err(error) => println!("\nnot written: {path}: {error}"),
    }
    Ok(Ok(()))
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
    /// Names of those that there are.
    all: Vec<&'static str>,
    /// Whether other methods of this project are measured as well.
    methods: bool,
    /// Results from elsewhere.
    peers: Vec<Peer>,
    compiled: Option<Compiled>,
    /// Which outside tool is the fastest, and its times, in rows of problems.
    fastest: Vec<String>,
    csv: String,
}

impl Visitor for Comparison {
    fn visit<M: InLanes<3, Point<f64>: Send + Sync> + Taylor<3> + Sync>(
        &mut self,
        name: &'static str,
        model: &M,
        ends: [M::Point<f64>; 2],
        t_end: f64,
    ) -> affine_runtime::Result<()> {
        self.all.push(name);
        if !self.only.is_empty() && !self.only.iter().any(|asked| asked == name) {
            return Ok(());
        }
        let mut measured = self.measure(name, model, ends, t_end);
        for (tool, runs) in &measured {
            for run in runs {
                self.record(tool, name, Some(run.tolerance), run.error, run.evaluations, run.time);
            }
        }
        let mut drawn: Vec<_> = measured.iter().map(|(tool, runs)| series(tool, runs)).collect();
        let elsewhere = self.elsewhere(name);
        let automatic = pairs(&measured.remove(0).1);
        let theirs: Vec<(&str, Vec<(f64, f64)>)> = measured
            .iter()
            .map(|(tool, runs)| (*tool, pairs(runs)))
            .chain(elsewhere.iter().map(|(tool, points)| (&**tool, points.clone())))
            .collect();
        let all: Vec<(f64, f64)> = theirs.iter().flat_map(|(_, runs)| runs.clone()).collect();
        println!("{}", ratios(name, &automatic, &all));
        self.fastest.push(fastest(name, &theirs));
        if self.methods {
            self.measure_methods(name, model, ends, t_end, &all)?;
        }
        drawn.extend(elsewhere);
        let axis = format!("relative error of phi at t = {t_end}");
        let diagram = WorkPrecisionDiagram::new(format!("{name}: error against run time"), axis).all(drawn);
        let stem = name.replace(' ', "_").to_lowercase();
        diagram.save_svg(format!("output/comparison_{stem}.svg"))
    }
}

impl Comparison {
    /// The automatic choice, and all other tools, at all tolerances.
    fn measure<M: InLanes<3>>(
        &mut self,
        name: &'static str,
        model: &M,
        [start, end]: [M::Point<f64>; 2],
        t_end: f64,
    ) -> Vec<Swept> {
        let exact = nalgebra::Matrix3::from(<[[f64; 3]; 3]>::from(*end.phi()));
        let automatic = |tolerance: f64| {
            let (time, run) = least_time(|| {
                Simulation::new(model, start).until(t_end).output([t_end]).tolerance(tolerance).run()
            });
            let run = run.ok()?;
            let error = (run.end().1.phi() - end.phi()).norm() / end.phi().norm();
            Some(Measured { tolerance, error, evaluations: run.statistics().equivalent_evaluations(), time })
        };
        let round = |_| {
            let mut tools = vec![("affine automatic", sweep(automatic))];
            tools.extend(by_hand::measure(name, exact, self.compiled.as_mut()));
            tools
        };
        medians((0..ROUNDS).map(round).collect())
    }

    /// Rows of the best of all methods, splitting and Gauss collocation.
    fn measure_methods<M: InLanes<3>>(
        &mut self,
        name: &'static str,
        model: &M,
        ends: [M::Point<f64>; 2],
        t_end: f64,
        theirs: &[(f64, f64)],
    ) -> affine_runtime::Result<()> {
        let tolerances: Vec<f64> = (2..=29).map(|k| 10f64.powf(-0.5 * f64::from(k))).collect();
        let report = WorkPrecision::new(model, ends[0], t_end)
            .against(ends[1])
            .tolerances(tolerances)
            .repeats(15)
            .time_cap(Duration::from_millis(150))
            .run()?;
        let mut best = Vec::new();
        for row in report.rows() {
            let (Some(error), Ok(measured)) = (report.error(row, "phi"), &row.outcome) else { continue };
            best.push((error, measured.run_time.as_secs_f64()));
            let (tool, evaluations) =
                (format!("affine {}", row.name()), measured.statistics.equivalent_evaluations());
            self.record(&tool, name, row.tolerance, error, evaluations, measured.run_time);
        }
        let motion = Motion { model, ends, t_end, repeats: (7, Duration::from_millis(20)) };
        let Curves { automatic, splitting, gauss } = motion.curves()?;
        best.extend(automatic.seconds);
        println!("{}", ratios("  best method", &best, theirs));
        for (method, curves) in [("splitting", splitting), ("Gauss", gauss)] {
            let runs: Vec<(f64, f64)> = curves.iter().flat_map(|curve| curve.seconds.clone()).collect();
            println!("{}", ratios(&format!("  {method}"), &runs, theirs));
            curves.iter().for_each(|curve| self.record_curve(name, curve));
        }
        Ok(())
    }

    /// What other tools reached on a problem, one series each: repeats and settings that others of the tool beat left
    /// out.
    fn elsewhere(&self, problem: &str) -> Vec<Series> {
        let mut tools: Vec<(&str, Vec<(f64, f64)>)> = Vec::new();
        for peer in self.peers.iter().filter(|peer| peer.problem.replace('_', " ") == problem) {
            match tools.iter_mut().find(|(tool, _)| *tool == peer.tool) {
                Some((_, runs)) => runs.push((peer.error, peer.time.as_secs_f64())),
                None => tools.push((&peer.tool, vec![(peer.error, peer.time.as_secs_f64())])),
            }
        }
        tools.into_iter().map(|(tool, runs)| (tool.to_owned(), front(&runs))).collect()
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

/// The name of a line of a diagram, and its errors and seconds.
type Series = (String, Vec<(f64, f64)>);

fn series(tool: &str, runs: &[Measured]) -> Series {
    (tool.to_owned(), pairs(runs))
}

/// Errors and seconds.
fn pairs(runs: &[Measured]) -> Vec<(f64, f64)> {
    runs.iter().map(|run| (run.error, run.time.as_secs_f64())).collect()
}

fn fastest(name: &str, tools: &[(&str, Vec<(f64, f64)>)]) -> String {
    let mut row = format!("{name:14}");
    for error in ERRORS {
        let times = tools.iter().filter_map(|(tool, runs)| Some((tool, least_cost(runs, error)?)));
        row += &match times.min_by(|one, other| one.1.total_cmp(&other.1)) {
            Some((tool, seconds)) => format!("{:>10.1} {tool}", 1e6 * seconds),
            None => format!("{:>10} nobody", "-"),
        };
    }
    row
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
