use affine_runtime::prelude::*;

#[affine_model(dim = 3, hamiltonian(casimir3 = c, space_translation = 1))]
struct Model {
    c: f64,
}

fn main() -> affine_runtime::Result<()> {
    let (x, phi) = (Vector::<3>::zeros(), Matrix::<3>::identity());
    let start = Model { c: 1.0 }.prepare()?.at_velocity(x, phi, x, phi)?;
    println!("{start:?}");
    Ok(())
}
