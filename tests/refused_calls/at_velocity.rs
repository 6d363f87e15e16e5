use affine_runtime::prelude::*;

#[affine_model(dim = 3, hamiltonian(casimir2 = 1, vorticity_squared = 2, casimir3 = 0.1))]
struct Model;

fn main() -> affine_runtime::Result<()> {
    let start = Model.at_velocity(Matrix::<3>::identity(), Matrix::<3>::zeros())?;
    println!("{start:?}");
    Ok(())
}
