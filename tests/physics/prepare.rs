//! `prepare()` refuses exactly the values of fields that make a model ill-posed, and says which condition fails, by
//! which value, against which threshold.

use affine_oracle::{Kinetic, Random, Term, exact};
use affine_runtime::error::IllPosed;
use affine_runtime::prelude::*;
use affine_runtime::{Error, Result};

use crate::families::Parameters;

macro_rules! models {
    ($($name:ident $n:literal ($($field:ident)*) ($($spec:tt)*);)*) => { $(
        #[affine_model(dim = $n, $($spec)*)]
        #[derive(Clone, Copy)]
        struct $name { $($field: f64),* }
    )* };
}

models! {
    Left2 2 (i a b) (kinetic(body_inertia = i, casimir2 = a, casimir1_squared = b));
    Left3 3 (i a b m) (kinetic(body_inertia = i, casimir2 = a, casimir1_squared = b, body_translation = m));
    Right3 3 (i a b m) (kinetic(space_inertia = i, casimir2 = a, casimir1_squared = b, space_translation = m));
    AffineAffine3 3 (a b) (kinetic(casimir2 = a, casimir1_squared = b));
    Definite3 3 (i a b m) (
        kinetic(body_inertia = i, casimir2 = a, casimir1_squared = b, body_translation = m),
        require(positive_definite)
    );
    Scalar3 3 (j m) (kinetic(dalembert = j, space_translation = m));
    Diagonal2 2 (j k) (kinetic(dalembert = diag(j, k)));
    Full2 2 (j k l) (kinetic(dalembert = [[j, k], [k, l]]));
    NoiseScalar2 2 (a b) (kinetic(dalembert = a - b));
    NoiseMatrix2 2 (a b c) (kinetic(dalembert = [[a - b, c], [c, a - b]]));
    Body2 2 (j k a b) (kinetic(body_inertia = diag(j, k), casimir2 = a, casimir1_squared = b));
    Space2 2 (j k l) (kinetic(space_inertia = [[j, k], [k, l]]));
    Flat2 2 (i m) (
        kinetic(
            flat_tensor = [[-9, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]],
            dalembert = diag(i, 2),
            space_translation = m,
        )
    );
    Tensor2 2 (a) (kinetic(casimir2 = a, body_tensor = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 2]]));
}

const EPS: f64 = f64::EPSILON;

/// The defect that `prepare()` reports.
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

/// Refused for this condition with this value and threshold, all of which the message names.
fn assert_refused<P>(prepared: Result<P>, condition: &str, value: f64, threshold: f64) {
    let defect = defect(prepared);
    assert_eq!((defect.condition, defect.value), (condition, value));
    // The summands are added in some order.
    assert!((defect.threshold - threshold).abs() <= 4.0 * EPS * threshold, "{:e}", defect.threshold);
    let message = defect.to_string();
    for part in [
        condition.to_owned(),
        format!("{value:e}"),
        format!("{:e}", defect.threshold),
        defect.reason.to_owned(),
    ] {
        assert!(message.contains(&part), "{part:?} in {message:?}");
    }
    assert!(!defect.reason.is_empty());
}

#[test]
fn degenerate_eigenvalues_of_isotropic_energies_are_refused() {
    let left = Left3 { i: 1.0, a: 0.25, b: 0.125, m: 1.0 };
    assert!(left.prepare().is_ok());
    assert_refused(Left3 { a: -1.0, ..left }.prepare(), "I + A != 0", 0.0, EPS * 2.375);
    assert_refused(Left3 { a: 1.0, ..left }.prepare(), "I - A != 0", 0.0, EPS * 2.375);
    // 1.25 + 3 b = 0 at b = -5/12, which no f64 is: the sum is 0 up to its own rounding.
    let refused = defect(Left3 { b: -5.0 / 12.0, ..left }.prepare());
    assert_eq!(refused.condition, "I + A + n B != 0");
    assert!(refused.value.abs() <= refused.threshold && refused.threshold == EPS * 2.5);
    // The same for n = 2: 1.25 + 2 b.
    let plane = Left2 { i: 1.0, a: 0.25, b: -0.625 };
    assert_refused(plane.prepare(), "I + A + n B != 0", 0.0, EPS * 2.5);
    assert!(Left2 { b: -5.0 / 12.0, ..plane }.prepare().is_ok());
    // And in space.
    let right = Right3 { i: -0.5, a: 0.5, b: 1.0, m: 2.0 };
    assert_refused(right.prepare(), "I + A != 0", 0.0, EPS * 4.0);
    assert_refused(Right3 { i: 0.5, ..right }.prepare(), "I - A != 0", 0.0, EPS * 4.0);
    assert_refused(Right3 { i: 1.0, b: -0.5, ..right }.prepare(), "I + A + n B != 0", 0.0, EPS * 3.0);
    assert!(Right3 { i: 1.0, ..right }.prepare().is_ok());
}

#[test]
fn degenerate_affine_affine_energies_are_refused() {
    assert!(AffineAffine3 { a: -0.5, b: 0.25 }.prepare().is_ok());
    assert!(AffineAffine3 { a: 0.5, b: 0.0 }.prepare().is_ok());
    assert_eq!(defect(AffineAffine3 { a: 0.0, b: 0.25 }.prepare()).value, 0.0);
    assert_refused(AffineAffine3 { a: 0.75, b: -0.25 }.prepare(), "I + A + n B != 0", 0.0, EPS * 1.5);
    assert_eq!(defect(AffineAffine3 { a: 0.0, b: 0.0 }.prepare()).threshold, 0.0);
}

#[test]
fn just_above_the_threshold_is_accepted() {
    // |I| + |A| + n |B| = 2.375 to rounding.
    let left = |distance: f64| Left3 { i: 1.0, a: -1.0 + distance, b: 0.125, m: 1.0 };
    assert_refused(left(2.0 * EPS).prepare(), "I + A != 0", 2.0 * EPS, EPS * 2.375);
    assert!(left(2.5 * EPS).prepare().is_ok());
    assert_refused(left(-2.0 * EPS).prepare(), "I + A != 0", -2.0 * EPS, EPS * 2.375);
    assert!(left(-3.0 * EPS).prepare().is_ok());
    let skew = |distance: f64| Left3 { i: 1.0, a: 1.0 + distance, b: 0.125, m: 1.0 };
    assert_refused(skew(2.0 * EPS).prepare(), "I - A != 0", -2.0 * EPS, EPS * 2.375);
    assert!(skew(3.0 * EPS).prepare().is_ok());
    // The threshold scales with the energy, and a mass has its own.
    let scaled = |s: f64| Left3 { i: s, a: (-1.0 + 2.5 * EPS) * s, b: 0.125 * s, m: 1.0 };
    for s in [1024.0, 1.0 / 1024.0, -8.0] {
        assert!(scaled(s).prepare().is_ok());
    }
    assert!(Left3 { i: 1.0, a: 0.25, b: 0.125, m: 1e-30 }.prepare().is_ok());
}

#[test]
fn massless_centre_is_refused() {
    let left = Left3 { i: 1.0, a: 0.25, b: 0.125, m: 0.0 };
    assert_refused(left.prepare(), "m != 0", 0.0, 0.0);
    assert_refused(Left3 { m: -0.0, ..left }.prepare(), "m != 0", 0.0, 0.0);
    // Indefinite models are legitimate beside affine terms.
    assert!(Left3 { m: -1.0, ..left }.prepare().is_ok());
    assert_refused(Right3 { i: 1.0, a: 0.25, b: 0.125, m: 0.0 }.prepare(), "m != 0", 0.0, 0.0);
    assert_refused(Scalar3 { j: 1.0, m: 0.0 }.prepare(), "m > 0", 0.0, 0.0);
}

#[test]
fn dalembert_inertia_must_be_positive() {
    assert!(Scalar3 { j: 2.0, m: 1.0 }.prepare().is_ok());
    assert_refused(Scalar3 { j: 0.0, m: 1.0 }.prepare(), "J > 0", 0.0, 0.0);
    assert_refused(Scalar3 { j: -2.0, m: 1.0 }.prepare(), "J > 0", -2.0, EPS * 2.0);
    assert_refused(Scalar3 { j: 2.0, m: -1.0 }.prepare(), "m > 0", -1.0, EPS);

    assert!(Diagonal2 { j: 1.0, k: 1e-4 }.prepare().is_ok());
    assert_refused(Diagonal2 { j: 1.0, k: 0.0 }.prepare(), "J > 0", 0.0, EPS);
    assert_refused(Diagonal2 { j: -1.0, k: 4.0 }.prepare(), "J > 0", -1.0, EPS * 4.0);

    assert!(Full2 { j: 2.0, k: 1.0, l: 1.0 }.prepare().is_ok());
    // Eigenvalues 3, -1; 2, 0; -1, -3.
    for (j, k, value, largest) in [(1.0, 2.0, -1.0, 3.0), (1.0, 1.0, 0.0, 2.0), (-2.0, 1.0, -1.0, 3.0)] {
        let refused = defect(Full2 { j, k, l: j }.prepare());
        assert_eq!(refused.condition, "T > 0 on every velocity");
        let near = |found: f64, expected: f64| (found - expected).abs() <= 4.0 * EPS * largest;
        assert!(near(refused.value, value) || near(refused.value, value - 2.0), "{refused:?}");
        let size = 2.0 * f64::abs(j) + k;
        assert!((refused.threshold / (EPS * size) - 1.0).abs() < 1e-12, "{refused:?}");
    }
    // Eigenvalues 1, 1 and off-diagonal just below: the smaller one is 1 - k.
    assert!(Full2 { j: 1.0, k: 1.0 - 8.0 * EPS, l: 1.0 }.prepare().is_ok());
}

/// `T = 1/2 (O_11^2 + O_12^2 + O_21^2 + 2 O_22^2) + a/2 tr O^2` has the eigenvalues `1 + a`, `2 + a`, `1 + a`, `1 - a`.
#[test]
fn degenerate_tensors_are_refused() {
    for a in [0.5, -0.5, -1.5, 3.0, -3.0] {
        assert!(Tensor2 { a }.prepare().is_ok(), "{a}");
    }
    // Sums of the sizes of a block's terms, or of the largest eigenvalue's: at most eight times it here.
    for (a, largest) in [(-1.0, 2.0), (1.0, 3.0), (-2.0, 3.0)] {
        let refused = defect(Tensor2 { a }.prepare());
        assert!(refused.condition.contains(" != 0"), "{refused:?}");
        assert!(refused.value.abs() <= refused.threshold, "{refused:?}");
        assert!(refused.threshold <= 8.0 * EPS * largest, "{refused:?}");
    }
}

/// The Hessian of (4.17) has the determinant `(j k - a^2)((j + a)(k + a) + b (j + k + 2 a))`, of either sign.
#[test]
fn degenerate_affine_inertias_are_refused() {
    let body = Body2 { j: 1.0, k: 4.0, a: 0.5, b: 0.25 };
    for regular in [body, Body2 { k: -4.0, ..body }, Body2 { j: -1.0, k: -4.0, ..body }] {
        assert!(regular.prepare().is_ok());
    }
    // 1*4 - 2^2; (1)(-2) - 2 (1 - 2) = 0; both factors at j = k = -a.
    for degenerate in [
        Body2 { a: 2.0, ..body },
        Body2 { a: -2.0, ..body },
        Body2 { k: -2.0, a: 0.0, b: -2.0, ..body },
        Body2 { k: 1.0, a: -1.0, ..body },
    ] {
        let refused = defect(degenerate.prepare());
        assert!(
            refused.condition.contains("!= 0") && refused.value.abs() <= refused.threshold,
            "{refused:?}"
        );
    }
    let space = Space2 { j: 1.0, k: 2.0, l: 1.0 };
    assert!(space.prepare().is_ok());
    assert!(Space2 { k: 1.0, ..space }.prepare().is_err());
    for wrong in [f64::NAN, f64::INFINITY] {
        assert_eq!(not_finite(Body2 { k: wrong, ..body }.prepare()), "k");
        assert_eq!(not_finite(Space2 { k: wrong, ..space }.prepare()), "k");
    }
}

/// The sum with an indefinite tensor is regular or not by itself; inertia and mass of the masses are positive.
#[test]
fn masses_beside_a_flat_tensor_are_positive() {
    let flat = Flat2 { i: 1.0, m: 2.0 };
    assert!(flat.prepare().is_ok());
    // -9 + i = 0.
    assert!(defect(Flat2 { i: 9.0, ..flat }.prepare()).condition.contains("!= 0"));
    assert_eq!(defect(Flat2 { i: -2.0, ..flat }.prepare()).condition, "a leading minor of J > 0");
    assert_refused(Flat2 { m: -1.0, ..flat }.prepare(), "m > 0", -1.0, EPS);
}

/// What rounding leaves of a vanishing inertia is refused in a matrix as it is in a scalar.
#[test]
fn rounding_noise_is_no_inertia() {
    let (a, b) = (0.1 + 0.2, 0.3);
    assert!(a - b > 0.0);
    assert_eq!(defect(NoiseScalar2 { a, b }.prepare()).condition, "J > 0");
    assert_eq!(defect(NoiseMatrix2 { a, b, c: 0.0 }.prepare()).condition, "T > 0 on every velocity");
    assert!(NoiseMatrix2 { a: 1.0, b, c: 0.0 }.prepare().is_ok());
}

#[affine_model(dim = 2, kinetic(casimir2 = 1), potential = sqrt(k)*tr(G) + ln(l)*q + 1/b*q^2)]
struct Functions2 {
    k: f64,
    l: f64,
    b: f64,
}

/// What has no value is not only said to overflow.
#[test]
fn functions_of_fields_without_a_value_are_refused() {
    for (k, l, b) in [(-1.0, 1.0, 1.0), (1.0, -1.0, 1.0), (1.0, 1.0, 0.0)] {
        let defect = defect(Functions2 { k, l, b }.prepare());
        assert_eq!(defect.condition, "every coefficient is finite");
        assert!(defect.reason.contains("root or logarithm") && defect.reason.contains("zero"), "{defect}");
    }
    assert!(Functions2 { k: 1.0, l: 1.0, b: 1.0 }.prepare().is_ok());
}

/// A subnormal mass or inertia passes its threshold and has no finite reciprocal.
#[test]
fn fields_without_a_finite_reciprocal_are_refused() {
    let left = Left3 { i: 1.0, a: 0.25, b: 0.125, m: 1e-310 };
    assert_eq!(defect(left.prepare()).condition, "every coefficient is finite");
    assert_eq!(
        defect(Full2 { j: 1e-320, k: 0.0, l: 1e-320 }.prepare()).condition,
        "every coefficient is finite"
    );
}

#[test]
fn required_definiteness_is_decided_by_the_signature() {
    let (mut accepted, mut refused) = (0, 0);
    let mut random = Random::new(91);
    for _ in 0..60 {
        let parameters = Parameters::random(3, &mut random);
        let [i, a, b, m] = ["i", "a", "b", "m"].map(|name| parameters.field(name));
        let [exact_i, exact_a, exact_b, exact_m] = [i, a, b, m].map(|field| exact(field).unwrap());
        let terms = vec![
            Term::body_inertia(3, exact_i),
            Term::Casimir2(exact_a),
            Term::Casimir1Squared(exact_b),
            Term::BodyTranslation(exact_m),
        ];
        let signature = Kinetic::new(3, terms).unwrap().signature(&random.placement(3)).unwrap();
        // The same fields are fine where nothing is required.
        assert!(Left3 { i, a, b, m }.prepare().is_ok());
        let prepared = Definite3 { i, a, b, m }.prepare();
        match prepared {
            Ok(_) => {
                accepted += 1;
                assert_eq!((signature.positive, signature.negative, signature.zero), (12, 0, 0));
            }
            Err(Error::IllPosed(defect)) => {
                refused += 1;
                assert!(signature.negative > 0, "{defect}");
                assert!(defect.condition.ends_with(" > 0") && defect.value < 0.0, "{defect}");
            }
            Err(other) => panic!("another error: {other}"),
        }
    }
    assert!(accepted >= 15 && refused >= 15, "{accepted} accepted, {refused} refused");
}

#[test]
fn fields_that_are_not_finite_are_refused() {
    for wrong in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let left = Left3 { i: 1.0, a: 0.25, b: 0.125, m: 1.0 };
        assert_eq!(not_finite(Left3 { i: wrong, ..left }.prepare()), "i");
        assert_eq!(not_finite(Left3 { a: wrong, ..left }.prepare()), "a");
        assert_eq!(not_finite(Left3 { b: wrong, ..left }.prepare()), "b");
        assert_eq!(not_finite(Left3 { m: wrong, ..left }.prepare()), "m");
        assert_eq!(not_finite(Right3 { i: 1.0, a: 0.25, b: wrong, m: 1.0 }.prepare()), "b");
        assert_eq!(not_finite(AffineAffine3 { a: wrong, b: 1.0 }.prepare()), "a");
        assert_eq!(not_finite(Definite3 { i: wrong, a: 0.25, b: 0.125, m: 1.0 }.prepare()), "i");
        assert_eq!(not_finite(Scalar3 { j: wrong, m: 1.0 }.prepare()), "j");
        assert_eq!(not_finite(Scalar3 { j: 1.0, m: wrong }.prepare()), "m");
        assert_eq!(not_finite(Diagonal2 { j: 1.0, k: wrong }.prepare()), "k");
        assert_eq!(not_finite(Full2 { j: wrong, k: 0.5, l: 1.0 }.prepare()), "j");
        assert_eq!(not_finite(Full2 { j: 1.0, k: wrong, l: 1.0 }.prepare()), "k");
        assert_eq!(not_finite(Full2 { j: 1.0, k: 0.5, l: wrong }.prepare()), "l");
        assert_eq!(not_finite(Tensor2 { a: wrong }.prepare()), "a");
    }
    // Opposite infinities, and sums beyond the range of f64.
    let left = Left3 { i: f64::INFINITY, a: f64::NEG_INFINITY, b: 0.0, m: 1.0 };
    assert_eq!(not_finite(left.prepare()), "i");
    defect(Left3 { i: f64::MAX, a: f64::MAX, ..left }.prepare());
}

/// Programs that prepare whatever model they are given: what no field decides is ready as it stands.
#[test]
fn every_model_is_prepared() {
    #[affine_model(dim = 2, kinetic(casimir2 = 0.2, body_inertia = 1))]
    struct Unit;
    #[affine_model(dim = 2, kinetic(casimir2 = 0.2, body_inertia = 1))]
    struct Labelled<T> {
        label: T,
    }
    #[affine_model(dim = 2, kinetic(casimir2 = a, body_inertia = 1))]
    struct OfFields {
        a: f64,
    }
    fn energy<M: Model<2, Point<f64> = <Unit as Model<2>>::Point<f64>>>(model: &M) -> f64 {
        let momentum = Comoving(Matrix::<2>::new(0.1, 0.4, -0.3, -0.2));
        let point = Unit.at_momentum(Matrix::<2>::identity(), momentum).unwrap();
        model.hamiltonian(0.0, &point)
    }
    macro_rules! prepared {
        ($model:expr) => {
            energy(&$model.prepare().unwrap())
        };
    }
    let labelled = Labelled { label: "of the user's own" };
    assert!(!labelled.label.is_empty());
    let energies = [prepared!(Unit), prepared!(labelled), prepared!(OfFields { a: 0.2 })];
    assert!(energies.iter().all(|energy| (energy - energies[0]).abs() < 1e-15), "{energies:?}");
    assert!(energies[0] > 0.0);
}
