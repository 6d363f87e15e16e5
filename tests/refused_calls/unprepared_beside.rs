//! The points of a prepared model are none of the struct that it was prepared from.
use affine_runtime::prelude::*;

#[affine_model(dim = 3, kinetic(casimir2 = a, body_inertia = 1))]
struct Body {
    a: f64,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let body = Body { a: 0.2 };
    let start = body.prepare()?.at_velocity(Matrix::<3>::identity(), Matrix::<3>::zeros())?;
    let run = Simulation::new(&body, start).until(1.0).run()?;
    println!("{}", run.end().0);
    Ok(())
}
