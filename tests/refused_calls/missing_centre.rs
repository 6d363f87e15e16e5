//! A body with translation starts with a centre of mass.
use affine_runtime::prelude::*;

#[affine_model(dim = 3, kinetic(casimir2 = 0.2, body_inertia = 1, space_translation = 2))]
struct Body;

fn main() -> affine_runtime::Result<()> {
    let (phi, phi_dot) = (Matrix::<3>::identity(), Matrix::<3>::zeros());
    let start = Body.at_velocity(phi, phi_dot)?;
    let other = Body.at_momentum(phi, Spatial(phi_dot))?;
    println!("{start:?} {other:?}");
    Ok(())
}
