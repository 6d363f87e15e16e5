//! Closed-form geodesics: they exist exactly where they should, and are the motion.

use affine_oracle::Random;
use affine_runtime::prelude::*;

use crate::families::{Closed, Family, Parameters};
use crate::integrate::extrapolated;
use affine_tests::reference::{assert_close, entries, norm};
use affine_tests::tolerances::{GEODESIC, MARTIN_NEFF};

const SAMPLES: u64 = 6;
pub(crate) const T0: f64 = 0.25;
/// Steps to a time by which the body has turned or stretched by an angle or factor of order 1.
const STEPS: u32 = 48;

/// Closed forms exist at all states, at `p = 0` alone, or never, as the family has it; where they exist, they agree
/// with the integrated full equations, forward and backward.
fn are_the_motion<const N: usize, F: Family<N>>() {
    for seed in 0..SAMPLES {
        let mut random = Random::new(51 + seed);
        let (model, _) = F::with(&Parameters::random(N, &mut random));
        let state = F::random_state(&mut random);
        for (start, exists) in [
            (model.at(&state), F::CLOSED == Closed::Always || F::CLOSED == Closed::AtRest && !F::TRANSLATION),
            (model.at(&state.at_rest()), F::CLOSED != Closed::Never),
        ] {
            match model.geodesic(T0, &start) {
                None => assert!(!exists, "no closed form"),
                Some(geodesic) => {
                    assert!(exists, "a closed form");
                    assert_motion(&model, &start, |t| model.on_geodesic(&geodesic, t, &start));
                }
            }
        }
    }
}

/// A closed form against the integrated full equations.
pub(crate) fn assert_motion<const N: usize, F: Model<N>>(
    model: &F,
    start: &F::Point<f64>,
    closed: impl Fn(f64) -> F::Point<f64>,
) {
    let rate = model.velocity(start).phi_dot.norm() / start.phi().norm();
    for duration in [1.5 / rate, -0.75 / rate] {
        let equations = |y: &F::Full<f64>| model.hamilton_equations(0.0, y);
        let expected = model.unflatten(&extrapolated(&equations, model.flatten(start), duration, STEPS));
        let found = closed(T0 + duration);
        let close = |what, found: &[f64], expected: &[f64]| {
            assert_close(what, found, expected, norm(expected), GEODESIC);
        };
        close("x", found.x().as_slice(), expected.x().as_slice());
        close("p", found.p().as_slice(), expected.p().as_slice());
        close("phi", &entries(found.phi()), &entries(expected.phi()));
        close("Pi", &entries(&found.pi().0.0), &entries(&expected.pi().0.0));
    }
}

/// Where an isotropic energy is metrical.
#[derive(Clone, Copy)]
enum Metrical {
    Body,
    Space,
    /// Affine-affine: `I = 0`.
    Nowhere,
}

/// Body: `phi(t) = phi0 exp(t (sym M - w skew M)) exp(t (1 + w) skew M)`, `M = phi0^-1 phi_dot0`, `w = (I-A)/(I+A)`
/// (Martin and Neff, arXiv:1409.7849); space: the factors in the opposite order, `M = phi_dot0 phi0^-1`.
fn have_the_form_of_martin_and_neff<const N: usize, F: Family<N>>(
    metrical: Metrical,
    exponential: impl Fn(Matrix<N>) -> Matrix<N>,
) {
    for seed in 0..2 * SAMPLES {
        let mut random = Random::new(1409 + seed);
        let parameters = Parameters::random(N, &mut random);
        let (model, _) = F::with(&parameters);
        let start = model.at(&F::random_state(&mut random));
        let geodesic = model.geodesic(T0, &start).unwrap();
        let velocity = model.velocity(&start);
        let (i, a) = (parameters.field("i"), parameters.field("a"));
        let (w, m) = match metrical {
            Metrical::Body => ((i - a) / (i + a), start.omega_hat(&velocity).0.0),
            Metrical::Space => ((i - a) / (i + a), start.omega(&velocity).0.0),
            Metrical::Nowhere => (-1.0, start.omega(&velocity).0.0),
        };
        let skew = (m - m.transpose()) * 0.5;
        let (stretch, whirl) = (m - skew * (1.0 + w), skew * (1.0 + w));
        let rate = stretch.norm().max(whirl.norm());
        for elapsed in [1.5 / rate, -0.75 / rate] {
            let (stretched, turned) = (exponential(stretch * elapsed), exponential(whirl * elapsed));
            let expected = match metrical {
                Metrical::Body => start.phi() * stretched * turned,
                Metrical::Space | Metrical::Nowhere => turned * stretched * start.phi(),
            };
            let found = *model.on_geodesic(&geodesic, T0 + elapsed, &start).phi();
            let expected = entries(&expected);
            assert_close("phi", &entries(&found), &expected, norm(&expected), MARTIN_NEFF);
        }
    }
}

each_family!(are_the_motion);

/// nalgebra's exponential (Pade) is another one than the runtime's.
macro_rules! martin_and_neff {
    ($($test:ident: $family:ident $metrical:ident;)*) => { $(
        #[test]
        fn $test() {
            use crate::families::$family::{plane, space};
            have_the_form_of_martin_and_neff::<2, plane::PreparedBody>(Metrical::$metrical, |m| m.exp());
            have_the_form_of_martin_and_neff::<3, space::PreparedBody>(Metrical::$metrical, |m| m.exp());
        }
    )* };
}

martin_and_neff! {
    spatially_affine_geodesics_have_the_form_of_martin_and_neff: left Body;
    spatially_affine_with_free_centre_likewise: left_space_translation Body;
    materially_affine_geodesics_mirror_it: right Space;
    materially_affine_with_free_centre_likewise: right_space_translation Space;
    affine_affine_geodesics_are_one_parameter_groups: affine_affine Nowhere;
}
