//! Exact laws from the literature: the gas cloud, straight lines, scaling.

use affine_runtime::prelude::*;

use affine_tests::reference::{assert_close, entries, norm};
use affine_tests::tolerances::LAWS;

/// A monatomic gas cloud: `V = k det(phi)^(-2/3)`, homogeneous of degree -2, `J = m 1`.
#[affine_model(dim = 3, kinetic(dalembert = m), potential = gas(k))]
struct Cloud {
    m: f64,
    k: f64,
}

/// Free d'Alembert body.
#[affine_model(dim = 3, kinetic(dalembert = diag(1, 1.5, 2)))]
struct Free;

/// Affine in space, metrical in the body.
#[affine_model(dim = 3, kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1))]
struct Left;

/// The same with translation: the drunk missile.
#[affine_model(
    dim = 3,
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, body_translation = 1)
)]
struct Missile;

const TOLERANCE: f64 = 1e-15;

fn placement() -> Matrix<3> {
    Matrix::<3>::new(1.1, 0.2, -0.1, 0.05, 0.9, 0.15, -0.2, 0.1, 1.05)
}

fn spin() -> Matrix<3> {
    Matrix::<3>::new(0.1, 0.4, -0.3, -0.2, -0.15, 0.25, 0.35, -0.1, 0.05)
}

/// `d^2/dt^2 tr(phi^T phi) = 4 E/m`: along every motion `tr(phi^T phi)` is a quadratic function of time with the leading
/// coefficient `2 E/m` (F. J. Dyson, J. Math. Mech. 18, 91, 1968; Lagrange and Jacobi for degree -2).
#[test]
fn gas_clouds_expand_quadratically() {
    let model = Cloud { m: 1.5, k: 0.7 }.prepare().unwrap();
    let start = model.at_velocity(placement(), spin()).unwrap();
    let energy = model.hamiltonian(0.0, &start);
    let run = Simulation::new(&model, start)
        .until(8.0)
        .tolerance(TOLERANCE)
        .output((1..=16).map(|k| 0.5 * f64::from(k)))
        .run()
        .unwrap();
    let (size, rate) = (placement().norm_squared(), 2.0 * placement().dot(&spin()));
    for (t, point) in run.iter() {
        let expected = size + rate * t + 2.0 * energy / 1.5 * t * t;
        assert_close("tr G", &[point.phi().norm_squared()], &[expected], expected, LAWS);
    }
}

/// Without a potential a d'Alembert body moves along straight lines: `phi = phi0 + t phi_dot0`.
#[test]
fn free_bodies_go_straight() {
    let start = Free.at_velocity(placement(), spin()).unwrap();
    for method in [Method::Automatic, Method::RungeKutta8] {
        let run = Simulation::new(&Free, start).until(1.5).method(method).tolerance(1e-13).run().unwrap();
        let expected = placement() + spin() * 1.5;
        assert_close("phi", &entries(run.end().1.phi()), &entries(&expected), expected.norm(), LAWS);
    }
}

/// Geodesics with the momenta `c p` run through the same places `c` times as fast.
#[test]
fn geodesics_scale_with_their_momenta() {
    let p = Vector::<3>::new(0.3, -0.2, 0.5);
    let at =
        |c: f64| Missile.at_momentum(Vector::<3>::zeros(), placement(), p * c, Comoving(spin() * c)).unwrap();
    let run = |c: f64| {
        let run = Simulation::new(&Missile, at(c)).until(4.0 / c).tolerance(TOLERANCE).run().unwrap();
        *run.end().1
    };
    let slow = run(1.0);
    for c in [0.125, 3.0, 1e6] {
        let fast = run(c);
        let close = |what, found: &[f64], expected: &[f64]| {
            assert_close(what, found, expected, norm(expected), LAWS);
        };
        close("x", fast.x().as_slice(), slow.x().as_slice());
        close("phi", &entries(fast.phi()), &entries(slow.phi()));
        let scaled = fast.sigma_hat().0.0 / c;
        close("Sigma_hat", &entries(&scaled), &entries(&slow.sigma_hat().0.0));
    }
}

/// Models that are affine in space do not see the scale of the placement: `phi -> c phi` keeps the co-moving motion, bit
/// for bit where `c` is a power of two.
#[test]
fn left_affine_bodies_have_no_scale() {
    let run = |c: f64| {
        let start = Left.at_momentum(placement() * c, Comoving(spin())).unwrap();
        let run = Simulation::new(&Left, start).until(5.0).method(Method::RungeKutta8).run().unwrap();
        *run.end().1
    };
    let unit = run(1.0);
    for c in [2f64.powi(40), 2f64.powi(-40)] {
        let scaled = run(c);
        assert_eq!(entries(&(scaled.phi() / c)), entries(unit.phi()));
        assert_eq!(entries(&scaled.sigma_hat().0.0), entries(&unit.sigma_hat().0.0));
    }
    for c in [1e100, 1e-100, 3.7] {
        let scaled = run(c);
        assert_close("phi", &entries(&(scaled.phi() / c)), &entries(unit.phi()), unit.phi().norm(), LAWS);
    }
}
