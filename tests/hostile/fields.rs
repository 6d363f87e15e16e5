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

#[affine_model(dim = 2, kinetic(dalembert = r#type))]
struct Raw {
    r#type: f64,
}

#[affine_model(dim = 2, metrics(space = diag(g, 1)), kinetic(dalembert = 1), potential = k*tr(G))]
struct Axes {
    g: f64,
    k: f64,
}

#[affine_model(dim = 2, kinetic(casimir2 = a - a + 1, body_inertia = 2*k))]
#[allow(dead_code, reason = "no coefficient reads `a`")]
struct Unread {
    a: f64,
    k: f64,
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

/// The field that is refused for its value, and the entry of a matrix.
fn not_finite<P>(prepared: Result<P>, bad: f64) -> (&'static str, Option<(usize, usize)>) {
    let error = prepared.err().expect("a value that is no number");
    let Error::FieldNotFinite { field, entry, value } = error else { panic!("{error}") };
    assert_eq!(value.to_bits(), bad.to_bits(), "{error}");
    let text = error.to_string();
    assert!(text.contains(&format!("`{field}`")) && text.contains(&format!("is {bad}")), "{text}");
    (field, entry)
}

/// Each by its name, with its value, whatever is computed from it.
#[test]
fn that_are_numbers() {
    type With = fn(f64) -> Disc;
    let cases: [(With, &str); 8] = [
        (|i| Disc { i, ..DISC }, "i"),
        (|a| Disc { a, ..DISC }, "a"),
        (|b| Disc { b, ..DISC }, "b"),
        (|m| Disc { m, ..DISC }, "m"),
        (|kappa| Disc { kappa, ..DISC }, "kappa"),
        (|c1| Disc { c1, ..DISC }, "c1"),
        (|g| Disc { g, ..DISC }, "g"),
        (|r| Disc { r, ..DISC }, "r"),
    ];
    assert!(DISC.prepare().is_ok());
    for (with, field) in cases {
        for bad in BAD {
            assert_eq!(not_finite(with(bad).prepare(), bad), (field, None));
        }
    }
    for bad in BAD {
        assert_eq!(not_finite(Raw { r#type: bad }.prepare(), bad), ("type", None));
        assert_eq!(not_finite(Axes { g: bad, k: 1.0 }.prepare(), bad), ("g", None));
        assert_eq!(not_finite(Axes { g: 2.0, k: bad }.prepare(), bad), ("k", None));
    }
    // What nothing is computed from may be anything.
    assert!(Unread { a: f64::NAN, k: 1.0 }.prepare().is_ok());
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
            let mut j = unit;
            j[place] = bad;
            let entry = Some((place.0 + 1, place.1 + 1));
            assert_eq!(not_finite(Plate { j, k: 1.0 }.prepare(), bad), ("j", entry));
            assert_eq!(not_finite(Skewed { g: j }.prepare(), bad), ("g", entry));
        }
        assert_eq!(not_finite(Plate { j: unit, k: bad }.prepare(), bad), ("k", None));
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
