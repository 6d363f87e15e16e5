//! Quantities that are asked for, in the user's bases.

use affine_oracle::{Kinetic, Matrix as Exact, Random, Term, rational};
use affine_runtime::prelude::*;

use super::{close, product, space};

/// `Gamma(phi)` is the mass matrix of the oracle in the user's coordinates; `x_ddot` the derivative of `x_dot` along
/// Hamilton's equations.
#[test]
fn metric_and_acceleration() {
    #[affine_model(
        dim = 3,
        metrics(space = [[2, 0.5, 0], [0.5, 1.5, -0.25], [0, -0.25, 1]],
                body = [[1, -0.4, 0.2], [-0.4, 3, 0], [0.2, 0, 1.25]]),
        kinetic(casimir2 = 0.2, body_inertia = [[1.5, 0.25, 0], [0.25, 2, -0.5], [0, -0.5, 1.25]], body_translation = 2),
        emit(metric, acceleration)
    )]
    struct Missile;
    let [_, _, eta, _] = space();
    let inertia = super::twentieths(3, &[30, 5, 0, 5, 40, -10, 0, -10, 25]);
    let kinetic = Kinetic::new(
        3,
        vec![
            Term::BodyTensor(product(3, &eta, &inertia)),
            Term::Casimir2(rational(1, 5)),
            Term::BodyTranslationMetric(eta.scaled(&rational(2, 1))),
        ],
    )
    .unwrap();
    for seed in 0..4 {
        let state = Random::new(5201 + seed).state(3);
        let [phi, pi] = [&state.phi, &state.pi].map(|m| Matrix::<3>::from_row_slice(&m.to_f64()));
        let [x, p] = [&state.x, &state.p].map(|v| Vector::<3>::from_column_slice(&v.to_f64()));
        let mass: Exact = kinetic.mass_matrix(&state.phi).unwrap();
        close("Gamma", Missile.metric(&phi).as_slice(), &mass.to_f64(), 1.0);
        let unit = Missile.metric(&phi) * Missile.inverse_metric(&phi);
        close("Gamma Gamma^-1", unit.as_slice(), Matrix::<12>::identity().as_slice(), 1.0);
        let point = Missile.at_momentum(x, phi, p, TwoPoint(pi)).unwrap();
        // x_dot is a function of (phi, p), which the exact equations move.
        let rate = kinetic.expected(&state).unwrap();
        let h = 1e-4;
        let moved = |h: f64| {
            let phi = phi + Matrix::<3>::from_row_slice(&rate.phi_dot) * h;
            let p = p + Vector::<3>::from_column_slice(&rate.p_dot) * h;
            Missile.velocity(&Missile.at_momentum(x, phi, p, TwoPoint(pi)).unwrap()).x_dot
        };
        let slope = (moved(h) - moved(-h)) / (2.0 * h);
        let error = (Missile.acceleration(&point) - slope).norm();
        // x_dot is quadratic in phi: the difference is exact but for eps/h.
        assert!(error < 1e-9 * (1.0 + slope.norm()), "{error:e}");
    }
}
