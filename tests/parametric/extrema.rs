//! `Scalar::max` and `Scalar::min` for every kind of number.

use affine_runtime::counting::Counting;
use affine_runtime::dual::Dual;
use affine_runtime::lanes::{F64x8, FastF64x8, Lanes};
use affine_runtime::scalar::{Real, Scalar};
use affine_tests::dual::Dual as Plain;
use qd::Quad;

const NUMBERS: [f64; 9] = [-3.5, -1.0, -1e-300, 0.0, 1e-300, 0.1, 1.0, 7.25, 1e300];

fn pairs() -> impl Iterator<Item = (f64, f64)> {
    NUMBERS.into_iter().flat_map(|a| NUMBERS.into_iter().map(move |b| (a, b)))
}

/// The larger and the smaller by what the order of numbers is.
fn ordered<T: Real>(of: impl Fn(f64) -> T) {
    for (a, b) in pairs() {
        let (least, most) = if a < b { (a, b) } else { (b, a) };
        assert_eq!(Scalar::max(of(a), of(b)), of(most), "{a} {b}");
        assert_eq!(Scalar::min(of(a), of(b)), of(least), "{a} {b}");
    }
    for (a, b) in [(f64::NAN, 1.0), (1.0, f64::NAN)] {
        assert!(!Scalar::max(of(a), of(b)).is_finite() && !Scalar::min(of(a), of(b)).is_finite());
    }
}

#[test]
fn ordered_numbers() {
    ordered(|x| x);
    ordered(|x| f32::constant(x.clamp(-1e30, 1e30), 0.0));
    ordered(Counting::from_f64);
    ordered(|x| Quad::constant(x, 1e-17 * x));
    ordered(|x| Dual { value: x, slope: 0.0 });
    assert_eq!(Scalar::max(f64::INFINITY, f64::NEG_INFINITY), f64::INFINITY);
}

/// Numbers that differ in the second double alone.
#[test]
fn the_last_of_106_bits_decides() {
    let (a, b) = (Quad::constant(1.0, 1e-20), Quad::constant(1.0, 2e-20));
    assert_eq!((Scalar::max(a, b), Scalar::min(a, b)), (b, a));
}

/// Each lane has the bits that a number alone has.
#[test]
fn lanes_are_numbers_alone() {
    fn same<T: Lanes>() {
        for (a, b) in pairs().chain([(0.0, -0.0), (-0.0, 0.0), (f64::NEG_INFINITY, 1.0)]) {
            let of = |x: f64| T::from_lanes(|lane| if lane % 2 == 0 { x } else { -x });
            let (most, least) = (Scalar::max(of(a), of(b)), Scalar::min(of(a), of(b)));
            for (lane, sign) in (0..T::LANES).zip([1.0, -1.0].into_iter().cycle()) {
                assert_eq!(most.lane(lane).to_bits(), Scalar::max(sign * a, sign * b).to_bits(), "{a} {b}");
                assert_eq!(least.lane(lane).to_bits(), Scalar::min(sign * a, sign * b).to_bits(), "{a} {b}");
            }
        }
    }
    same::<F64x8>();
    same::<FastF64x8>();
}

/// The slope is that of the number that is taken, also where a type has no rule of its own.
#[test]
fn slopes_are_those_of_the_number_taken() {
    for (a, b) in pairs().filter(|(a, b)| a != b) {
        let (taken, left) = if a > b { (2.0, -5.0) } else { (-5.0, 2.0) };
        let [x, y] = [(a, 2.0), (b, -5.0)].map(|(value, slope)| Dual { value, slope });
        assert_eq!((Scalar::max(x, y).slope, Scalar::min(x, y).slope), (taken, left));
        let [x, y] = [(a, 2.0), (b, -5.0)].map(|(value, slope)| Plain { value, slope });
        assert_eq!((Scalar::max(x, y).slope, Scalar::max(x, y).value), (taken, f64::max(a, b)));
        assert_eq!((Scalar::min(x, y).slope, Scalar::min(x, y).value), (left, f64::min(a, b)));
    }
}
