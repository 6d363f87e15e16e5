//! Pictures are drawn by `report`.
use affine_runtime::prelude::*;

#[affine_model(dim = 2, kinetic(casimir2 = 0.2, body_inertia = 1))]
struct Disc;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let start = Disc.at_velocity(Matrix::<2>::identity(), Matrix::<2>::zeros())?;
    let run = Simulation::new(&Disc, start).until(1.0).every(0.1).run()?;
    run.save_svg("disc.svg")?;
    println!("{}", run.to_svg());
    run.save_html("disc.html")?;
    println!("{}", run.to_html());
    Ok(())
}
