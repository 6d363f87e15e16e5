//! Fast lanes err by less than is said.

use affine_integrators::lanes::FAST_ULP;
use affine_oracle::Random;
use affine_runtime::lanes::{FastF64x8, Lanes};
use affine_runtime::scalar::{Real, Scalar};
use qd::Quad;

use crate::models::between;

/// A function, by its name, and where it has normal values.
type Function<S> = (&'static str, fn(S) -> S, fn(f64) -> bool);

/// The functions that fast lanes have of their own, with the numbers of which they have normal values, in double-double too.
fn functions<S: Scalar>() -> [Function<S>; 10] {
    [
        ("cbrt", S::cbrt, |_| true),
        ("inverse_cbrt", S::inverse_cbrt, |x| x != 0.0),
        ("exp", S::exp, |x| (-708.0..709.0).contains(&x)),
        ("exp_m1", S::exp_m1, |x| x < 709.0),
        ("ln", S::ln, |x| x > 0.0),
        ("ln_1p", S::ln_1p, |x| x > -1.0),
        ("sinh", S::sinh, |x| x.abs() < 709.0),
        ("cosh", S::cosh, |x| x.abs() < 709.0),
        ("tanh", S::tanh, |_| true),
        ("asinh", S::asinh, |_| true),
    ]
}

/// The distance of two numbers in units of the last place of the second, which is normal.
fn ulps(found: f64, exact: Quad) -> f64 {
    let nearest = exact.to_f64();
    let ulp = nearest.abs() - nearest.abs().next_down();
    ((Quad::from(found) - exact).to_f64() / ulp).abs()
}

fn errors_are_bounded<T: Lanes>() {
    let mut random = Random::new(29);
    let mut number = |k: u32| match k % 4 {
        0 => between(&mut random, -1.0, 1.0) * between(&mut random, -300.0, 1000.0).exp2(),
        1 => between(&mut random, -745.0, 711.0),
        2 => 1.0 + between(&mut random, -1.0, 1.0) * between(&mut random, -50.0, 1.0).exp2(),
        _ => between(&mut random, -2.0, 2.0),
    };
    let mut worst = [0.0_f64; 10];
    for k in 0..10_000 {
        let numbers = [(); 8].map(|()| number(k));
        let lanes = T::from_lanes(|lane| numbers[lane]);
        for ((worst, (name, in_lanes, defined)), (_, exact, _)) in
            worst.iter_mut().zip(functions::<T>()).zip(functions::<Quad>())
        {
            let values = in_lanes(lanes);
            for lane in (0..T::LANES).filter(|lane| defined(numbers[*lane])) {
                let error = ulps(values.lane(lane), exact(Quad::from(numbers[lane])));
                assert!(!error.is_nan(), "{name}({})", numbers[lane]);
                *worst = worst.max(error);
            }
        }
    }
    for (worst, (name, ..)) in worst.into_iter().zip(functions::<T>()) {
        println!("{name}: {worst:.2} ulp, {} lanes", T::LANES);
        assert!(worst < FAST_ULP, "{name}: {worst}");
    }
}

#[test]
fn fast_functions_err_by_less_than_is_said() {
    errors_are_bounded::<FastF64x8>();
}

/// Zeros with their signs, infinities, what is not a number, subnormal numbers, and overflow where the value overflows.
#[test]
fn fast_functions_at_the_ends_are_those_of_scalars() {
    let ends = [
        0.0,
        -0.0,
        f64::INFINITY,
        f64::NEG_INFINITY,
        f64::NAN,
        f64::MAX,
        f64::MIN,
        -1.0,
        1e-310,
        5e-324,
        f64::MIN_POSITIVE,
        709.8,
        710.4,
        710.6,
        -745.0,
        -746.0,
    ];
    for x in ends {
        let lanes = FastF64x8::from_lanes(|_| x);
        for ((name, fast, _), (_, strict, _)) in functions::<FastF64x8>().iter().zip(functions::<f64>()) {
            let (found, expected) = (fast(lanes).lane(3), strict(x));
            let same = found == expected && found.is_sign_positive() == expected.is_sign_positive();
            let close = (found - expected).abs() <= (4.0 * f64::EPSILON * expected.abs()).max(5e-324);
            assert!(
                same || close || (found.is_nan() && expected.is_nan()),
                "{name}({x:e}): {found:e} {expected:e}"
            );
        }
    }
}
