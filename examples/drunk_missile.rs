//! Problem P1: a body that is affine in space and metrical in the body moves freely, and its centre of mass does
//! not fly straight.
//!
//! Prints the derived equations, holds the motion against a 45-digit reference, its twin at rest against the closed
//! form, and measures error against run time. Pictures and tables go to `output/`.

use std::fs;
use std::path::Path;

use affine_runtime::gltf::Shape;
use affine_runtime::prelude::*;
use affine_runtime::report::WorkPrecision;

/// Affine in space, metrical in the body: the "drunk missile".
#[affine_model(
    dim = 3,
    symmetry(space = affine, body = metric),
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, body_translation = 1),
)]
pub struct DrunkMissile;

type Point = <DrunkMissile as Model<3>>::Point<f64>;

const T_END: f64 = 10.0;

fn main() -> affine_runtime::Result<()> {
    let output = Path::new("output");
    // A folder that cannot be made shows in the first file that cannot be written.
    let _ = fs::create_dir_all(output);

    println!("The model and what is derived from it\n");
    derived();

    let reference = reference()?;
    let (start, exact_end) = (reference[0], reference[reference.len() - 1]);
    println!("\nThe motion to t = {T_END}\n");
    let run = Simulation::new(&DrunkMissile, start).until(T_END).tolerance(1e-13).every(0.05).run()?;
    print!("{}", run.why());
    let (_, end) = run.end();
    println!("\nerror at t = {T_END} against the 45-digit reference, norm-wise:");
    print_errors(end, &exact_end);
    println!("\n{}", run.conservation());
    run.save_csv(output.join("drunk_missile.csv"))?;
    run.save_svg(output.join("drunk_missile.svg"))?;
    run.page().program(include_str!("drunk_missile.rs")).save(output.join("drunk_missile.html"))?;
    run.save_glb(output.join("drunk_missile.glb"), &Shape::ball())?;

    println!("\nIts twin with p = 0\n");
    at_rest(&start)?;

    println!("\nError against run time\n");
    let report = WorkPrecision::new(&DrunkMissile, start, T_END).against(exact_end).run()?;
    println!("{report}");
    report.save_csv(output.join("drunk_missile_work_precision.csv"))?;
    report.save_svg(output.join("drunk_missile_work_precision.svg"))?;
    println!(
        "\nwritten to output/: drunk_missile.csv, .svg, .html, .glb, drunk_missile_work_precision.csv, .svg"
    );
    Ok(())
}

/// The derivation: energies, equations, reduced equations.
fn derived() {
    let model = DrunkMissile::DESCRIPTION;
    println!("  {}\n  {}\n", model.kinetic_energy.text, model.hamiltonian.text);
    for equation in model.equations {
        println!("  {}", equation.text);
    }
    println!(
        "\nwhat is integrated, in a space turned so that p = (p_1, 0, 0); total is I(O) = x p^T + Sigma:\n"
    );
    for equation in model.reduced_equations {
        println!("  {}", equation.text);
    }
    let (full, reduced) = (model.full_operations, model.reduced_operations);
    println!(
        "\n{} multiplications and {} additions for the equations of (x, phi, p_hat, Sigma_hat), {} and {} reduced",
        full.mul, full.add, reduced.mul, reduced.add
    );
}

/// The reference solution: start, t = 1, 2, 5, 10.
fn reference() -> affine_runtime::Result<Vec<Point>> {
    let rows = include_str!("data/drunk_missile.csv").lines().filter(|row| !row.starts_with(['#', 't']));
    rows.map(|row| {
        let numbers: Vec<f64> = row.split(',').skip(1).map(|v| v.parse().unwrap_or(f64::NAN)).collect();
        let x = Vector::<3>::from_column_slice(&numbers[0..3]);
        let phi = Matrix::<3>::from_row_slice(&numbers[3..12]);
        let p_hat = Vector::<3>::from_column_slice(&numbers[12..15]);
        let sigma_hat = Matrix::<3>::from_row_slice(&numbers[15..24]);
        // p_hat = phi^T p
        let p = phi.transpose().lu().solve(&p_hat).unwrap_or_default();
        DrunkMissile.at_momentum(x, phi, p, Comoving(sigma_hat))
    })
    .collect()
}

fn print_errors(end: &Point, exact: &Point) {
    let relative = |a: f64, b: f64| a / b;
    println!("  x          {:.1e}", relative((end.x() - exact.x()).norm(), exact.x().norm()));
    println!("  phi        {:.1e}", relative((end.phi() - exact.phi()).norm(), exact.phi().norm()));
    let (p, q) = (end.p_hat().0.0, exact.p_hat().0.0);
    println!("  p_hat      {:.1e}", relative((p - q).norm(), q.norm()));
    let (s, r) = (end.sigma_hat().0.0, exact.sigma_hat().0.0);
    println!("  Sigma_hat  {:.1e}", relative((s - r).norm(), r.norm()));
}

/// With p = 0 the model has a closed form: both ways to the same end.
fn at_rest(moving: &Point) -> affine_runtime::Result<()> {
    let start =
        DrunkMissile.at_momentum(moving.x(), *moving.phi(), Vector::<3>::zeros(), moving.sigma_hat())?;
    let exact = Simulation::new(&DrunkMissile, start).until(T_END).run()?;
    print!("{}", exact.why());
    let steps = Simulation::new(&DrunkMissile, start)
        .until(T_END)
        .tolerance(1e-13)
        .method(Method::RungeKutta8)
        .run()?;
    let (a, b) = (exact.end().1, steps.end().1);
    println!(
        "\nintegrator against closed form at t = {T_END}: phi {:.1e}, Sigma_hat {:.1e}, in {} steps",
        (a.phi() - b.phi()).norm() / a.phi().norm(),
        (a.sigma_hat().0.0 - b.sigma_hat().0.0).norm() / a.sigma_hat().0.0.norm(),
        steps.statistics().steps
    );
    Ok(())
}
