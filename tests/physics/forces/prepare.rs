//! `prepare()` refuses exactly the values of fields that make a dissipation negative, rounding apart.

use affine_runtime::error::IllPosed;
use affine_runtime::{Error, Result, affine_model};

const EPS: f64 = f64::EPSILON;

#[affine_model(
    dim = 3,
    kinetic(casimir2 = 0.25, body_inertia = 1.5, body_translation = 1),
    dissipation(body_inertia = i, casimir2 = a, casimir1_squared = b, space_translation = c),
)]
#[derive(Clone, Copy)]
struct Isotropic {
    i: f64,
    a: f64,
    b: f64,
    c: f64,
}

#[affine_model(
    dim = 2,
    kinetic(dalembert = 1),
    dissipation(space_inertia = [[j, k], [k, l]], flat_tensor = [[m, 0, 0, 1], [0, 0, 0, 0], [0, 0, 0, 0], [1, 0, 0, m]]),
)]
#[derive(Clone, Copy)]
struct Blocks {
    j: f64,
    k: f64,
    l: f64,
    m: f64,
}

fn defect<P>(prepared: Result<P>) -> IllPosed {
    match prepared {
        Err(Error::IllPosed(defect)) => defect,
        Err(other) => panic!("another error: {other}"),
        Ok(_) => panic!("accepted"),
    }
}

/// The field that is refused because its value is none.
fn not_finite<P>(prepared: Result<P>) -> &'static str {
    match prepared {
        Err(Error::FieldNotFinite { field, value, .. }) if !value.is_finite() => field,
        Err(other) => panic!("another error: {other}"),
        Ok(_) => panic!("accepted"),
    }
}

#[test]
fn eigenvalues_may_vanish_but_not_be_negative() {
    let fine = Isotropic { i: 0.5, a: 0.25, b: 0.125, c: 1.0 };
    for model in [
        fine,
        // Nothing resists shear, or turning, or dilatation, or the centre.
        Isotropic { a: -0.5, b: 0.5, ..fine },
        Isotropic { a: 0.5, ..fine },
        Isotropic { b: -0.25, ..fine },
        Isotropic { c: 0.0, ..fine },
        Isotropic { i: 0.0, a: 0.0, b: 0.0, c: 0.0 },
        // 0.1 + 0.2 - 0.3 is zero but for rounding, whichever sign that has.
        Isotropic { i: 0.1 + 0.2, a: -0.3, ..fine },
        Isotropic { i: 0.3, a: -(0.1 + 0.2), ..fine },
    ] {
        assert!(model.prepare().is_ok(), "{:?}", [model.i, model.a, model.b, model.c]);
    }
    for (model, condition, value) in [
        (Isotropic { a: -0.75, b: 1.0, ..fine }, "I + A >= 0", -0.25),
        (Isotropic { a: 0.75, ..fine }, "I - A >= 0", -0.25),
        (Isotropic { b: -0.5, ..fine }, "I + A + n B >= 0", -0.75),
        (Isotropic { c: -1.0, ..fine }, "the coefficient >= 0", -1.0),
    ] {
        let defect = defect(model.prepare());
        assert_eq!((defect.condition, defect.value), (condition, value));
        assert!(defect.threshold <= 0.0 && defect.threshold >= -8.0 * EPS, "{:e}", defect.threshold);
        assert!(defect.to_string().contains("feed energy in"), "{defect}");
    }
    for wrong in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert_eq!(not_finite(Isotropic { i: wrong, ..fine }.prepare()), "i");
        assert_eq!(not_finite(Isotropic { c: wrong, ..fine }.prepare()), "c");
    }
}

#[test]
fn blocks_are_judged_by_their_eigenvalues() {
    let fine = Blocks { j: 1.0, k: 0.5, l: 1.0, m: 1.0 };
    assert!(fine.prepare().is_ok());
    assert!(Blocks { k: 1.0, ..fine }.prepare().is_ok(), "semidefinite");
    for (model, condition) in [
        (Blocks { k: 1.5, ..fine }, "R >= 0 on every velocity"),
        (Blocks { j: -1.0, ..fine }, "R >= 0 on every velocity"),
        // The flat form has the eigenvalues m + 1 and m - 1.
        (Blocks { m: 0.5, ..fine }, "an eigenvalue of R >= 0"),
    ] {
        let defect = defect(model.prepare());
        assert_eq!(defect.condition, condition);
        assert!(defect.value < -0.4, "{defect}");
    }
}
