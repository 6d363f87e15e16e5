//! A model in a crate without the standard library.
//!
//! Built together with the rest of the workspace the runtime has the feature `std`, which this crate cannot reach;
//! built alone (`-p affine-no-std`) the runtime is without it, too.
#![no_std]

use affine_runtime::prelude::*;

/// Affine in space, metrical in the body.
#[affine_model(
    dim = 3,
    symmetry(space = affine, body = metric),
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, body_translation = 1)
)]
pub struct DrunkMissile;

/// The same with a mass that is known at run time.
#[affine_model(
    dim = 3,
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, body_translation = m)
)]
pub struct HeavyMissile {
    /// The mass.
    pub m: f64,
}

/// A body that is drawn to the origin of space: its acceleration and its balance laws take roots of doubles.
#[affine_model(
    dim = 3,
    kinetic(dalembert = 1, space_translation = 1),
    potential = norm(x) + neo_hookean(0.5),
    emit(acceleration, balance)
)]
pub struct Drawn;

/// The placement after `steps` Euler steps of the reduced equations, and the energies before and after.
pub fn follow<M: Model<3>>(
    model: &M,
    start: &M::Point<f64>,
    step: f64,
    steps: usize,
) -> (Matrix<3>, [f64; 2]) {
    let (mut state, constants) = model.reduce(0.0, start);
    for _ in 0..steps {
        let rate = model.reduced_equations(0.0, &constants, &state);
        for (z, dz) in state.as_mut().iter_mut().zip(rate.as_ref()) {
            *z += step * dz;
        }
    }
    let end = model.expand(step * steps as f64, &constants, &state);
    (*end.phi(), [model.hamiltonian(0.0, start), model.hamiltonian(0.0, &end)])
}
