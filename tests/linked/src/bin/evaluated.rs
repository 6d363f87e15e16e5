//! Evaluates a model and integrates nothing.
use affine_runtime::prelude::*;

/// A drunk missile.
#[affine_model(
    dim = 3,
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, body_translation = 1)
)]
struct Missile;

fn main() -> affine_runtime::Result<()> {
    let still = Vector::<3>::zeros();
    let point = Missile.at_velocity(still, Matrix::<3>::identity(), still, Matrix::<3>::identity())?;
    println!("{}", Missile.hamiltonian(0.0, &point));
    Ok(())
}
