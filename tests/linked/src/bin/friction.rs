//! With friction, which may be stiff.
use affine_runtime::prelude::*;

/// A vibrating body.
#[affine_model(
    dim = 3,
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1),
    potential = 5*sinh(q)^2 + 0.5*(tr(G)*exp(-2*q) - n),
    dissipation(body_inertia = 0.1)
)]
struct Body;

fn main() -> affine_runtime::Result<()> {
    let start = Body.at_velocity(Matrix::<3>::identity() * 1.1, Matrix::<3>::identity())?;
    println!("{}", Simulation::new(&Body, start).until(1.0).run()?.end().1.phi());
    Ok(())
}
