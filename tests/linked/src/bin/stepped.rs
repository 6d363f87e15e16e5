//! Steps a body in a loop.
use affine_runtime::prelude::*;

/// A vibrating body.
#[affine_model(dim = 3, kinetic(dalembert = 1), potential = 0.5*(tr(G) - n) - ln(det))]
struct Body;

fn main() -> affine_runtime::Result<()> {
    let start = Body.at_velocity(Matrix::<3>::identity() * 1.1, Matrix::<3>::identity())?;
    let mut flow = Flow::new(&Body, (0.0, start))?;
    flow.advance(0.1)?;
    println!("{}", flow.point().phi());
    Ok(())
}
