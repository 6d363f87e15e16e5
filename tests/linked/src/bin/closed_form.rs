//! Runs a model whose every motion has a closed form.
use affine_runtime::prelude::*;

/// Affine in space, metrical in the body, without a centre.
#[affine_model(dim = 3, kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1))]
struct Body;

fn main() -> affine_runtime::Result<()> {
    let start = Body.at_velocity(Matrix::<3>::identity(), Matrix::<3>::identity())?;
    println!("{}", Simulation::new(&Body, start).until(1.0).run()?.end().1.phi());
    Ok(())
}
