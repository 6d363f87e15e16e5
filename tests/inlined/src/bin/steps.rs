//! Steps of one body by three methods, and of bodies in lanes.

use affine_runtime::prelude::*;

/// As in `vibrating_ensemble`.
#[affine_model(
    dim = 3,
    symmetry(space = affine, body = metric),
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1),
    potential = hyperbolic_dilatation(10) + neo_hookean(0.5),
    emit(lanes, taylor),
)]
struct Vibrating;

/// With equations of second order.
#[affine_model(dim = 3, kinetic(dalembert = 1), potential = hyperbolic_dilatation(10) + neo_hookean(0.5), emit(nystrom))]
struct Flat;

fn main() -> affine_runtime::Result<()> {
    let (phi, spin) = (Matrix::<3>::identity() * 1.1, Matrix::<3>::identity());
    let start = Vibrating.at_momentum(phi, Comoving(spin))?;
    for method in [Method::RungeKutta8, Method::Taylor { order: None }] {
        println!("{:?}", Simulation::new(&Vibrating, start).until(1.0).method(method).run()?.end());
    }
    println!("{:?}", Ensemble::new(&Vibrating, [start; 8]).until(1.0).run()?);
    let start = Flat.at_momentum(phi, TwoPoint(spin))?;
    println!("{:?}", Simulation::new(&Flat, start).until(1.0).run()?.end());
    Ok(())
}
