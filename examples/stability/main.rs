//! Stiff and extreme cases, each against an oracle: held, refused in words, or fell short.
//!
//! ```sh
//! cargo run --release --example stability           # a few minutes at most
//! cargo run --release --example stability -- long   # 1e5 units of time and 1e8 steps in the long runs
//! cargo run --release --example stability -- stress    # three models from all sides, or one: stress viscous
//! ```
//!
//! The table goes to the terminal, and with the picture to `output/`. A promise that is not kept fails the program.

mod demands;
mod scenes;
mod stress;

use std::fs;
use std::path::Path;
use std::process::ExitCode;

use scenes::Extent;

fn main() -> affine_runtime::Result<ExitCode> {
    let output = Path::new("output");
    // A folder that cannot be made shows in the first file that cannot be written.
    let _ = fs::create_dir_all(output);
    let words: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    let extent = match words[..] {
        [] => Extent::Full,
        ["long"] => Extent::Long,
        ["stress"] => return stressed(&stress::NAMES, output),
        ["stress", ref names @ ..] => return stressed(names, output),
        _ => {
            eprintln!(
                "`{}`: `long` takes long runs, `stress` stresses models, nothing takes the table",
                words.join(" ")
            );
            return Ok(ExitCode::FAILURE);
        }
    };
    let report = scenes::report(extent)?;
    println!("{report}");
    report.save_csv(output.join("stability.csv"))?;
    report.save_svg(output.join("stability.svg"))?;
    let mut broken = demands::broken(&report);
    if extent == Extent::Full && !demands::are_same(&report, &scenes::report(extent)?) {
        broken.push("two runs give the same bytes".to_owned());
    }
    broken.iter().for_each(|promise| eprintln!("not kept: {promise}"));
    Ok(if broken.is_empty() { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

/// Each model under stress, with a table and a picture of its own.
fn stressed(names: &[&str], output: &Path) -> affine_runtime::Result<ExitCode> {
    for name in names {
        let Some(report) = stress::report(name) else {
            eprintln!("no model `{name}`: there are {}", stress::NAMES.join(", "));
            return Ok(ExitCode::FAILURE);
        };
        let report = report?;
        println!("{report}");
        report.save_csv(output.join(format!("stress_{name}.csv")))?;
        report.save_svg(output.join(format!("stress_{name}.svg")))?;
    }
    Ok(ExitCode::SUCCESS)
}
