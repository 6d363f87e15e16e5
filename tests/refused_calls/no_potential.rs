//! What a field is said to compute, its type computes.
use affine_runtime::prelude::*;

#[derive(Clone)]
struct Law;

#[affine_model(dim = 2, kinetic(casimir2 = 0.2, body_inertia = 1), potential = custom(law, green))]
struct Body {
    law: Law,
}

#[affine_model(dim = 2, kinetic(casimir2 = 0.2, body_inertia = 1, space_translation = 1), forces = custom(wind, translation))]
struct Sail {
    wind: Law,
}

/// A force on the centre that is stated as one on the spin.
struct Gust;

impl affine_runtime::force::Force<2> for Gust {
    type Form = affine_runtime::force::Translation;
    fn force<T: affine_runtime::scalar::Scalar>(&self, motion: &affine_runtime::force::Motion<2, T>) -> Vector<2, T> {
        motion.x_dot
    }
}

#[affine_model(dim = 2, kinetic(casimir2 = 0.2, body_inertia = 1, space_translation = 1), forces = custom(gust, spatial))]
struct Kite {
    gust: Gust,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let body = Body { law: Law }.prepare()?;
    let start = body.at_velocity(Matrix::<2>::identity(), Matrix::<2>::zeros())?;
    let run = Simulation::new(&body, start).until(1.0).every(0.1).run()?;
    println!("{}", body.hamiltonian(0.0, run.end().1));
    Ok(())
}
