//! A struct with fields becomes a model when it is prepared.
use affine_runtime::prelude::*;

#[affine_model(dim = 3, kinetic(casimir2 = a, body_inertia = 1))]
struct Body {
    a: f64,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let body = Body { a: 0.2 };
    let start = body.at_velocity(Matrix::<3>::identity(), Matrix::<3>::zeros())?;
    let run = Simulation::new(&body, start).until(1.0).every(0.1).run()?;
    println!("{}", body.hamiltonian(0.0, run.end().1));
    Ok(())
}
