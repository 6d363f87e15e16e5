//! A dilatation that may be stiff, as a piece of a splitting.
use affine_runtime::prelude::*;

/// A vibrating missile.
#[affine_model(
    dim = 3,
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, body_translation = 1),
    potential = hyperbolic_dilatation(10) + neo_hookean(0.5),
    emit(splitting)
)]
struct Body;

fn main() -> affine_runtime::Result<()> {
    let velocity = Vector::<3>::new(0.1, 0.0, 0.0);
    let phi = Matrix::<3>::identity();
    let start = Body.at_velocity(Vector::<3>::zeros(), phi * 1.1, velocity, phi)?;
    println!("{}", Simulation::new(&Body, start).until(1.0).run()?.end().1.phi());
    Ok(())
}
