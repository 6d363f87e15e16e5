use affine_runtime::prelude::*;

#[affine_model(
    dim = 2,
    kinetic(casimir2 = 1, space_translation = m),
    potential = kappa*abs(q) + m*x[3],
)]
#[derive(Clone)]
pub struct Refused {
    pub m: f64,
    pub kappa: f64,
}

fn energy<const N: usize, M: Model<N>>(model: &M, point: &M::Point<f64>) -> f64 {
    model.hamiltonian(0.0, point)
}

fn main() -> affine_runtime::Result<()> {
    let model: PreparedRefused = Refused { m: 1.0, kappa: 2.0 }.prepare()?;
    let (x, phi) = (Vector::<2>::zeros(), Matrix::<2>::identity());
    let start = model.at_velocity(x, phi, x, phi)?;
    println!("{}", energy(&model, &start));
    Ok(())
}
