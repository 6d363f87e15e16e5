//! Error against run time of every method on the benchmark problems, against reference solutions of 36 to 45 digits.
//!
//! Prints a table for each problem; tables and pictures go to `output/`.
//!
//! `cargo run --release --example work_precision -- symplectic [P1 P2 ...]`: splitting of every order and Gauss collocation
//! of every number of stages instead, beside the automatic choice at equal errors.

mod equal_steps;
mod frontier;
mod problems;
mod symplectic;

use std::fs;
use std::path::Path;

use affine_runtime::capability::{InLanes, Taylor};
use affine_runtime::prelude::*;
use affine_runtime::report::{WorkPrecision, WorkPrecisionDiagram, reference_solution};

use problems::Visitor;
use symplectic::Symplectic;

fn main() -> affine_runtime::Result<()> {
    // A folder that cannot be made shows in the first file that cannot be written.
    let _ = fs::create_dir_all("output");
    let mut arguments = std::env::args().skip(1);
    if arguments.next().is_some_and(|first| first == "symplectic") {
        let mut symplectic = Symplectic::of(arguments.collect());
        problems::visit(&mut symplectic)?;
        symplectic.summary();
        return Ok(());
    }
    let mut reports = Reports { output: Path::new("output"), figure: figure() };
    problems::visit(&mut reports)?;
    reports.figure.save_svg(Path::new("output").join("work_precision.svg"))?;
    println!("written to output/: work_precision.svg, and a table and a picture of each problem");
    Ok(())
}

fn figure() -> WorkPrecisionDiagram {
    WorkPrecisionDiagram::new("Error against run time", "relative error of phi at the end")
}

struct Reports {
    output: &'static Path,
    figure: WorkPrecisionDiagram,
}

impl Visitor for Reports {
    fn visit<M: InLanes<3, Point<f64>: Send + Sync> + Taylor<3> + Sync>(
        &mut self,
        name: &'static str,
        model: &M,
        [start, end]: [M::Point<f64>; 2],
        t_end: f64,
    ) -> affine_runtime::Result<()> {
        let computed = reference_solution(model, &start, (0.0, t_end))?;
        let distance = (computed.phi() - end.phi()).norm() / end.phi().norm();
        println!(
            "{name}: t = {t_end}; the solution in double-double arithmetic is {distance:.1e} from the reference\n"
        );
        let report = WorkPrecision::new(model, start, t_end).against(end).repeats(9).run()?;
        println!("{report}");
        let stem = format!("work_precision_{}", name.replace(' ', "_").to_lowercase());
        report.save_csv(self.output.join(format!("{stem}.csv")))?;
        report.save_svg(self.output.join(format!("{stem}.svg")))?;
        if matches!(name, "P1" | "P2" | "P3" | "P5 1e6" | "P7" | "P8") {
            let figure = std::mem::replace(&mut self.figure, figure());
            self.figure = figure.panel(name).all(report.series(""));
        }
        Ok(())
    }
}
