//! A body that vibrates under a stiff dilatation and an isochoric neo-Hookean potential: the forces are derived from
//! one expression.
//!
//! ```text
//! U = kappa/2 sinh(q)^2 + c (tr(G) exp(-2 q) - 3),   q = ln(det phi)/3,   G = phi^T phi
//! ```
//!
//! The run of the adaptive method is held against a 45-digit reference; beside it runs Gauss collocation with a
//! fixed step, whose energy error does not grow. Tables and pictures go to `output/`.

use std::fs;
use std::path::Path;

use affine_runtime::prelude::*;

/// Affine in space, metrical in the body.
#[affine_model(
    dim = 3,
    symmetry(space = affine, body = metric),
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1),
    potential = hyperbolic_dilatation(10) + neo_hookean(0.5),
)]
pub struct VibratingBody;

type Point = <VibratingBody as Model<3>>::Point<f64>;

fn main() -> affine_runtime::Result<()> {
    let output = Path::new("output");
    // A folder that cannot be made shows in the first file that cannot be written.
    let _ = fs::create_dir_all(output);
    let model = VibratingBody::DESCRIPTION;
    println!("{}\n{}\n", model.kinetic_energy.text, model.hamiltonian.text);
    for equation in model.equations {
        println!("{}", equation.text);
    }
    let (full, reduced) = (model.full_operations, model.reduced_operations);
    println!(
        "\n{} multiplications, {} additions, {} division and {} root for the equations of (phi, Sigma_hat); {}, {}, {} \
         and {} reduced\n",
        full.mul, full.add, full.div, full.sqrt, reduced.mul, reduced.add, reduced.div, reduced.sqrt
    );

    let reference = reference()?;
    let Some((&(_, start), rest)) = reference.split_first() else { return Ok(()) };
    let Some(&(t_end, end)) = rest.last() else { return Ok(()) };
    let run = Simulation::new(&VibratingBody, start)
        .until(t_end)
        .tolerance(1e-14)
        .output(rest.iter().map(|(t, _)| *t))
        .run()?;
    print!("{}", run.why());
    println!("\nrelative error against the 45-digit reference, norm-wise:");
    for ((t, exact), (_, point)) in rest.iter().zip(run.iter()) {
        let [phi, spin] = errors(point, exact);
        println!("  t = {t:<4} phi {phi:.1e}, Sigma_hat {spin:.1e}");
    }
    println!("\n{}", run.conservation());

    over_tolerances(start, (t_end, end))?;

    println!("Gauss collocation, 3 stages, a fixed step\n");
    let method = Method::Gauss { stages: 3, step: 0.05 };
    let symplectic = Simulation::new(&VibratingBody, start).until(t_end).every(0.5).method(method).run()?;
    print!("{}", symplectic.why());
    println!("\n{}", symplectic.conservation());

    let picture = Simulation::new(&VibratingBody, start).until(t_end).every(0.1).run()?;
    picture.save_csv(output.join("vibrating_body.csv"))?;
    picture.save_svg(output.join("vibrating_body.svg"))?;
    println!("written to output/: vibrating_body.csv, vibrating_body.svg");
    Ok(())
}

/// Relative errors of `phi` and `Sigma_hat`.
fn errors(point: &Point, exact: &Point) -> [f64; 2] {
    let (s, r) = (point.sigma_hat().0.0, exact.sigma_hat().0.0);
    [(point.phi() - exact.phi()).norm() / exact.phi().norm(), (s - r).norm() / r.norm()]
}

/// What is left in the end of the tolerance that each step keeps: that is the method's.
fn over_tolerances(start: Point, (t_end, exact): (f64, Point)) -> affine_runtime::Result<()> {
    println!(
        "larger error of phi and Sigma_hat at t = {t_end} over the tolerance, Runge-Kutta of orders 8 and 5:"
    );
    for k in [2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12] {
        let tolerance = 10f64.powi(-k);
        let error = |method: Method| {
            let run = Simulation::new(&VibratingBody, start).until(t_end).tolerance(tolerance);
            let run = run.method(method).output([]).run()?;
            let [phi, spin] = errors(run.end().1, &exact);
            affine_runtime::Result::Ok(phi.max(spin) / tolerance)
        };
        println!(
            "  {tolerance:.0e}  {:6.1} {:6.0}",
            error(Method::RungeKutta8)?,
            error(Method::RungeKutta5)?
        );
    }
    println!();
    Ok(())
}

/// The reference solution, the start first: rows of time, `phi` and `Sigma_hat`.
fn reference() -> affine_runtime::Result<Vec<(f64, Point)>> {
    let rows = include_str!("data/vibrating_body.csv").lines().filter(|row| !row.starts_with(['#', 't']));
    rows.map(|row| {
        let numbers: Vec<f64> = row.split(',').map(|v| v.parse().unwrap_or(f64::NAN)).collect();
        let phi = Matrix::<3>::from_row_slice(&numbers[1..10]);
        let sigma_hat = Matrix::<3>::from_row_slice(&numbers[10..19]);
        Ok((numbers[0], VibratingBody.at_momentum(phi, Comoving(sigma_hat))?))
    })
    .collect()
}
