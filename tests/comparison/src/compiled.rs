//! DOP853 in C, over equations that SymPy and CasADi have taken common subexpressions out of: `c/`, compiled for the processor
//! at hand when the comparison begins, and a program of its own that is asked line by line.

use std::env;
use std::io::{self, BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::time::Duration;

/// Whose equations there are, and what they are called in tables.
pub(crate) const STATEMENTS: [(&str, &str); 2] =
    [("casadi", "C DOP853 by CasADi"), ("sympy", "C DOP853 by SymPy")];
const FLAGS: [&str; 5] = ["-std=c11", "-O3", "-march=native", "-ffast-math", "-o"];
const PROGRAM: &str = "output/comparison_in_c";

/// The program, waiting for a line.
pub(crate) struct Compiled {
    child: Child,
    asked: ChildStdin,
    answers: BufReader<ChildStdout>,
}

/// A run to its end.
pub(crate) struct Run {
    pub(crate) time: Duration,
    pub(crate) evaluations: u64,
    pub(crate) end: Vec<f64>,
}

impl Compiled {
    /// Compiles the program by `$CC` or gcc, says by which, and starts it; `None`, and a line that says so, where there is no
    /// such compiler.
    ///
    /// # Errors
    /// In words: a compiler that refuses the program, and a program that does not start.
    pub(crate) fn start() -> Result<Option<Self>, String> {
        let compiler = env::var("CC").unwrap_or_else(|_| "gcc".to_owned());
        let version = match Command::new(&compiler).arg("--version").output() {
            Ok(told) => String::from_utf8_lossy(&told.stdout).lines().next().unwrap_or_default().to_owned(),
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                println!(
                    "There is no C compiler `{compiler}` (CC names another): the tools in C, which are the fastest outside \
                     ones in most cells, are left out, and what is left is easier to win against.\n"
                );
                return Ok(None);
            }
            Err(error) => return Err(format!("{compiler}: {error}")),
        };
        let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("c/worker.c");
        let built = Command::new(&compiler).args(FLAGS).arg(PROGRAM).arg(source).arg("-lm").status();
        if !built.as_ref().is_ok_and(|status| status.success()) {
            return Err(format!("{compiler} does not compile tests/comparison/c/worker.c: {built:?}"));
        }
        println!("{version}, {}; SymPy 1.14.0, CasADi 3.8.2\n", FLAGS[1..4].join(" "));
        let started = Command::new(PROGRAM).stdin(Stdio::piped()).stdout(Stdio::piped()).spawn();
        let mut child = started.map_err(|error| format!("{PROGRAM}: {error}"))?;
        match (child.stdin.take(), child.stdout.take()) {
            (Some(asked), Some(answers)) => Ok(Some(Self { child, asked, answers: BufReader::new(answers) })),
            _ => Err(format!("{PROGRAM} has no input or no output")),
        }
    }

    /// A run by the equations of a tool, repeated until `burst` is over, of which the least time counts.
    pub(crate) fn run(
        &mut self,
        tool: &str,
        problem: &str,
        [tolerance, t_end, burst]: [f64; 3],
        start: &[f64],
    ) -> Option<Run> {
        let settings = [tolerance, t_end, burst];
        let answer = self.ask("run", tool, problem, settings.iter().chain(start))?;
        let [seconds, evaluations, end @ ..] = answer.as_slice() else { return None };
        let time = Duration::try_from_secs_f64(*seconds).ok()?;
        Some(Run { time, evaluations: *evaluations as u64, end: end.to_vec() })
    }

    /// Nanoseconds of one evaluation: of a chain of them, of one state after the other, and of a block of states whose
    /// components stand side by side.
    pub(crate) fn times(&mut self, tool: &str, problem: &str, start: &[f64]) -> Option<[f64; 3]> {
        self.ask("rhs", tool, problem, start.iter())?.try_into().ok()
    }

    fn ask<'a>(
        &mut self,
        what: &str,
        tool: &str,
        problem: &str,
        numbers: impl Iterator<Item = &'a f64>,
    ) -> Option<Vec<f64>> {
        let numbers: String = numbers.map(|number| format!(" {number:e}")).collect();
        // The program knows problems by their equations and numbers, in which this one is P5 1e4.
        let problem = if problem == "P5 large" { "P5 1e4" } else { problem };
        writeln!(self.asked, "{what} {tool} {}{numbers}", problem.replace(' ', "_")).ok()?;
        let mut answer = String::new();
        self.answers.read_line(&mut answer).ok()?;
        answer.strip_prefix("ok ")?.split_whitespace().map(|number| number.parse().ok()).collect()
    }
}

impl Drop for Compiled {
    fn drop(&mut self) {
        // It ends by itself with its input; whatever keeps it from that is no matter any more.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
