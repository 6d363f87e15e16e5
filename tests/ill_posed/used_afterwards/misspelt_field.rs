use affine_runtime::prelude::*;

#[affine_model(dim = 3, kinetic(casimir2 = mass))]
pub struct Refused {
    pub mas: f64,
}

fn energy<const N: usize, M: Model<N>>(model: &M, point: &M::Point<f64>) -> f64 {
    model.hamiltonian(0.0, point)
}

fn main() -> affine_runtime::Result<()> {
    let model = Refused { mas: 1.0 }.prepare()?;
    let start = model.at_momentum(Matrix::<3>::identity(), Spatial(Matrix::<3>::zeros()))?;
    println!("{}", energy(&model, &start));
    Ok(())
}
