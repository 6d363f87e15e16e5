//! What a model says of where its potential has a value.

use affine_runtime::model::{Bound, Description};
use affine_runtime::prelude::*;

fn listed(description: &Description) -> Vec<(&'static str, &'static str, Bound)> {
    description.domain.iter().map(|guard| (guard.part, guard.argument, guard.bound)).collect()
}

/// Logarithms, roots, divisors by their factors, and tangents, as they are written.
#[test]
fn parts_and_arguments() {
    #[affine_model(
        dim = 2,
        kinetic(dalembert = 1, space_translation = 1),
        potential = ln(q + k) + sqrt(x[1]) - 3/(x[1]*q^2) + (phi[1,2] - 2)^-1 + tan(x[2]) + ln(x[2]^2) + 1/x[1]
    )]
    #[allow(dead_code, reason = "what is said of the type is asked for alone")]
    struct Rich {
        k: f64,
    }
    let found = listed(&<PreparedRich as Model<2>>::DESCRIPTION);
    assert_eq!(
        found,
        [
            ("ln(q + k)", "q + k", Bound::Positive),
            ("sqrt(x[1])", "x[1]", Bound::NotNegative),
            ("3/(x[1]*q^2)", "q", Bound::NotZero),
            ("(phi[1,2] - 2)^-1", "phi[1,2] - 2", Bound::NotZero),
            ("tan(x[2])", "cos(x[2])", Bound::NotZero),
            ("ln(x[2]^2)", "x[2]", Bound::NotZero),
        ]
    );
}

/// What is positive at every state, or a number, says nothing.
#[test]
fn what_always_has_a_value() {
    #[affine_model(
        dim = 3,
        kinetic(dalembert = 1, space_translation = 1),
        potential = ln(det) + ln(tr(G)) + 1/(1 + x[1]^2) + sqrt(1 + q^2) + 1/Q1 + 1/Q2 + 1/Q3 + pairs(ln(1 + d^2))
            + q/cosh(q) - 1/norm(x) + sqrt(2)*q
    )]
    #[allow(dead_code, reason = "likewise")]
    struct Everywhere;
    assert_eq!(listed(&<PreparedEverywhere as Model<3>>::DESCRIPTION), []);
}

/// On the group of a constraint less can change its sign.
#[test]
fn under_a_constraint() {
    #[affine_model(
        dim = 2,
        constraint = rigid,
        kinetic(body_inertia = 1),
        potential = ln(q + 2)*phi[1,1] + 1/(3 + phi[1,2])
    )]
    #[allow(dead_code, reason = "likewise")]
    struct Top;
    assert_eq!(
        listed(&<PreparedTop as Model<2>>::DESCRIPTION),
        [("1/(3 + phi[1,2])", "3 + phi[1,2]", Bound::NotZero)]
    );
}

/// The values are those of the arguments in the bases of the user, one after the other.
#[test]
fn values_beside_metrics() {
    #[affine_model(
        dim = 2,
        metrics(space = [[2, 0.5], [0.5, 1.5]], body = diag(1, 4)),
        kinetic(casimir2 = 0.2, body_inertia = 1, body_translation = 2),
        potential = ln(G[1,2] + 5) + 1/(phi[2,1] + 3*t) + sqrt(x[1] + 1) + ln(q + 1)
    )]
    struct Body;
    let phi = Matrix::<2>::new(1.3, 0.2, 0.1, 0.8);
    let (x, p) = (Vector::<2>::new(0.25, -1.0), Vector::<2>::zeros());
    let point = Body.at_momentum(x, phi, p, TwoPoint(Matrix::<2>::zeros())).unwrap();
    let mut values = Vec::new();
    Body.domain(0.5, &point, &mut |value| values.push(value));
    let metric = Matrix::<2>::new(2.0, 0.5, 0.5, 1.5);
    let green = phi.transpose() * metric * phi;
    let q = 0.5 * (phi.determinant() * (metric.determinant() / 4.0).sqrt()).ln();
    let expected = [green[(0, 1)] + 5.0, phi[(1, 0)] + 1.5, x[0] + 1.0, q + 1.0];
    assert_eq!(values.len(), expected.len());
    for (value, expected) in values.iter().zip(expected) {
        assert!((value - expected).abs() < 1e-14, "{values:?}");
    }
}
