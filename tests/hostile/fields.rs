//! Parameters that are no numbers.

use affine_runtime::error::IllPosed;
use affine_runtime::prelude::*;
use affine_runtime::{Error, Result};

#[affine_model(
    dim = 2,
    kinetic(casimir2 = a, casimir1_squared = b, body_inertia = i, body_translation = m),
    potential = kappa/2*sinh(q)^2 + c1*(tr(G)*exp(-2*q) - n) + g*x[2],
    dissipation(body_inertia = r),
)]
#[derive(Clone, Copy)]
struct Disc {
    i: f64,
    a: f64,
    b: f64,
    m: f64,
    kappa: f64,
    c1: f64,
    g: f64,
    r: f64,
}

#[affine_model(dim = 2, kinetic(dalembert = j, space_translation = 1), potential = k*tr(G))]
#[derive(Clone, Copy)]
struct Plate {
    j: Matrix<2>,
    k: f64,
}

#[affine_model(dim = 2, metrics(space = g), kinetic(casimir2 = 0.2, body_inertia = 1))]
struct Skewed {
    g: Matrix<2>,
}

const BAD: [f64; 3] = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY];

fn defect<P>(prepared: Result<P>, label: &str) -> IllPosed {
    match prepared {
        Err(Error::IllPosed(defect)) => defect,
        Err(other) => panic!("{label}: {other}"),
        Ok(_) => panic!("{label}: accepted"),
    }
}

const DISC: Disc = Disc { i: 1.0, a: 0.2, b: 0.1, m: 2.0, kappa: 10.0, c1: 0.5, g: 1.0, r: 0.1 };

/// Each by what is asked of it, with its value.
#[test]
fn that_are_numbers() {
    type With = fn(f64) -> Disc;
    let cases: [(With, &str); 8] = [
        (|i| Disc { i, ..DISC }, "I "),
        (|a| Disc { a, ..DISC }, "I "),
        (|b| Disc { b, ..DISC }, "n B"),
        (|m| Disc { m, ..DISC }, "m "),
        (|kappa| Disc { kappa, ..DISC }, "kappa is finite"),
        (|c1| Disc { c1, ..DISC }, "c1 is finite"),
        (|g| Disc { g, ..DISC }, "g is finite"),
        (|r| Disc { r, ..DISC }, ">= 0"),
    ];
    assert!(DISC.prepare().is_ok());
    for (with, condition) in cases {
        for bad in BAD {
            let label = format!("{condition} {bad}");
            let defect = defect(with(bad).prepare(), &label);
            assert!(defect.condition.contains(condition), "{label}: {defect}");
            assert!(!defect.value.is_finite(), "{label}: {defect}");
            assert!(defect.to_string().contains(&format!("{:e}", defect.value)), "{defect}");
        }
    }
}

/// Large enough that a coefficient overflows, though each is a number; or too small for a reciprocal.
#[test]
fn whose_coefficients_are_none() {
    for (body, label) in [
        (Disc { m: 5e-324, ..DISC }, "a subnormal mass"),
        (Disc { i: 1e-320, a: 0.0, b: 0.0, ..DISC }, "a subnormal inertia"),
    ] {
        let defect = defect(body.prepare(), label);
        assert_eq!(defect.condition, "every coefficient is finite", "{label}: {defect}");
        assert_eq!(defect.value.abs(), f64::INFINITY, "{label}");
    }
}

#[test]
fn that_are_matrices() {
    let unit = Matrix::<2>::identity();
    for bad in BAD {
        for place in [(0, 0), (0, 1), (1, 1)] {
            let label = format!("{bad} at {place:?}");
            let mut j = unit;
            j[place] = bad;
            let refused = defect(Plate { j, k: 1.0 }.prepare(), &label);
            assert_eq!(refused.condition, "j = j^T", "{label}: {refused}");
            assert!(!refused.value.is_finite(), "{label}: {refused}");
            let refused = defect(Skewed { g: j }.prepare(), &label);
            assert_eq!(refused.condition, "g = g^T", "{label}: {refused}");
        }
        assert_eq!(defect(Plate { j: unit, k: bad }.prepare(), "k").condition, "k is finite");
    }
    for j in [
        Matrix::<2>::zeros(),
        -unit,
        Matrix::<2>::new(1.0, 1.0, 1.0, 1.0),
        Matrix::<2>::new(1.0, 2.0, 2.0, 1.0),
    ] {
        let refused = defect(Plate { j, k: 1.0 }.prepare(), "not positive");
        assert!(refused.value <= refused.threshold, "{refused}");
        let refused = defect(Skewed { g: j }.prepare(), "no metric");
        assert!(refused.value <= refused.threshold, "{refused}");
    }
}
