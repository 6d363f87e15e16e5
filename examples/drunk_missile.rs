//! Drunk missile.
use affine_runtime::prelude::*;

/// Affine in space, metrical in the body.
#[affine_model(
    dim = 3,
    symmetry(space = affine, body = metric),
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, body_translation = 1),
)]
pub struct DrunkMissile;

fn main() -> affine_runtime::Result<()> {
    let phi = Matrix::<3>::new(1.1, 0.2, -0.1, 0.05, 0.9, 0.15, -0.2, 0.1, 1.05);
    let start = DrunkMissile.at_momentum(
        Vector::<3>::zeros(),
        phi,
        Vector::<3>::new(0.3, -0.2, 0.5),
        Comoving(Matrix::<3>::new(0.1, 0.4, -0.3, -0.2, -0.15, 0.25, 0.35, -0.1, 0.05)),
    )?;
    for f in DrunkMissile::DESCRIPTION.equations.iter().chain(DrunkMissile::DESCRIPTION.reduced_equations) {
        println!("{}", f.text);
    }
    println!("{}", DrunkMissile.hamiltonian(&start));
    let v = DrunkMissile.velocity(&start);
    println!("{}", DrunkMissile.kinetic_energy(start.phi(), &v));
    let (mut y, k) = DrunkMissile.reduce(0.0, &start);
    let steps = 10000;
    let h = 10.0 / steps as f64;
    for _ in 0..steps {
        let f = |y: &[f64; 12]| DrunkMissile.reduced_equations(0.0, &k, y);
        let add =
            |y: &[f64; 12], d: &[f64; 12], s: f64| -> [f64; 12] { core::array::from_fn(|i| y[i] + s * d[i]) };
        let k1 = f(&y);
        let k2 = f(&add(&y, &k1, h / 2.0));
        let k3 = f(&add(&y, &k2, h / 2.0));
        let k4 = f(&add(&y, &k3, h));
        y = core::array::from_fn(|i| y[i] + h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]));
    }
    let end = DrunkMissile.expand(10.0, &k, &y);
    println!("{} {}", end.x(), end.sigma_hat().0.0);
    Ok(())
}
