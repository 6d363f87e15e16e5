use affine_runtime::prelude::*;

#[affine_model(dim = 3, kinetic(casimir3 = 1))]
struct Refused;

fn energy<const N: usize, M: Model<N>>(model: &M, point: &M::Point<f64>) -> f64 {
    model.hamiltonian(0.0, point)
}

fn main() -> affine_runtime::Result<()> {
    let start = Refused.at_momentum(Matrix::<3>::identity(), Spatial(Matrix::<3>::zeros()))?;
    println!("{}", energy(&Refused, &start));
    Ok(())
}
