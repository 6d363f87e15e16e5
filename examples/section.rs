//! A Poincare section of a planar vibrating body, from 200 starts of one energy, spin and vorticity.
//!
//! Space and body are isotropic, so that spin `S` and vorticity `V` are conserved, and two degrees of freedom are left: the
//! mean log-stretch `q` and half their difference `x`. At `q = 0`, rising, a motion is a point `(x, x')` of a plane. Where
//! points of one start lie on a curve, the motion is regular; where they fill an area, it is chaotic. Picture and points, as
//! arrays of NumPy and as CSV, go to `output/`.

use std::fmt::Write;
use std::fs;

use affine_runtime::prelude::*;
use affine_runtime::simulate::{Format, Table};

/// D'Alembert's kinetic energy, a stiff dilatation and a soft shear.
#[affine_model(
    dim = 2,
    kinetic(dalembert = 1),
    potential = hyperbolic_dilatation(3) + 0.5*(tr(G)/det - 2) + 0.1*(tr(G) - 2)^2,
    emit(lanes),
)]
pub struct Disc;

type Point = <Disc as Model<2>>::Point<f64>;

const ENERGY: f64 = 1.5;
const SPIN: f64 = 0.5;
const VORTICITY: f64 = 0.2;
const STARTS: usize = 200;
const T_END: f64 = 300.0;
const TOLERANCE: f64 = 1e-11;
/// One start in so many is drawn.
const SHOWN: u64 = 4;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let places = (1..40).flat_map(|i| (-10..=10).map(move |k| (0.025 * f64::from(i), 0.2 * f64::from(k))));
    let starts: Vec<Point> = places.filter_map(|(x, px)| start(x, px)).step_by(2).take(STARTS).collect();
    let section = || vec![Event::determinant(1.0).rising().named("section")];
    let ensemble = Ensemble::new(&Disc, starts.iter().copied()).until(T_END).tolerance(TOLERANCE);
    let (mut dots, mut points, mut worst) = (String::new(), 0, 0.0_f64);
    let (mut stopped, mut table) = (0, Table::of_bodies::<2, Disc>(&["x", "rate"])?);
    ensemble.events(section).progress_bar().fold(
        |_, _| (),
        |(), _, _| (),
        |body| {
            stopped += usize::from(body.end.is_err());
            let mut path = String::new();
            for event in &body.events {
                let (x, rate) = of_section(&event.point);
                table.push::<2, Disc>(body.number, &[x, rate], event.t, &event.point);
                points += 1;
                let spin = event.point.spin().0.0[(0, 1)] - SPIN;
                let energy = Disc.hamiltonian(event.t, &event.point) - ENERGY;
                let level = event.point.phi().determinant() - 1.0;
                worst = [spin, energy, level].iter().fold(worst, |worst, off| worst.max(off.abs()));
                let _ = write!(path, "M{:.1} {:.1}h0", 1100.0 * x - 20.0, 245.0 - 185.0 * rate);
            }
            if body.number % SHOWN == 0 {
                let colour = format!("hsl({}, 70%, 45%)", 47 * (body.number / SHOWN) % 360);
                let _ = writeln!(dots, "<path d='{path}' stroke='{colour}'/>");
            }
        },
    )?;
    println!("{} starts, {points} points of the section, {stopped} stopped", starts.len());
    println!("det phi = 1, energy and spin hold to {worst:.1e} at all of them");
    assert!(starts.len() == STARTS && stopped == 0 && points > 50 * STARTS && worst < 1e-7);
    fs::create_dir_all("output")?;
    let label = "<text x='300' y='490' font-size='14'>x = (q1 - q2)/2</text><text x='5' y='20' font-size='14'>x'</text>";
    let size = "xmlns='http://www.w3.org/2000/svg' width='720' height='500' stroke-width='1.4' stroke-linecap='round'";
    let paper = "<rect width='720' height='500' fill='white'/>";
    fs::write("output/section.svg", format!("<svg {size}>\n{paper}\n{label}\n{dots}</svg>\n"))?;
    table.save("output/section.npz", Format::Npz)?;
    table.note("energy", ENERGY);
    table.note("spin", SPIN);
    table.save("output/section.parquet", Format::Parquet)?;
    table.save("output/section.csv", Format::Csv)?;
    println!(
        "picture: output/section.svg; numbers: output/section.npz, output/section.parquet, output/section.csv"
    );
    Ok(())
}

/// At `q = 0`, with log-stretches `x` and `-x` along the axes, the momentum `px` of `x`, and the energy, spin and vorticity of
/// all; `None` where there is no such point.
fn start(x: f64, px: f64) -> Option<Point> {
    let (d1, d2) = (x.exp(), (-x).exp());
    // S = d1 Pi12 - d2 Pi21, V = d2 Pi12 - d1 Pi21.
    let determinant = d2 * d2 - d1 * d1;
    let pi12 = (d2 * VORTICITY - d1 * SPIN) / determinant;
    let pi21 = (d1 * VORTICITY - d2 * SPIN) / determinant;
    let at = |pq: f64| {
        let pi = Matrix::<2>::new((pq + px) / (2.0 * d1), pi12, pi21, (pq - px) / (2.0 * d2));
        Disc.at_momentum(Matrix::<2>::from_diagonal(&Vector::<2>::new(d1, d2)), TwoPoint(pi)).ok()
    };
    let energy = |pq: f64| Some(Disc.hamiltonian(0.0, &at(pq)?) - ENERGY);
    // H is quadratic in pq; the larger root expands.
    let (h0, plus, minus) = (energy(0.0)?, energy(1.0)?, energy(-1.0)?);
    let (a, b) = (0.5 * (plus + minus) - h0, 0.5 * (plus - minus));
    let root = b.mul_add(b, -4.0 * a * h0);
    (root > 0.0).then(|| at((root.sqrt() - b) / (2.0 * a))).flatten()
}

/// `x` and its rate: `cosh 2x = |phi|^2/(2 det phi)`.
fn of_section(point: &Point) -> (f64, f64) {
    let (phi, velocity) = (point.phi(), Disc.velocity(point).phi_dot);
    let determinant = phi.determinant();
    let cosh = phi.norm_squared() / (2.0 * determinant);
    let growth = phi.try_inverse().map_or(f64::NAN, |inverse| (inverse * velocity).trace());
    let rate = phi.dot(&velocity) / determinant - cosh * growth;
    (0.5 * cosh.acosh(), rate / (2.0 * (cosh * cosh - 1.0).sqrt()))
}
