//! What `prepare()` refuses in matrices, and with which numbers.

use affine_oracle::{Kinetic, Random, Term, rational};
use affine_runtime::error::IllPosed;
use affine_runtime::prelude::*;
use affine_runtime::signature::signature;
use affine_runtime::{Error, Result};

const EPS: f64 = f64::EPSILON;

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

#[affine_model(dim = 3, kinetic(body_inertia = j, casimir2 = a, casimir1_squared = b))]
#[derive(Clone)]
struct Body {
    j: Matrix<3>,
    a: f64,
    b: f64,
}

#[affine_model(dim = 2, kinetic(body_inertia = j), require(positive_definite))]
struct Definite {
    j: [[f64; 2]; 2],
}

#[affine_model(dim = 2, kinetic(dalembert = j))]
struct Masses {
    j: Matrix<2>,
}

#[affine_model(dim = 2, constraint = rigid, kinetic(dalembert = j))]
struct Rigid {
    j: Matrix<2>,
}

#[affine_model(dim = 2, kinetic(body_tensor = k, casimir2 = a))]
struct Tensor {
    k: Matrix<4>,
    a: f64,
}

#[affine_model(dim = 2, kinetic(casimir2 = 1), metrics(space = g, body = diag(c, 1)))]
struct Metrics {
    g: Matrix<2>,
    c: f64,
}

#[affine_model(dim = 2, kinetic(casimir2 = 0.2, body_inertia = 1), dissipation(body_inertia = r))]
struct Damped {
    r: Matrix<2>,
}

fn turned(angle: f64, values: [f64; 2]) -> Matrix<2> {
    let (sine, cosine) = angle.sin_cos();
    let turn = Matrix::<2>::new(cosine, -sine, sine, cosine);
    turn * Matrix::<2>::from_diagonal(&Vector::<2>::from(values)) * turn.transpose()
}

#[test]
fn matrices_that_are_not_symmetric() {
    let mut j = Matrix::<3>::new(2.0, 0.5, 0.0, 0.5, 1.5, 0.25, 0.0, 0.25, 1.0);
    let body = |j| Body { j, a: 0.2, b: 0.1 };
    assert!(body(j).prepare().is_ok());
    j[(0, 2)] = 1e-9;
    let refused = defect(body(j).prepare());
    assert_eq!((refused.condition, refused.value), ("j = j^T", 1e-9));
    assert_eq!(refused.threshold, 12.0 * EPS * 2.0);
    assert!(refused.to_string().contains("1e-9"), "{refused}");
    // To rounding it is symmetric, and the energy sees the mean.
    j[(0, 2)] = 2.0 * EPS;
    assert!(body(j).prepare().is_ok());
    // A product that is symmetric but for rounding.
    for angle in 1..100 {
        assert!(Masses { j: turned(f64::from(angle), [1.0, 1e-3]) }.prepare().is_ok());
    }
    for bad in [f64::NAN, f64::INFINITY] {
        j[(1, 1)] = bad;
        assert_eq!(not_finite(body(j).prepare()), "j");
    }
    let mut k = Matrix::<4>::identity();
    k[(0, 3)] = 0.5;
    let refused = defect(Tensor { k, a: 0.2 }.prepare());
    assert_eq!((refused.condition, refused.value), ("k = k^T", 0.5));
    let g = Matrix::<2>::new(1.0, 0.25, 0.0, 1.0);
    assert_eq!(defect(Metrics { g, c: 1.0 }.prepare()).condition, "g = g^T");
}

/// `j_a j_b != A^2`, `j_a + A != 0` and the condition on the trace of (4.17), whatever the axes of `J`.
#[test]
fn degenerate_inertias() {
    #[affine_model(dim = 2, kinetic(body_inertia = j, casimir2 = a))]
    struct Plane {
        j: Matrix<2>,
        a: f64,
    }
    for step in 0..20 {
        let angle = 0.1 + 0.3 * f64::from(step);
        // j_1 j_2 = A^2: a rotation and a shear lose their momentum together.
        let refused = defect(Plane { j: turned(angle, [2.0, 0.125]), a: 0.5 }.prepare());
        assert_eq!(refused.condition, "T != 0 on every principal velocity");
        assert!(refused.value.abs() <= refused.threshold && refused.threshold < 1e-14, "{refused}");
        // j_1 + A = 0.
        let refused = defect(Plane { j: turned(angle, [-0.5, 3.0]), a: 0.5 }.prepare());
        let velocity: Vec<f64> =
            refused.velocity.unwrap().rows().flatten().map(|entry| f64::from(*entry)).collect();
        let (sine, cosine) = angle.sin_cos();
        let axis = [cosine * cosine, cosine * sine, cosine * sine, sine * sine];
        let along: f64 = velocity.iter().zip(axis).map(|(v, a)| v * a).sum();
        assert!((along.abs() - 1.0).abs() < 1e-6, "{refused}");
        assert!(Plane { j: turned(angle, [2.0, 0.125]), a: 0.75 }.prepare().is_ok());
        assert!(Plane { j: turned(angle, [2.0, 0.125]), a: 0.5 + 1e-12 }.prepare().is_ok());
    }
}

#[test]
fn inertias_that_must_be_positive() {
    let refused = defect(Masses { j: turned(0.5, [2.0, -0.25]) }.prepare());
    assert_eq!(refused.condition, "T > 0 on every velocity");
    assert!((refused.value + 0.25).abs() < 1e-15, "{refused}");
    // Of a rotation in the plane is tr J left.
    assert!(Rigid { j: turned(0.5, [2.0, -0.25]) }.prepare().is_ok());
    let refused = defect(Rigid { j: turned(0.5, [2.0, -2.0]) }.prepare());
    assert_eq!(refused.condition, "the eigenvalue of T != 0");
    assert!(defect(Definite { j: [[1.0, 2.0], [2.0, 1.0]] }.prepare()).value < 0.0);
    assert!(Definite { j: [[2.0, 1.0], [1.0, 2.0]] }.prepare().is_ok());
    assert!(defect(Damped { r: turned(0.5, [2.0, -0.25]) }.prepare()).value < 0.0);
    assert!(Damped { r: turned(0.5, [2.0, 0.0]) }.prepare().is_ok());
}

/// The velocity that loses its momentum is in the message.
#[test]
fn degenerate_tensors() {
    let k = Matrix::<4>::identity();
    // K + A (exchange of the off-diagonal pair): the skew velocity.
    let refused = defect(Tensor { k, a: 1.0 }.prepare());
    assert_eq!((refused.condition, refused.value), ("T != 0 on every principal velocity", 0.0));
    let text = refused.to_string();
    assert!(
        text.contains("[[0.000, 0.707], [-0.707, 0.000]]")
            || text.contains("[[0.000, -0.707], [0.707, 0.000]]"),
        "{text}"
    );
    assert!(Tensor { k, a: 0.5 }.prepare().is_ok());
}

#[test]
fn metrics_that_are_not_positive() {
    let refused = defect(Metrics { g: turned(0.5, [2.0, -0.25]), c: 1.0 }.prepare());
    assert_eq!(refused.condition, "g > 0");
    let refused = defect(Metrics { g: turned(0.5, [2.0, 0.25]), c: -3.0 }.prepare());
    assert_eq!((refused.condition, refused.value, refused.threshold), ("eta > 0", -3.0, 3.0 * EPS));
    assert_eq!(defect(Metrics { g: Matrix::<2>::new(1.0, 1.0, 1.0, 1.0), c: 1.0 }.prepare()).value, 0.0);
    assert!(Metrics { g: turned(0.5, [2.0, 0.25]), c: 3.0 }.prepare().is_ok());
}

/// Accepted with the signature of the oracle, which is that of every placement.
#[test]
fn signatures() {
    for seed in 0..12 {
        let mut random = Random::new(77 + seed);
        let (tensor, phi) = (random.tensor(2), random.placement(2));
        let expected =
            Kinetic::new(2, vec![Term::BodyTensor(tensor.clone()), Term::Casimir2(rational(1, 64))])
                .unwrap()
                .signature(&phi)
                .unwrap();
        let model =
            Tensor { k: Matrix::<4>::from_row_slice(&tensor.to_f64()), a: 1.0 / 64.0 }.prepare().unwrap();
        let phi = Matrix::<2>::from_row_slice(&phi.to_f64());
        assert_eq!(signature(&model, &phi), Some((expected.positive, expected.negative)));
    }
    #[affine_model(dim = 3, kinetic(casimir2 = 0.2, casimir1_squared = 0.1, space_translation = 1))]
    struct Known;
    #[affine_model(dim = 3, constraint = isochoric, kinetic(casimir2 = 0.2))]
    struct Isochoric;
    let phi = Matrix::<3>::new(2.0, 0.1, 0.0, 0.0, 0.5, 0.0, 0.3, 0.0, 1.0);
    assert_eq!(signature(&Known, &phi), Known::DESCRIPTION.signature);
    assert_eq!(signature(&Isochoric, &phi), Isochoric::DESCRIPTION.signature);
    // Rows of phi_dot: T is the sum over the rows.
    let model = Masses { j: turned(0.5, [2.0, 0.25]) }.prepare().unwrap();
    assert_eq!(signature(&model, &Matrix::<2>::identity()), Some((4, 0)));
}
