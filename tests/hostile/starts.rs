//! Points that models refuse to make, by the name of what is wrong.

use affine_runtime::prelude::*;
use affine_runtime::{Error, Result};

use affine_tests::models::{Droplet, Top, Vibrating};

const BAD: [f64; 3] = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY];

/// The name of the quantity that is refused; `det phi` for a placement.
fn refused<P>(made: Result<P>, label: &str) -> &'static str {
    match made {
        Err(error @ Error::NotFinite { quantity }) => {
            assert!(error.to_string().contains(&format!("{quantity} is not finite")), "{label}: {error}");
            quantity
        }
        Err(error @ Error::Placement { determinant }) => {
            assert!(error.to_string().contains(&format!("det phi = {determinant:e}")), "{label}: {error}");
            "det phi"
        }
        Err(other) => panic!("{label}: {other}"),
        Ok(_) => panic!("{label}: made"),
    }
}

/// Every component of a matrix in turn.
fn spoilt<const N: usize>(good: Matrix<N>) -> impl Iterator<Item = Matrix<N>> {
    let bad = move |k: usize| {
        BAD.map(|bad| {
            let mut matrix = good;
            matrix[(k / N, k % N)] = bad;
            matrix
        })
    };
    (0..N * N).flat_map(bad)
}

fn spoilt_vectors<const N: usize>(good: Vector<N>) -> impl Iterator<Item = Vector<N>> {
    let bad = move |k: usize| {
        BAD.map(|bad| {
            let mut vector = good;
            vector[k] = bad;
            vector
        })
    };
    (0..N).flat_map(bad)
}

#[test]
fn of_a_free_body() {
    let phi = Matrix::<2>::new(1.1, 0.2, -0.1, 0.9);
    let spin = Matrix::<2>::new(0.3, -0.2, 0.5, 0.1);
    let (x, p) = (Vector::<2>::new(0.4, -0.3), Vector::<2>::new(0.2, 0.5));
    let by_momentum = |x, phi, p, spin| Vibrating.at_momentum(x, phi, p, Comoving(spin));
    let by_velocity = |x, phi, v, rate| Vibrating.at_velocity(x, phi, v, rate);
    assert!(by_momentum(x, phi, p, spin).is_ok() && by_velocity(x, phi, p, spin).is_ok());
    for bad in spoilt(phi) {
        assert_eq!(refused(by_momentum(x, bad, p, spin), "phi"), "det phi");
        assert_eq!(refused(by_velocity(x, bad, p, spin), "phi"), "det phi");
    }
    for bad in spoilt(spin) {
        assert_eq!(refused(by_momentum(x, phi, p, bad), "Sigma_hat"), "Sigma_hat");
        // By what a velocity gives: the momentum.
        assert_eq!(refused(by_velocity(x, phi, p, bad), "phi_dot"), "Sigma_hat");
    }
    for bad in spoilt_vectors(x) {
        assert_eq!(refused(by_momentum(bad, phi, p, spin), "x"), "x");
        assert_eq!(refused(by_velocity(bad, phi, p, spin), "x"), "x");
    }
    for bad in spoilt_vectors(p) {
        assert_eq!(refused(by_momentum(x, phi, bad, spin), "p"), "p");
        assert_eq!(refused(by_velocity(x, phi, bad, spin), "x_dot"), "p");
    }
    for bad in [
        Matrix::<2>::zeros(),
        -phi * Matrix::<2>::new(1.0, 0.0, 0.0, -1.0),
        Matrix::<2>::new(1.0, 2.0, 2.0, 4.0),
        Matrix::<2>::new(0.0, 1e-200, 1e-200, 0.0),
    ] {
        assert_eq!(refused(by_momentum(x, bad, p, spin), "phi"), "det phi");
        assert_eq!(refused(by_velocity(x, bad, p, spin), "phi"), "det phi");
    }
    // Numbers whose products are none.
    assert_eq!(refused(by_velocity(x, phi * 1e-300, p, spin * 1e300), "phi_dot"), "Sigma_hat");
}

#[test]
fn of_a_confined_body() {
    let phi = Matrix::<2>::new(2.0, 0.0, 0.0, 0.5);
    let (x, v, rate) =
        (Vector::<2>::zeros(), Vector::<2>::new(1.0, 2.0), Matrix::<2>::new(0.4, 0.0, 0.6, -0.1));
    assert!(Droplet.at_velocity(x, phi, v, rate).is_ok());
    for bad in spoilt(phi) {
        assert_eq!(refused(Droplet.at_velocity(x, bad, v, rate), "phi"), "det phi");
        assert_eq!(refused(Droplet.at_momentum(x, bad, v, TwoPoint(rate)), "phi"), "det phi");
    }
    for bad in spoilt(rate) {
        assert_eq!(refused(Droplet.at_velocity(x, phi, v, bad), "phi_dot"), "phi_dot");
        assert_eq!(refused(Droplet.at_momentum(x, phi, v, TwoPoint(bad)), "Pi"), "Pi");
    }
    for bad in spoilt_vectors(v) {
        assert_eq!(refused(Droplet.at_velocity(x, phi, bad, rate), "x_dot"), "p");
        assert_eq!(refused(Droplet.at_velocity(bad, phi, v, rate), "x"), "x");
    }
    // Off the group, and off its tangent space: by how much.
    let off = |made: Result<_>, named: &str, size: f64| {
        let Err(error @ Error::OffConstraint { quantity, defect, threshold, .. }) = made.map(|_: ()| ())
        else {
            panic!("{named}: made")
        };
        assert!(quantity == named && defect > threshold && (defect / size - 1.0).abs() < 0.5, "{error}");
        assert!(error.to_string().contains(&format!("{named} violates")), "{error}");
    };
    off(Droplet.at_velocity(x, phi * 1.1, v, rate).map(|_| ()), "phi", 0.21);
    off(Droplet.at_velocity(x, phi, v, phi).map(|_| ()), "phi_dot", 2.0_f64.sqrt());
    let (x, still, turn) = (Vector::<3>::zeros(), Vector::<3>::zeros(), Matrix::<3>::zeros());
    off(
        Top.at_velocity(x, Matrix::<3>::identity() * 1.1, still, turn).map(|_| ()),
        "phi",
        0.21 * 3.0_f64.sqrt(),
    );
    off(
        Top.at_velocity(x, Matrix::<3>::identity(), still, Matrix::<3>::identity()).map(|_| ()),
        "phi_dot",
        3.0_f64.sqrt(),
    );
    // A mirror is orthogonal and no rotation.
    assert_eq!(refused(Top.at_velocity(x, -Matrix::<3>::identity(), still, turn), "a mirror"), "det phi");
}

#[affine_model(
    dim = 2,
    kinetic(dalembert = 1, space_translation = 2),
    potential = 3*x[2]*t + x[1]*sin(t)^3,
    emit(nystrom),
)]
struct Pushed;

/// A force that is zero at the start says nothing about the length of the first step: x_2 = -t^3/4 from rest.
#[test]
fn at_rest_and_pushed_later() {
    let (zero, unit) = (Vector::<2>::zeros(), Matrix::<2>::identity());
    let start = Pushed.at_momentum(zero, unit, zero, TwoPoint(Matrix::<2>::zeros())).unwrap();
    for method in [
        Method::Automatic,
        Method::RungeKutta8,
        Method::RungeKutta5,
        Method::RungeKuttaNystrom8,
        Method::RungeKuttaNystrom12,
        Method::Gauss { stages: 3, step: 0.01 },
    ] {
        let run = Simulation::new(&Pushed, start).until(1.0).tolerance(1e-9).max_steps(200).method(method);
        let run = run.run().unwrap_or_else(|halt| panic!("{method:?}: {halt}"));
        assert!((run.end().1.x()[1] + 0.25).abs() < 1e-9, "{method:?}: {}", run.end().1.x());
        assert!(run.times().windows(2).all(|w| w[1] > w[0]), "{method:?}");
    }
}
