//! Runs a body that moves in straight lines, which may lead out of GL+(n).
use affine_runtime::prelude::*;

/// Flat, and free.
#[affine_model(dim = 3, kinetic(dalembert = 1))]
struct Body;

fn main() -> affine_runtime::Result<()> {
    let start = Body.at_velocity(Matrix::<3>::identity(), Matrix::<3>::identity())?;
    println!("{}", Simulation::new(&Body, start).until(1.0).run()?.end().1.phi());
    Ok(())
}
