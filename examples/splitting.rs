//! Splitting into exact sub-flows: an elastic body of d'Alembert (problem P3), error against run time beside Runge-Kutta
//! of order 8, and what a long run with long steps keeps.

use affine_runtime::prelude::*;
use affine_runtime::report::WorkPrecision;

#[affine_model(
    dim = 3,
    kinetic(dalembert = diag(1, 1.5, 2)),
    potential = hyperbolic_dilatation(10) + neo_hookean(0.5),
    emit(splitting, taylor)
)]
struct Elastic;

fn main() -> affine_runtime::Result<()> {
    let [start, end] = ends(include_str!("../tests/data/p3.csv"))?;
    let steps = [(4, [0.1, 0.05, 0.025, 0.0125]), (6, [0.2, 0.1, 0.05, 0.025]), (8, [0.2, 0.1, 0.05, 0.025])];
    let splitting =
        steps.iter().flat_map(|(order, steps)| steps.map(|step| Method::Splitting { order: *order, step }));
    let methods = [Method::RungeKutta8, Method::Taylor { order: None }].into_iter().chain(splitting);
    let report = WorkPrecision::new(&Elastic, start, 50.0).against(end).methods(methods).repeats(9).run()?;
    println!("{report}");

    let run = Simulation::new(&Elastic, start).until(5000.0).every(50.0);
    let run = run.method(Method::Splitting { order: 4, step: 0.1 }).run()?;
    println!("{}", run.conservation());
    println!("{}", run.why());
    Ok(())
}

/// First and last row of the reference solution: `t`, `phi`, `Pi`.
fn ends(data: &str) -> affine_runtime::Result<[<Elastic as Model<3>>::Point<f64>; 2]> {
    let mut rows = data.lines().filter(|line| line.starts_with(|c: char| c.is_ascii_digit()));
    let point = |line: Option<&str>| {
        let numbers: Vec<f64> =
            line.unwrap_or_default().split(',').map(|number| number.parse().unwrap_or(f64::NAN)).collect();
        let matrix = |from: usize| {
            Matrix::<3>::from_fn(|i, j| numbers.get(from + 3 * i + j).copied().unwrap_or(f64::NAN))
        };
        Elastic.at_momentum(matrix(1), TwoPoint(matrix(10)))
    };
    let first = point(rows.next())?;
    Ok([first, point(rows.next_back())?])
}
