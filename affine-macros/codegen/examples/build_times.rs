//! What a model adds to a release build of the program that uses it.
//!
//! ```sh
//! cargo run -p affine-codegen --example build_times        # every model, the median of three builds
//! cargo run -p affine-codegen --example build_times -- 5 P3 # five builds of those whose name contains `P3`
//! ```
//!
//! A package of its own, which depends on this checkout by path, is built with `cargo build --release` again and again:
//! its program holds four other models, or these and the one in question. The difference is what that model adds, since what
//! models share is compiled for the first ones. Models are evaluated alone (Legendre transformation, right-hand side,
//! energy), or simulated (`Simulation` with a tolerance, by the automatic method).
//!
//! A model may add a second on two processors at the most; the exit code says so. Processor time (user time of all
//! compilers, Linux alone) depends less on what else the machine does.

use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};
use std::time::{Duration, Instant};
use std::{env, fs, io};

/// What a model may add.
const MOST: f64 = 1.0;

/// A model by its name, the arguments of the attribute, the fields and the value.
struct Case {
    name: &'static str,
    arguments: &'static str,
    fields: &'static str,
    value: &'static str,
    has_translation: bool,
}

/// One of each kind of phase point that the others have.
const FIRST: [Case; 4] = [
    plain("co-moving spin", "dim = 3, kinetic(casimir2 = 0.3, body_inertia = 2)"),
    moving(
        "co-moving spin, centre",
        "dim = 3, kinetic(casimir2 = 0.3, body_inertia = 2, body_translation = 1)",
    ),
    plain("spatial spin", "dim = 3, kinetic(casimir2 = 0.3, space_inertia = 2)"),
    plain("conjugate momentum", "dim = 3, kinetic(dalembert = 2)"),
];

const CASES: [Case; 9] = [
    moving(
        "P1: affine in space, metrical in the body",
        "dim = 3, kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, body_translation = 1)",
    ),
    with_fields(
        "P2, P5, P8: the same, vibrating",
        "dim = 3, kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1), \
         potential = hyperbolic_dilatation(kappa) + neo_hookean(c)",
    ),
    plain(
        "P2r: metrical in space, affine in the body",
        "dim = 3, kinetic(casimir2 = 0.2, casimir1_squared = 0.1, space_inertia = 1), \
         potential = hyperbolic_dilatation(10) + neo_hookean(0.5)",
    ),
    with_fields(
        "P3, P6: d'Alembert, elastic",
        "dim = 3, kinetic(dalembert = diag(1, 1.5, 2)), potential = hyperbolic_dilatation(kappa) + neo_hookean(c)",
    ),
    plain(
        "P4: affine on both sides, lattice",
        "dim = 3, kinetic(casimir2 = 1, casimir1_squared = 0.1), emit(two_polar)",
    ),
    Case {
        has_translation: true,
        ..with_fields(
            "P7: P1, vibrating",
            "dim = 3, kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, body_translation = 1), \
             potential = hyperbolic_dilatation(kappa) + neo_hookean(c)",
        )
    },
    with_fields(
        "P3 by Nystrom steps",
        "dim = 3, kinetic(dalembert = diag(1, 1.5, 2)), potential = hyperbolic_dilatation(kappa) + neo_hookean(c), \
         emit(nystrom)",
    ),
    with_fields(
        "P2 by its Taylor series",
        "dim = 3, kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1), \
         potential = hyperbolic_dilatation(kappa) + neo_hookean(c), emit(taylor)",
    ),
    with_fields(
        "P2 with every capability",
        "dim = 3, kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1), \
         potential = hyperbolic_dilatation(kappa) + neo_hookean(c), \
         emit(taylor, splitting, two_polar, tangent, lanes, metric)",
    ),
];

const fn plain(name: &'static str, arguments: &'static str) -> Case {
    Case { name, arguments, fields: "", value: "Body {}", has_translation: false }
}

const fn moving(name: &'static str, arguments: &'static str) -> Case {
    Case { has_translation: true, ..plain(name, arguments) }
}

const fn with_fields(name: &'static str, arguments: &'static str) -> Case {
    Case {
        fields: "pub kappa: f64, pub c: f64",
        value: "Body { kappa: number(20), c: number(21) }.prepare()?",
        ..plain(name, arguments)
    }
}

/// What is done with a model.
#[derive(Clone, Copy)]
enum Use {
    Evaluated,
    Simulated,
}

const EVALUATION: &str = "let (reduced, constants) = model.reduce(0.0, &start);
        let rates = model.reduced_equations(0.0, &constants, &reduced);
        Ok(model.hamiltonian(0.0, &start) + rates.as_ref().iter().sum::<f64>())";
const SIMULATION: &str = "let run = Simulation::new(&model, start).until(number(30)).tolerance(1e-9).run()?;
        Ok(run.end().1.phi().trace())";

/// What is read from the command line is not known when the program is compiled.
const PROGRAM: &str = "//! Written by `build_times`.
use affine_runtime::prelude::*;

pub fn number(k: usize) -> f64 {
    std::env::args().nth(k).and_then(|text| text.parse().ok()).unwrap_or(0.1)
}

pub fn matrix(k: usize) -> Matrix<3> {
    Matrix::<3>::from_fn(|i, j| number(k + 3 * i + j))
}
";

/// Wall clock and processor time of a build, in seconds.
#[derive(Clone, Copy, Default)]
struct Cost {
    wall: f64,
    processor: f64,
}

fn main() -> ExitCode {
    let mut arguments = env::args().skip(1);
    let builds = arguments.next().and_then(|text| text.parse().ok()).unwrap_or(3_usize).max(1);
    let wanted = arguments.next().unwrap_or_default();
    match table(builds, &wanted) {
        Ok(largest) if largest <= MOST => ExitCode::SUCCESS,
        Ok(_) => {
            println!("more than {MOST} s");
            ExitCode::FAILURE
        }
        Err(error) => {
            println!("{error}");
            ExitCode::FAILURE
        }
    }
}

/// Prints what each model adds; the largest, by wall clock.
fn table(builds: usize, wanted: &str) -> io::Result<f64> {
    let package = Package::written()?;
    println!("seconds by wall clock (of processors), the median of {builds}");
    println!("{:<46} {:>16} {:>16}", "", "evaluated", "simulated");
    let empty = package.median(builds, &[], Use::Evaluated)?;
    let first = FIRST.iter().collect::<Vec<_>>();
    let without = |with: Use| package.median(builds, &first, with);
    let begin = [without(Use::Evaluated)?, without(Use::Simulated)?];
    print_row("the first four together", begin.map(|cost| cost.minus(empty)));
    let mut largest = 0.0;
    for case in CASES.iter().filter(|case| case.name.contains(wanted)) {
        let models = [first.as_slice(), &[case]].concat();
        let with = |with: Use| package.median(builds, &models, with);
        let added = [with(Use::Evaluated)?.minus(begin[0]), with(Use::Simulated)?.minus(begin[1])];
        print_row(case.name, added);
        largest = added.iter().fold(largest, |largest, cost| cost.wall.max(largest));
    }
    Ok(largest)
}

fn print_row(name: &str, costs: [Cost; 2]) {
    let text = costs.map(|Cost { wall, processor }| format!("{wall:.2} ({processor:.2})"));
    println!("{name:<46} {:>16} {:>16}", text[0], text[1]);
}

impl Cost {
    fn minus(self, other: Self) -> Self {
        Self { wall: self.wall - other.wall, processor: self.processor - other.processor }
    }
}

/// A package beside what this program was built into.
struct Package(PathBuf);

impl Package {
    /// With everything built that it depends on.
    fn written() -> io::Result<Self> {
        let checkout = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize()?;
        let program = env::current_exe()?;
        let target = program.ancestors().nth(3).unwrap_or(Path::new("target"));
        let package = Self(target.join("build_times"));
        fs::create_dir_all(package.0.join("src"))?;
        fs::copy(checkout.join("Cargo.lock"), package.0.join("Cargo.lock"))?;
        let runtime = checkout.join("affine-runtime");
        let manifest = format!(
            "[package]\nname = \"build_times\"\nedition = \"2024\"\n\n\
             [dependencies]\naffine-runtime = {{ path = {runtime:?} }}\n\n[workspace]\n"
        );
        fs::write(package.0.join("Cargo.toml"), manifest)?;
        package.build(&[], Use::Evaluated)?;
        Ok(package)
    }

    /// Of several builds of a program with these models.
    fn median(&self, builds: usize, models: &[&Case], with: Use) -> io::Result<Cost> {
        let costs: Vec<Cost> = (0..builds).map(|_| self.build(models, with)).collect::<io::Result<_>>()?;
        let median = |of: fn(&Cost) -> f64| {
            let mut values: Vec<f64> = costs.iter().map(of).collect();
            values.sort_by(f64::total_cmp);
            values[values.len() / 2]
        };
        Ok(Cost { wall: median(|cost| cost.wall), processor: median(|cost| cost.processor) })
    }

    fn build(&self, models: &[&Case], with: Use) -> io::Result<Cost> {
        // A changed file is compiled, whatever it says.
        fs::write(self.0.join("src/main.rs"), program(models, with))?;
        let (start, before) = (Instant::now(), processor_time());
        let mut build = Command::new(env::var_os("CARGO").unwrap_or("cargo".into()));
        build.args(["build", "--release", "--quiet"]).env("CARGO_TARGET_DIR", self.0.join("target"));
        let status = build.current_dir(&self.0).status()?;
        if !status.success() {
            return Err(io::Error::other(format!("{} does not build", self.0.display())));
        }
        let processor = processor_time() - before;
        Ok(Cost { wall: start.elapsed().as_secs_f64(), processor: processor.as_secs_f64() })
    }
}

/// A module for each model, and a program that calls all.
fn program(models: &[&Case], with: Use) -> String {
    let mut program = PROGRAM.to_owned();
    let mut calls = String::new();
    for (k, Case { arguments, fields, value, has_translation, .. }) in models.iter().enumerate() {
        let velocity = match has_translation {
            true => {
                "matrix(1).column(0).into_owned(), matrix(1), matrix(4).column(0).into_owned(), matrix(10)"
            }
            false => "matrix(1), matrix(10)",
        };
        let then = match with {
            Use::Evaluated => EVALUATION,
            Use::Simulated => SIMULATION,
        };
        program += &format!(
            "
mod model_{k} {{
    use super::*;

    #[affine_model({arguments})]
    pub struct Body {{ {fields} }}

    pub fn result() -> affine_runtime::Result<f64> {{
        let model = {value};
        let start = model.at_velocity({velocity})?;
        {then}
    }}
}}
"
        );
        calls += &format!("    println!(\"{{}}\", model_{k}::result()?);\n");
    }
    program + &format!("\nfn main() -> affine_runtime::Result<()> {{\n{calls}    Ok(())\n}}\n")
}

/// User time of the processes that this one has waited for: field 16 of `/proc/self/stat`, in hundredths of a second
/// (proc(5)); the name in field 2 may contain spaces.
fn processor_time() -> Duration {
    let text = fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let fields = text.rsplit_once(')').map_or("", |(_, fields)| fields);
    let ticks = fields.split_whitespace().nth(13).and_then(|ticks| ticks.parse().ok()).unwrap_or(0);
    Duration::from_millis(10 * ticks)
}
