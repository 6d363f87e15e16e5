use affine_runtime::prelude::*;

#[affine_model(dim = 2, kinetic(casimir2 = 1, body_translation = 0))]
struct Refused;

fn energy<const N: usize, M: Model<N>>(model: &M, point: &M::Point<f64>) -> f64 {
    model.hamiltonian(0.0, point)
}

fn main() -> affine_runtime::Result<()> {
    let (x, phi) = (Vector::<2>::zeros(), Matrix::<2>::identity());
    let start = Refused.at_velocity(x, phi, x, phi)?;
    println!("{}", energy(&Refused, &start));
    Ok(())
}
