//! Changes where a root vanishes, against closed forms.

use affine_runtime::prelude::*;
use affine_runtime::variation::Variation;

/// Bodies at the centre swing by `norm(x)^2` alone, to first order.
#[test]
fn whole_powers_of_the_distance_change_at_the_centre() {
    macro_rules! at_the_centre {
        ($($power:literal)*) => { $( {
            #[affine_model(
                dim = 2,
                kinetic(dalembert = 1, space_translation = 1),
                potential = orthogonality(1) + norm(x)^2 + norm(x)^$power,
                emit(tangent)
            )]
            struct Body;
            let (zero, one) = (Vector::<2>::zeros(), Matrix::<2>::identity());
            let start = Body.at_velocity(zero, one, zero, Matrix::<2>::zeros()).unwrap();
            let mut direction = [0.0; 12];
            direction[0] = 1.0;
            let mut variation = Variation::new(&Body, (0.0, &start), &direction, 1e-12).unwrap();
            variation.advance_to(1.0).unwrap();
            let change = variation.change()[0];
            assert!((change - 2.0_f64.sqrt().cos()).abs() < 1e-10, "{} {change}", $power);
        } )* };
    }
    at_the_centre!(3 5 7);
}

/// An undeformed body in which the distance from it counts to the third power moves as if it were free, and so do its changes.
#[test]
fn whole_powers_of_a_strain_change_without_any() {
    #[affine_model(dim = 2, kinetic(dalembert = 1), potential = sqrt(tr((G - 1)^2))^3, emit(tangent))]
    struct Body;
    let start = Body.at_velocity(Matrix::<2>::identity(), Matrix::<2>::zeros()).unwrap();
    let direction = [0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0];
    let mut variation = Variation::new(&Body, (0.0, &start), &direction, 1e-12).unwrap();
    variation.advance_to(0.3).unwrap();
    let change = variation.change()[0];
    assert!((change - 0.3).abs() < 1e-12, "{change}");
}
