//! Stiff and extreme cases, each against an oracle: held, refused in words, or fell short.
//!
//! ```sh
//! cargo run --release --example stability           # a few minutes at most
//! cargo run --release --example stability -- long   # 1e5 units of time and 1e8 steps in the long runs
//! ```
//!
//! The table goes to the terminal, and with the picture to `output/`. A promise that is not kept fails the program.

mod demands;
mod scenes;

use std::fs;
use std::path::Path;
use std::process::ExitCode;

use scenes::Extent;

fn main() -> affine_runtime::Result<ExitCode> {
    let output = Path::new("output");
    // A folder that cannot be made shows in the first file that cannot be written.
    let _ = fs::create_dir_all(output);
    let extent = match std::env::args().nth(1).as_deref() {
        None => Extent::Full,
        Some("long") => Extent::Long,
        Some(other) => {
            eprintln!("no `{other}` here: `long` takes long runs, nothing takes the others");
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
