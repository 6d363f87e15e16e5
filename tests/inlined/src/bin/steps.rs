//! Steps of one body by three methods, and of bodies in lanes by two.

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

/// As in `falling_bodies`: in lanes it is looked at whether it keeps its orientation within steps.
#[affine_model(
    dim = 3,
    kinetic(dalembert = 1/12, space_translation = 1),
    potential = orthogonality(1e4) + 9.81*x[3],
    emit(lanes, splitting),
)]
struct Cube;

fn main() -> affine_runtime::Result<()> {
    let (phi, spin) = (Matrix::<3>::identity() * 1.1, Matrix::<3>::identity());
    let start = Vibrating.at_momentum(phi, Comoving(spin))?;
    for method in [Method::RungeKutta8, Method::Taylor { order: None }] {
        println!("{:?}", Simulation::new(&Vibrating, start).until(1.0).method(method).run()?.end());
    }
    println!("{:?}", Ensemble::new(&Vibrating, [start; 8]).until(1.0).run()?);
    let start = Flat.at_momentum(phi, TwoPoint(spin))?;
    println!("{:?}", Simulation::new(&Flat, start).until(1.0).run()?.end());
    let (x, v) = (Vector::<3>::new(0.0, 0.0, 10.0), Vector::<3>::new(0.0, 0.0, 0.0));
    let start = Cube.at_velocity(x, Matrix::<3>::identity(), v, 0.1 * spin)?;
    let mut cubes = Flows::by_splitting((2, 1e-3), 0.0, [(&Cube, start); 8])?;
    cubes.advance(1.0)?;
    println!("{:?}", cubes.point(7));
    let mut cubes = Flows::by_runge_kutta(1e-9, 0.0, [(&Cube, start); 8])?;
    cubes.advance(1.0)?;
    println!("{:?}", cubes.point(7));
    Ok(())
}
