use affine_runtime::lattice::TwoPolarForm;
use affine_runtime::prelude::*;

#[affine_model(
    dim = 2,
    kinetic(casimir2 = 1, space_translation = 1),
    potential = abs(q),
    emit(lanes, two_polar, metric),
)]
struct Refused;

fn main() -> affine_runtime::Result<()> {
    let (x, phi) = (Vector::<2>::zeros(), Matrix::<2>::identity());
    let start = Refused.at_velocity(x, phi, x, phi)?;
    let _ = Ensemble::new(&Refused, [start]).until(1.0).run();
    println!("{:?} {:?}", Refused.lattice(&start), Refused.metric(&phi));
    Ok(())
}
