//! A cloud of gas that expands into a vacuum, as Ovsiannikov and Dyson stated it: homogeneous in its strain, monatomic, adiabatic.
//!
//! ```text
//! T = 1/2 tr(phi_dot^T phi_dot),   U = k det^(1 - gamma) = k det^(-2/3),   gamma = 5/3
//! ```
//!
//! `U` is of degree -2 in `phi`, so that `d^2/dt^2 tr(phi^T phi) = 4 E` along every motion: its mean square radius is a parabola
//! of the time, however it spins (F. J. Dyson, J. Math. Mech. 18 (1968) 91). For a cloud of revolution the rest is an integral (S. I.
//! Anisimov and Yu. I. Lysikov, J. Appl. Math. Mech. 34 (1970) 882). With `a = b = R sin(theta)/sqrt 2`, `c = R cos(theta)` and
//! `V = (sin(theta)^2 cos(theta))^(-2/3)`, a cloud that starts at rest ends at the `theta` where
//!
//! ```text
//! int d(theta)/sqrt(1 - V(theta)/V(theta_0)) = pi/2
//! ```
//!
//! Shown: the parabola of a cloud that spins; a cigar of `c/a = 2`, which becomes a pancake; and nearly round clouds, whose
//! eccentricity ends at `cos(pi/sqrt 2)` of what it was. The picture goes to `output/`.

use std::f64::consts::{PI, SQRT_2};
use std::fs;

use affine_runtime::prelude::*;
use affine_runtime::report::{Curve, CurveDiagram, CurvePanel};

/// A monatomic gas, in units in which `J = 1` and `k = 1`.
#[affine_model(dim = 3, kinetic(dalembert = 1), potential = gas(1))]
pub struct Cloud;

type Point = <Cloud as Model<3>>::Point<f64>;

/// Where a cigar of `c/a = 2` ends: 20 of 40 digits of the integral.
const PANCAKE: f64 = 0.644_194_994_694_724_7;

/// The time after which the shape changes by less than a rounding: what is left of the change is about `1/t`.
const FOREVER: f64 = 1e15;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let _ = fs::create_dir_all("output");
    println!("{}\nconserved: {:?}\n", Cloud::DESCRIPTION.hamiltonian.text, Cloud::DESCRIPTION.conserved);

    let defect = parabola()?;
    println!("a cloud that spins, to t = 20: tr(phi^T phi) leaves its parabola by {defect:.1e} of itself");
    let pancake = final_ratio(2.0)?;
    let missed = (pancake - PANCAKE).abs();
    println!("a cigar of c/a = 2 from rest ends at c/a = {pancake:.13} (off the integral by {missed:.1e})");
    let small = 1e-3;
    let change = (final_ratio(1.0 + small)? - final_ratio(1.0 - small)?) / (2.0 * small);
    let known = (PI / SQRT_2).cos();
    println!("nearly round clouds from rest: eccentricity times {change:.6} (cos(pi/sqrt 2) = {known:.6})");
    if defect > 1e-11 || missed > 1e-11 || (change - known).abs() > 1e-5 {
        return Err("a cloud of gas does not expand as it is known to".into());
    }
    draw()?;
    println!("picture: output/gas_cloud.svg");
    Ok(())
}

/// A spheroid with the axes `1, 1, ratio`, at rest.
fn at_rest(ratio: f64) -> affine_runtime::Result<Point> {
    Cloud.at_velocity(Matrix::from_diagonal(&Vector::<3>::new(1.0, 1.0, ratio)), Matrix::zeros())
}

/// `c/a` of a spheroid that starts from rest, after all.
fn final_ratio(ratio: f64) -> affine_runtime::Result<f64> {
    let run = Simulation::new(&Cloud, at_rest(ratio)?).until(FOREVER).tolerance(1e-14).run()?;
    let phi = run.end().1.phi();
    Ok(phi[(2, 2)] / phi[(0, 0)])
}

/// How far `tr(phi^T phi)` leaves `tr_0 + t tr_0' + 2 E t^2`, for a start without symmetry that spins.
fn parabola() -> affine_runtime::Result<f64> {
    let phi = Matrix::<3>::new(1.2, 0.1, 0.2, 0.0, 1.0, -0.15, 0.0, 0.0, 0.8);
    let rate = Matrix::<3>::new(-0.2, 1.5, -0.1, -1.3, -0.4, 0.2, 0.15, -0.25, -0.3);
    let start = Cloud.at_velocity(phi, rate)?;
    let energy = Cloud.hamiltonian(0.0, &start);
    let run = Simulation::new(&Cloud, start).until(20.0).every(0.5).tolerance(1e-14).run()?;
    let defect = |(t, point): (f64, &Point)| {
        let known = phi.norm_squared() + 2.0 * t * phi.dot(&rate) + 2.0 * energy * t * t;
        (point.phi().norm_squared() / known - 1.0).abs()
    };
    Ok(run.iter().map(defect).fold(0.0, f64::max))
}

/// Axes of the cigar, and their ratio.
fn draw() -> Result<(), Box<dyn std::error::Error>> {
    let run = Simulation::new(&Cloud, at_rest(2.0)?).until(12.0).every(0.05).run()?;
    let curve = |category: usize, value: &dyn Fn(&Point) -> f64| Curve {
        category,
        points: run.iter().map(|(t, point)| (t, value(point))).collect(),
    };
    let (a, c) = (|point: &Point| point.phi()[(0, 0)], |point: &Point| point.phi()[(2, 2)]);
    let panel = |y: &str, curves: Vec<Curve>| CurvePanel {
        x: "t".into(),
        y: y.into(),
        logarithmic: false,
        range: None,
        curves,
    };
    let axes = panel("axes: equator, pole", vec![curve(0, &a), curve(1, &c)]);
    let ratio = panel(
        "pole/equator, and its end",
        vec![curve(2, &|point: &Point| c(point) / a(point)), curve(3, &|_: &Point| PANCAKE)],
    );
    CurveDiagram::new("Cloud of gas, from rest at c/a = 2", vec![axes, ratio])
        .save_svg("output/gas_cloud.svg")?;
    Ok(())
}
