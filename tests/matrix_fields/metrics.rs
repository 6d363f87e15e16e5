//! Metrics in fields against the same energies with the metrics written out, on random metrics.

use affine_oracle::{Kinetic, Matrix as Exact, Random, Rational, Term, rational};
use affine_runtime::metrics::orthonormal;
use affine_runtime::prelude::*;

use super::literals::close;

/// `K[(A,B),(C,D)] = left[A,C] right[B,D]`: the form `tr(right O^T left O)`.
fn product(n: usize, left: &Exact, right: &Exact) -> Exact {
    let pairs = || (0..n * n).map(|k| (k / n, k % n));
    let entries: Vec<Rational> = pairs()
        .flat_map(|(a, b)| pairs().map(move |(c, d)| (a, b, c, d)))
        .map(|(a, b, c, d)| left.entry(a, c) * right.entry(b, d))
        .collect();
    Exact::from_rationals(n * n, n * n, &entries)
}

/// `I/2 tr(eta^-1 Oh^T eta Oh) + A/2 tr Oh^2 + m/2 g(x_dot, x_dot)`.
#[test]
fn spatially_affine() {
    #[affine_model(
        dim = 3,
        metrics(space = g, body = eta),
        kinetic(casimir2 = 0.2, body_inertia = 1, space_translation = m)
    )]
    struct Body {
        g: Matrix<3>,
        eta: [[f64; 3]; 3],
        m: f64,
    }
    for seed in 0..8 {
        let mut random = Random::new(911 + seed);
        let (g, eta, state) = (random.inertia(3), random.inertia(3), random.state(3));
        let rows = Matrix::<3>::from_row_slice(&eta.to_f64());
        let fields = Body {
            g: Matrix::<3>::from_row_slice(&g.to_f64()),
            eta: core::array::from_fn(|i| core::array::from_fn(|j| rows[(i, j)])),
            m: 2.0,
        };
        let terms = vec![
            Term::BodyTensor(product(3, &eta, &eta.inverse().unwrap())),
            Term::Casimir2(rational(1, 5)),
            Term::SpaceTranslationMetric(g.scaled(&rational(2, 1))),
        ];
        let expected = Kinetic::new(3, terms).unwrap().expected(&state).unwrap();
        let model = fields.prepare().unwrap();
        let [x, p] = [&state.x, &state.p].map(|v| Vector::<3>::from_column_slice(&v.to_f64()));
        let [phi, pi] = [&state.phi, &state.pi].map(|m| Matrix::<3>::from_row_slice(&m.to_f64()));
        let point = model.at_momentum(x, phi, p, TwoPoint(pi)).unwrap();
        let velocity = model.velocity(&point);
        close("x_dot", velocity.x_dot.as_slice(), &expected.x_dot);
        close("phi_dot", velocity.phi_dot.transpose().as_slice(), &expected.phi_dot);
        close("H", &[model.hamiltonian(0.0, &point)], &[expected.hamiltonian]);
        close("T", &[model.kinetic_energy(&phi, &velocity)], &[expected.hamiltonian]);
        let back = model.at_velocity(x, phi, velocity.x_dot, velocity.phi_dot).unwrap();
        close("Pi", back.pi().0.0.as_slice(), pi.as_slice());
        // Pi_dot by central differences along the reduced motion, exact but for h^2 and eps/h.
        let (reduced, constants) = model.reduce(0.0, &point);
        let rates = model.reduced_equations(0.0, &constants, &reduced);
        let after = |h: f64| {
            let mut moved = reduced;
            for (value, rate) in moved.as_mut().iter_mut().zip(rates.as_ref()) {
                *value += h * rate;
            }
            model.expand(h, &constants, &moved).pi().0.0
        };
        let slope = (after(1e-4) - after(-1e-4)) / 2e-4;
        let error = (slope.transpose() - Matrix::<3>::from_column_slice(&expected.pi_dot)).norm();
        assert!(error < 1e-5 * (1.0 + slope.norm()), "{error:e}");
    }
}

/// The equations do not know of the metrics.
#[test]
fn the_right_hand_side_does_not_grow() {
    #[affine_model(dim = 3, metrics(space = g), kinetic(casimir2 = 0.2, body_inertia = 1, body_translation = 1))]
    struct Body {
        g: Matrix<3>,
    }
    #[affine_model(dim = 3, kinetic(casimir2 = 0.2, body_inertia = 1, body_translation = 1))]
    struct Plain;
    assert_eq!(PreparedBody::DESCRIPTION.reduced_operations, Plain::DESCRIPTION.reduced_operations);
    assert_eq!(PreparedBody::DESCRIPTION.full_operations, Plain::DESCRIPTION.full_operations);
    let model = Body { g: Matrix::<3>::identity() }.prepare().unwrap();
    assert_eq!(model.bases().unwrap().space, Matrix::<3>::identity());
}

#[test]
fn factors_give_the_metric_back() {
    for seed in 0..32 {
        let metric = Random::new(1301 + seed).inertia(3);
        let rows = Matrix::<3>::from_row_slice(&metric.to_f64());
        let entries = core::array::from_fn(|i| core::array::from_fn(|j| rows[(i, j)]));
        let (factor, inverse) = orthonormal::<3, _>(entries, "g > 0").unwrap();
        close("A^T A", factor.tr_mul(&factor).as_slice(), rows.as_slice());
        close("A A^-1", (factor * inverse).as_slice(), Matrix::<3>::identity().as_slice());
        assert!(factor.lower_triangle() == Matrix::<3>::from_diagonal(&factor.diagonal()));
    }
}
