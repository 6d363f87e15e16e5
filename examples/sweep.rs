//! A sweep over two fields: which bodies come apart? A million of them, each of a model of its own.
//!
//! The dilatation `q` of a body that is affine in space and metrical in itself moves by itself, whatever the shear does,
//!
//! ```text
//! E = (I + A + 2 B) q'^2 + d (1 - exp(-a q))^2            comes apart where E > d
//! ```
//!
//! in a well of the depth `d` and the width `1/a`. The picture of the boundary and the bodies next to it go to `output/`.
//! `cargo run --release --features tables --example sweep 10000000` takes ten million bodies, in the same memory.

use std::fs;
use std::time::Instant;

use affine_runtime::model::Owned;
use affine_runtime::prelude::*;
use affine_runtime::report::{Curve, CurveDiagram, CurvePanel};
use affine_runtime::simulate::{Format, Table};

/// A planar body under a potential of Morse in its dilatation, with a soft shear.
#[affine_model(
    dim = 2,
    symmetry(space = affine, body = metric),
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1),
    potential = depth*(1 - exp(-a*q))^2 + 0.1*(tr(G)/det - 2),
    emit(lanes),
)]
#[derive(Clone)]
pub struct Bound {
    depth: f64,
    a: f64,
}

/// Dilatation and its rate at the start.
const Q: f64 = 0.3;
const RATE: f64 = 0.5;
const DEPTHS: (f64, f64) = (0.2, 1.2);
const WIDTHS: (f64, f64) = (1.0, 3.0);
const T_END: f64 = 40.0;
/// A body with this dilatation is apart.
const APART: f64 = 4.0;
/// With energies so near to the depth, relative to it, bodies take longer than they have to come so far, or come so far and
/// return: `q` up to `-ln(1 - sqrt(E/d))/a`.
const NEAR: f64 = 0.04;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let asked = std::env::args().nth(1).map_or(Ok(1_000_000), |count| count.parse::<u64>())?;
    let rows = asked.isqrt().max(2);
    let place = |number: u64| {
        let part =
            |index: u64, (low, high): (f64, f64)| low + (high - low) * index as f64 / (rows - 1) as f64;
        Bound { a: part(number / rows, WIDTHS), depth: part(number % rows, DEPTHS) }
    };
    let bodies = (0..rows * rows).map(|number| {
        let model = place(number).prepare()?;
        let phi = Q.exp() * Matrix::<2>::identity();
        let start = model.at_velocity(phi, phi * Matrix::<2>::new(RATE, 0.4, -0.1, RATE))?;
        Ok((Owned(model), start))
    });
    // All numbers in the ranges are sound: what is not would be missing, and the count below would show it.
    let bodies = bodies.filter_map(affine_runtime::Result::ok);
    let (mut boundary, mut bound, mut wrong, mut near) = (Vec::new(), 0, 0, 0);
    let mut at_boundary = Table::of_bodies::<2, PreparedBound>(&["a", "depth"])?;
    let begin = Instant::now();
    let mut last = 0.0;
    Ensemble::of(bodies).until(T_END).tolerance(1e-6).progress_bar().fold(
        |_, _| (),
        |(), _, _| (),
        |body| {
            let Bound { depth: d, a } = place(body.number);
            // One that has not come to the end counts as wrong.
            let apart = body.end.as_ref().map(|point| 0.5 * point.phi().determinant().ln() > APART);
            let energy = 1.4 * RATE * RATE + d * (1.0 - (-a * Q).exp()).powi(2);
            let is_near = (energy - d).abs() < NEAR * d;
            near += u64::from(is_near);
            wrong += u64::from(!is_near && apart != Ok(energy > d));
            bound += u64::from(apart == Ok(false));
            if let (Ok(false), Ok(point), 1.0) = (&apart, &body.end, last) {
                boundary.push((a, d));
                at_boundary.push::<2, PreparedBound>(body.number, &[a, d], T_END, point);
            }
            last = if apart == Ok(true) { 1.0 } else { 0.0 };
        },
    )?;
    let bodies = rows * rows;
    let seconds = begin.elapsed().as_secs_f64();
    println!(
        "{bodies} bodies in {seconds:.1} s, {:.2} us each; most memory {}",
        1e6 * seconds / bodies as f64,
        memory()
    );
    println!("{bound} stay together, {} come apart; {near} too near to the boundary to tell", bodies - bound);
    println!("{wrong} are not where the closed form has them");
    let exact = |a: f64| 1.4 * RATE * RATE / (1.0 - (1.0 - (-a * Q).exp()).powi(2));
    let off = boundary.iter().map(|(a, d)| (d - exact(*a)).abs()).fold(0.0, f64::max);
    println!(
        "the boundary is off by at most {off:.1e}, between depths {:.1e} apart",
        1.0 / (rows - 1) as f64
    );
    assert!(
        wrong == 0 && boundary.len() as u64 == rows,
        "{wrong} wrong of {bodies}, {} columns",
        boundary.len()
    );
    fs::create_dir_all("output")?;
    at_boundary.save("output/sweep.parquet", Format::Parquet)?;
    println!("the bodies at it: output/sweep.parquet");
    draw(boundary, (0..=100).map(|k| 1.0 + 0.02 * f64::from(k)).map(|a| (a, exact(a))).collect())
}

fn draw(found: Vec<(f64, f64)>, exact: Vec<(f64, f64)>) -> Result<(), Box<dyn std::error::Error>> {
    let curves = vec![Curve { category: 0, points: found }, Curve { category: 1, points: exact }];
    let (x, y) = ("a".into(), "depth d".into());
    let panel = CurvePanel { x, y, logarithmic: false, range: None, curves };
    let diagram =
        CurveDiagram::new("Bodies stay together above (blue: found, red: closed form)", vec![panel]);
    diagram.save_svg("output/sweep.svg")?;
    println!("picture: output/sweep.svg");
    Ok(())
}

/// The most that the process has had, where the system says so.
fn memory() -> String {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    line.map_or_else(|| "unknown".to_owned(), |size| size.trim().to_owned())
}
