//! A table of splitting and Gauss collocation beside the automatic choice for each problem, and what is left of it: how
//! the best of them compares.

use std::time::Duration;

use affine_runtime::Method;
use affine_runtime::capability::{InLanes, Taylor};

use crate::equal_steps::{Curve, Curves, Motion};
use crate::frontier::{ERRORS, least_cost};
use crate::problems::Visitor;

/// Prints the table of each problem.
pub(crate) struct Symplectic {
    only: Vec<String>,
    ratios: Vec<String>,
}

impl Symplectic {
    /// Of the problems that are named; of all if none is.
    pub(crate) fn of(only: Vec<String>) -> Self {
        Self { only, ratios: Vec::new() }
    }

    /// Prints how the best splitting and the best collocation compare.
    pub(crate) fn summary(&self) {
        println!(
            "run time of the best splitting and of the best Gauss collocation over that of the automatic choice"
        );
        print_head();
        self.ratios.iter().for_each(|row| println!("{row}"));
    }
}

impl Visitor for Symplectic {
    fn visit<M: InLanes<3, Point<f64>: Send + Sync> + Taylor<3> + Sync>(
        &mut self,
        name: &'static str,
        model: &M,
        ends: [M::Point<f64>; 2],
        t_end: f64,
    ) -> affine_runtime::Result<()> {
        if !self.only.is_empty() && !self.only.iter().any(|asked| asked == name) {
            return Ok(());
        }
        let motion = Motion { model, ends, t_end, repeats: (7, Duration::from_millis(20)) };
        let Curves { automatic, splitting, gauss } = motion.curves()?;
        // Its evaluations are those of the equations, as for Gauss collocation; a Taylor series has none, and counts as what
        // its products are worth.
        let explicit = motion.over_tolerances("Runge-Kutta 8", Method::RungeKutta8)?;
        println!(
            "{name}: evaluations, and run time over that of the automatic choice, at equal errors of phi"
        );
        print_head();
        println!("{}", row(&automatic, &automatic));
        for curve in [&explicit].into_iter().chain(&splitting).chain(&gauss) {
            println!("{}", row(curve, &automatic));
        }
        println!();
        for (kind, curves) in [("splitting", &splitting), ("Gauss", &gauss)] {
            let mut ratios = format!("{:18}", format!("{name} {kind}"));
            for error in ERRORS {
                let ratio = least_seconds(curves, error).zip(least_cost(&automatic.seconds, error));
                ratios += &ratio
                    .map_or_else(|| format!("{:>18}", "-"), |(own, least)| format!("{:>18.2}", own / least));
            }
            self.ratios.push(ratios);
        }
        Ok(())
    }
}

fn print_head() {
    print!("{:18}", "");
    ERRORS.iter().for_each(|error| print!("{error:>18.0e}"));
    println!();
}

fn row(curve: &Curve, automatic: &Curve) -> String {
    let mut row = format!("{:18}", curve.name);
    for error in ERRORS {
        let time = least_cost(&curve.seconds, error);
        row += &match (least_cost(&curve.evaluations, error), time.zip(least_cost(&automatic.seconds, error)))
        {
            (Some(evaluations), Some((own, least))) => format!("{evaluations:>10.0} {:>7.2}", own / least),
            (Some(evaluations), None) => format!("{evaluations:>10.0} {:>7}", "alone"),
            _ => format!("{:>18}", "-"),
        };
    }
    row
}

/// The least run time of some methods at an error.
fn least_seconds(curves: &[Curve], error: f64) -> Option<f64> {
    curves.iter().filter_map(|curve| least_cost(&curve.seconds, error)).min_by(f64::total_cmp)
}
