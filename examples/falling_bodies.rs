//! Soft bodies that fall: 200 affine bodies in a frame loop, 60 frames a second, by splitting of order 2.
//!
//! Each body is a `Flow` with a model of its own, stepped from frame to frame as a game or a controller would. What is measured
//! is the time of one step of one body with everything that a frame does; what is checked is where the centres of mass are,
//! which gravity alone moves, and the energies.
//!
//! Run times on shared machines are noise: the least of several seconds counts.

use std::time::Instant;

use affine_runtime::model::Owned;
use affine_runtime::prelude::*;

/// A cube of unit edge and mass that resists whatever is no rotation, as in affine body dynamics.
#[affine_model(
    dim = 3,
    kinetic(dalembert = 1/12, space_translation = 1),
    potential = orthogonality(1e4) + g*x[3],
    emit(splitting),
)]
#[derive(Clone, Copy)]
pub struct Cube {
    /// Acceleration of free fall.
    pub g: f64,
}

const BODIES: usize = 200;
const SECONDS: u32 = 10;
const FRAMES: u32 = 60;
/// Steps of a frame. The vibration of a stretch, of angular frequency `sqrt(8 k/m) = 980`, takes six of them.
const STEPS: u32 = 16;
const GRAVITY: f64 = 9.81;

type Body = Flow<'static, 3, Owned<PreparedCube>>;

fn main() -> affine_runtime::Result<()> {
    let mut bodies = (0..BODIES).map(body).collect::<affine_runtime::Result<Vec<Body>>>()?;
    let starts: Vec<_> = bodies.iter().map(Flow::point).collect();
    let mut least = f64::INFINITY;
    println!("{BODIES} bodies, {FRAMES} frames a second, {STEPS} steps a frame");
    for second in 1..=SECONDS {
        let began = Instant::now();
        for frame in (second - 1) * FRAMES + 1..=second * FRAMES {
            for body in &mut bodies {
                body.advance_to(f64::from(frame) / f64::from(FRAMES))?;
            }
        }
        let steps = BODIES as f64 * f64::from(FRAMES * STEPS);
        let cost = began.elapsed().as_secs_f64() * 1e9 / steps;
        least = least.min(cost);
        println!("t = {second:>2}: {cost:.0} ns a body and step");
    }
    println!("least: {least:.0} ns a body and step");

    let (mut off, mut swing) = (0.0_f64, 0.0_f64);
    for (body, start) in bodies.iter().zip(&starts) {
        let (t, point) = (body.t(), body.point());
        let fallen = start.x()[2] - 0.5 * GRAVITY * t * t;
        off = off.max((point.x()[2] - fallen).abs() / fallen.abs());
        let energy = |point| body.model().hamiltonian(t, point);
        swing = swing.max((energy(&point) - energy(start)).abs() / energy(start).abs());
    }
    println!(
        "centres of mass after {SECONDS} s: {off:.1e} off x0 - g t^2/2, energies {swing:.1e} off the first"
    );
    assert!(off < 1e-12 && swing < 0.1, "the bodies fall as they should");
    Ok(())
}

/// A body that spins, each another way.
fn body(k: usize) -> affine_runtime::Result<Body> {
    let cube = Cube { g: GRAVITY }.prepare()?;
    let part = k as f64 / BODIES as f64;
    let x = Vector::<3>::new(2.0 * k as f64, 0.0, 600.0);
    let spin = Matrix::<3>::new(0.0, -1.0, part, 1.0, 0.0, -0.3, -part, 0.3, 0.0);
    let start = cube.at_velocity(x, Matrix::identity(), Vector::zeros(), spin)?;
    let step = 1.0 / f64::from(FRAMES * STEPS);
    Flow::by(Method::Splitting { order: 2, step }, Owned(cube), (0.0, start)).map_err(Into::into)
}
