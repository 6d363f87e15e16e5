//! Exact numbers against big fractions, with care at the edge of the machine word.

use affine_codegen::algebra::Rational;
use affine_oracle::{Rational as Exact, exact as of_double, rounded};
use num_bigint::BigInt;
use num_traits::{Signed, Zero};
use proptest::prelude::*;

use super::points::{exact, own};

/// Small numbers, numbers at the limits of `i64`, and numbers far beyond them.
fn integer() -> impl Strategy<Value = BigInt> {
    let edge =
        prop_oneof![Just(0_i128), Just(i128::from(i64::MAX)), Just(i128::from(i64::MIN)), Just(1 << 32)];
    prop_oneof![
        4 => (-12_i64..=12).prop_map(BigInt::from),
        2 => any::<i64>().prop_map(BigInt::from),
        3 => (edge, -2_i128..=2, prop::bool::ANY).prop_map(|(edge, step, minus)| {
            BigInt::from(if minus { -edge } else { edge } + step)
        }),
        1 => (any::<i128>(), any::<i64>()).prop_map(|(a, b)| BigInt::from(a) * BigInt::from(b)),
    ]
}

fn fraction() -> impl Strategy<Value = Exact> {
    (integer(), integer()).prop_filter_map("denominator", |(n, d)| (!d.is_zero()).then(|| Exact::new(n, d)))
}

proptest! {
    #[test]
    fn sums_products_order_and_equality(a in fraction(), b in fraction()) {
        let (x, y) = (own(&a), own(&b));
        prop_assert_eq!(exact(&x), a.clone());
        prop_assert_eq!(exact(&(&x + &y)), &a + &b);
        prop_assert_eq!(exact(&(&x - &y)), &a - &b);
        prop_assert_eq!(exact(&(&x * &y)), &a * &b);
        prop_assert_eq!(exact(&-&x), -&a);
        prop_assert_eq!(exact(&x.abs()), a.abs());
        prop_assert_eq!(x.cmp(&y), a.cmp(&b));
        prop_assert_eq!(x == y, a == b);
        prop_assert_eq!((x.is_zero(), x.is_negative(), x.is_integer()), (a.is_zero(), a.is_negative(), a.is_integer()));
        prop_assert_eq!(x.is_one(), a == Exact::from_integer(1.into()));
        prop_assert_eq!(x.to_i64(), a.is_integer().then(|| i64::try_from(a.to_integer()).ok()).flatten());
        prop_assert_eq!(x.checked_div(&y).map(|q| exact(&q)), (!b.is_zero()).then(|| &a / &b));
    }

    /// One representation for each number: what shrinks back to words equals what never left them.
    #[test]
    fn field_axioms(a in fraction(), b in fraction(), c in fraction()) {
        let (a, b, c) = (own(&a), own(&b), own(&c));
        prop_assert_eq!(&a + &b, &b + &a);
        prop_assert_eq!(&a * &b, &b * &a);
        prop_assert_eq!(&(&a + &b) + &c, &a + &(&b + &c));
        prop_assert_eq!(&(&a * &b) * &c, &a * &(&b * &c));
        prop_assert_eq!(&a * &(&b + &c), &(&a * &b) + &(&a * &c));
        prop_assert_eq!(&(&a + &b) - &b, a.clone());
        prop_assert!((&a - &a).is_zero());
        match a.recip() {
            None => prop_assert!(a.is_zero()),
            Some(inverse) => {
                prop_assert!((&a * &inverse).is_one());
                prop_assert_eq!(inverse.recip(), Some(a.clone()));
                prop_assert_eq!(&(&b * &a) * &inverse, b);
            }
        }
    }

    #[test]
    fn powers(a in fraction(), exponent in -9_i32..=9) {
        let expected = (!a.is_zero() || exponent >= 0).then(|| {
            let one = Exact::from_integer(1.into());
            let power = (0..exponent.unsigned_abs()).fold(one, |power, _| power * &a);
            if exponent < 0 { power.recip() } else { power }
        });
        prop_assert_eq!(own(&a).pow(exponent).map(|p| exact(&p)), expected);
    }

    /// A decimal literal is the fraction it denotes, and its double is the one the compiler would read.
    #[test]
    fn decimal_literals(digits in "[0-9]{1,25}", fraction in "[0-9]{0,25}", power in -330_i32..=300, style in 0..4) {
        let text = match style {
            0 => digits.clone(),
            1 => format!("{digits}.{fraction}"),
            2 => format!("{digits}.{fraction}e{power}"),
            _ => format!("{digits}E{power}"),
        };
        let (fraction, power) = match style {
            0 => ("", 0),
            1 => (fraction.as_str(), 0),
            2 => (fraction.as_str(), power),
            _ => ("", power),
        };
        let value = Rational::parse_decimal(&text).unwrap();
        let mut expected = Exact::from_integer(format!("{digits}{fraction}").parse().unwrap());
        let shift = power - i32::try_from(fraction.len()).unwrap();
        let ten = Exact::from_integer(BigInt::from(10).pow(shift.unsigned_abs()));
        expected = if shift < 0 { expected / ten } else { expected * ten };
        prop_assert_eq!(exact(&value), expected);
        prop_assert_eq!(value.to_doubles().0.to_bits(), text.parse::<f64>().unwrap().to_bits(), "{}", text);
        let underscored: String = text.chars().flat_map(|c| if c == '0' { vec!['0', '_'] } else { vec![c] }).collect();
        prop_assert_eq!(Rational::parse_decimal(&underscored), Some(value));
    }

    /// `hi` is the nearest double, and `lo` the double nearest to what it leaves: `|value - hi - lo| <= ulp(lo)/2`.
    #[test]
    fn two_doubles(a in fraction()) {
        let (hi, lo) = own(&a).to_doubles();
        prop_assert_eq!(hi.to_bits(), rounded(&a).to_bits());
        let rest = &a - of_double(hi).unwrap();
        prop_assert_eq!(lo.to_bits(), rounded(&rest).to_bits());
        let left = (rest - of_double(lo).unwrap()).abs();
        // 2^-106 |value|: 53 bits for hi and 53 for lo.
        prop_assert!(left * Exact::from_integer(BigInt::from(1) << 106) <= a.abs());
    }

    /// Half of the digits of a double, whose last 27 are zero, and the rest in two doubles.
    #[test]
    fn two_halves(a in fraction()) {
        let [half, rest, left] = own(&a).to_halves();
        prop_assert_eq!(half.to_bits() & 0x7ff_ffff, 0);
        let lacking = &a - of_double(half).unwrap();
        prop_assert!(lacking.abs() * Exact::from_integer(BigInt::from(1) << 25) <= a.abs());
        prop_assert_eq!(rest.to_bits(), rounded(&lacking).to_bits());
        prop_assert_eq!(left.to_bits(), rounded(&(lacking - of_double(rest).unwrap())).to_bits());
    }
}

#[test]
fn the_edge_of_the_word() {
    let least = Rational::from(i64::MIN);
    let beyond: BigInt = BigInt::from(i64::MAX) + 1;
    assert_eq!(exact(&-&least), Exact::from_integer(beyond.clone()));
    assert_eq!(-&-&least, least);
    assert_eq!(exact(&least.recip().unwrap()), Exact::new((-1).into(), beyond));
    assert_eq!(&(&least - &Rational::ONE) + &Rational::ONE, least);
    assert_eq!(Rational::ratio(i64::MIN, i64::MIN), Some(Rational::ONE));
    assert_eq!(Rational::ratio(i64::MIN, -1), Some(-&least));
    assert_eq!(Rational::ratio(1, 0), None);
    let large = Rational::parse_decimal("1e40").unwrap();
    assert_eq!(&large * &large.recip().unwrap(), Rational::ONE);
    assert!(large > Rational::from(i64::MAX) && -&large < least);
}

#[test]
fn decimals_that_are_none() {
    for text in ["", ".", "e5", "1e", "1.2.3", "0x10", "-1", "1e99999999999", "1e6000", "NaN", "1f64"] {
        assert_eq!(Rational::parse_decimal(text), None, "{text}");
    }
    assert_eq!(Rational::parse_decimal("0.1").unwrap(), Rational::ratio(1, 10).unwrap());
    assert_eq!(Rational::parse_decimal("1_000.5").unwrap(), Rational::ratio(2001, 2).unwrap());
}
