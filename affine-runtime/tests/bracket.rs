//! Poisson brackets of functions of a point against the table of section 2, Jacobi's identity and the flow.
#![allow(missing_docs, clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use affine_runtime::bracket::poisson_bracket;
use affine_runtime::dual::Dual;
use affine_runtime::model::{Constraint, StateVector};
use affine_runtime::prelude::*;
use affine_runtime::scalar::Real;

#[affine_model(dim = 2, kinetic(casimir2 = 0.2, body_inertia = 1, body_translation = 2), potential = tr(G)/2 + x[1]^2)]
struct Left2;
#[affine_model(dim = 3, kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, body_translation = 1), potential = tr(G)/2 - ln(det))]
struct Left3;
#[affine_model(dim = 3, kinetic(casimir2 = 0.2, space_inertia = 1, space_translation = 2), potential = Ct[1,2] + x[2])]
struct Right3;
#[affine_model(dim = 3, kinetic(dalembert = diag(1, 2, 3), space_translation = 2), potential = phi[1,2] + norm(x))]
struct Flat3;

/// Numbers without a pattern.
fn number(k: usize) -> f64 {
    (1.3 * k as f64 + 0.7).sin() * 0.6
}

fn point<const N: usize, M: Model<N>>(model: &M) -> M::Point<f64> {
    let mut full = M::Full::<f64>::zeros();
    full.as_mut().iter_mut().enumerate().for_each(|(k, entry)| *entry = number(k));
    let point = model.unflatten(&full);
    let phi = Matrix::<N>::from_fn(|i, a| number(N * i + a) / 2.0 + if i == a { 1.2 } else { 0.0 });
    point.moved(point.x(), phi, |spin| *spin)
}

fn delta(i: usize, j: usize) -> f64 {
    if i == j { 1.0 } else { 0.0 }
}

/// `{Sigma^i_j, Sigma^k_l} = d_il Sigma^k_j - d_kj Sigma^i_l`, the co-moving ones with the other sign, `I(O)` as `Sigma`;
/// `{Sigma, Sigma_hat} = 0`, `{Sigma_hat^A_B, p_hat_C} = -d_AC p_hat_B`, `{I^i_j, p_k} = d_ik p_j`, `{I, p_hat} = 0`, `{x, p_hat} =
/// phi`.
fn has_the_table<const N: usize, M: Model<N>>(model: &M) {
    let at = point::<N, M>(model);
    type Number = Dual<f64>;
    let sigma = |i, j| move |at: &M::Point<Number>| at.sigma().0.0[(i, j)];
    let sigma_hat = |i, j| move |at: &M::Point<Number>| at.sigma_hat().0.0[(i, j)];
    let total = |i, j| move |at: &M::Point<Number>| at.total_affine_momentum().0.0[(i, j)];
    let p = |k: usize| move |at: &M::Point<Number>| at.p()[k];
    let p_hat = |k: usize| move |at: &M::Point<Number>| at.p_hat().0.0[k];
    let x = |k: usize| move |at: &M::Point<Number>| at.x()[k];
    let (s, h, t) = (at.sigma().0.0, at.sigma_hat().0.0, at.total_affine_momentum().0.0);
    let near = |found: f64, known: f64, what: &str| {
        assert!((found - known).abs() < 1e-13, "{} {what}: {found} {known}", M::DESCRIPTION.name);
    };
    let pairs = || (0..N).flat_map(|i| (0..N).map(move |j| (i, j)));
    for (i, j) in pairs() {
        for (k, l) in pairs() {
            let structure = |m: &Matrix<N>| delta(i, l) * m[(k, j)] - delta(k, j) * m[(i, l)];
            near(poisson_bracket(model, &at, sigma(i, j), sigma(k, l)), structure(&s), "Sigma");
            near(poisson_bracket(model, &at, total(i, j), total(k, l)), structure(&t), "I(O)");
            near(poisson_bracket(model, &at, sigma_hat(i, j), sigma_hat(k, l)), -structure(&h), "Sigma_hat");
            near(poisson_bracket(model, &at, sigma(i, j), sigma_hat(k, l)), 0.0, "Sigma and Sigma_hat");
        }
        for k in 0..N {
            let (space, body) = (at.p(), at.p_hat().0.0);
            near(poisson_bracket(model, &at, sigma_hat(i, j), p_hat(k)), -delta(i, k) * body[j], "p_hat");
            near(poisson_bracket(model, &at, total(i, j), p(k)), delta(i, k) * space[j], "p");
            near(poisson_bracket(model, &at, total(i, j), p_hat(k)), 0.0, "I(O) and p_hat");
        }
        near(poisson_bracket(model, &at, x(i), p_hat(j)), at.phi()[(i, j)], "x and p_hat");
    }
    let q = |at: &M::Point<Number>| at.phi().mean_log_stretch();
    let p_dil = |at: &M::Point<Number>| at.sigma().dilatational_momentum();
    near(poisson_bracket(model, &at, q, p_dil), 1.0, "q and p_dil");
}

#[test]
fn the_table_of_section_2() {
    has_the_table::<2, _>(&Left2);
    has_the_table::<3, _>(&Left3);
    has_the_table::<3, _>(&Right3);
    has_the_table::<3, _>(&Flat3);
}

/// Functions without a symmetry.
fn observable<const N: usize, T: Real, P: Phase<N, T>>(kind: usize, at: &P) -> T {
    let (phi, spin) = (at.phi(), at.sigma().0.0);
    match kind {
        0 => (phi * spin).trace() * at.p()[0] + phi[(0, 1)].sin(),
        1 => spin[(0, 1)] * spin[(1, 0)] + at.x()[1] * at.p()[0] + phi.dot(phi),
        _ => at.sigma_hat().casimir(2) * phi[(1, 0)] + at.p_hat().0.0[1] * at.x()[0],
    }
}

#[test]
fn jacobis_identity() {
    type Point<T> = <Left3 as Model<3>>::Point<T>;
    let at = point::<3, _>(&Left3);
    let nested = |a: usize, b: usize, c: usize| {
        let inner = |at: &Point<Dual<f64>>| {
            poisson_bracket(
                &Left3,
                at,
                |at: &Point<Dual<Dual<f64>>>| observable(b, at),
                |at: &Point<Dual<Dual<f64>>>| observable(c, at),
            )
        };
        poisson_bracket(&Left3, &at, |at: &Point<Dual<f64>>| observable(a, at), inner)
    };
    let [first, second, third] = [nested(0, 1, 2), nested(1, 2, 0), nested(2, 0, 1)];
    assert!(first.abs() > 1e-2 && second.abs() > 1e-2, "{first} {second} {third}");
    assert!((first + second + third).abs() < 1e-12, "{first} {second} {third}");
}

/// `{F, H}` is the derivative of `F` along Hamilton's equations.
fn is_the_rate<const N: usize, M: Model<N>>(model: &M) {
    is_the_rate_at(model, point::<N, M>(model));
}

fn is_the_rate_at<const N: usize, M: Model<N>>(model: &M, at: M::Point<f64>) {
    let full = model.flatten(&at);
    let rates = model.hamilton_equations(0.0, &full);
    let mut moving = M::Full::<Dual<f64>>::zeros();
    let both = full.as_ref().iter().zip(rates.as_ref());
    for (entry, (value, slope)) in moving.as_mut().iter_mut().zip(both) {
        *entry = Dual { value: *value, slope: *slope };
    }
    let moving = model.unflatten(&moving);
    for kind in 0..3 {
        let f = |at: &M::Point<Dual<f64>>| observable(kind, at);
        let energy = |at: &M::Point<Dual<f64>>| model.hamiltonian(Dual::fixed(0.0), at);
        let (bracket, rate) = (poisson_bracket(model, &at, f, energy), f(&moving).slope);
        let name = M::DESCRIPTION.name;
        assert!((bracket - rate).abs() < 1e-12 * rate.abs().max(1.0), "{name} {kind}: {bracket} {rate}");
    }
}

#[test]
fn the_bracket_with_the_energy_is_the_rate() {
    is_the_rate::<2, _>(&Left2);
    is_the_rate::<3, _>(&Left3);
    is_the_rate::<3, _>(&Right3);
    is_the_rate::<3, _>(&Flat3);
}

#[affine_model(dim = 2, constraint = rigid, kinetic(dalembert = 1/2), potential = phi[2,2])]
struct Pendulum;
#[affine_model(dim = 3, constraint = rigid, kinetic(dalembert = diag(1, 0.7, 0.4), space_translation = 2), potential = phi[3,3] + norm(x)^2)]
struct Top;
#[affine_model(dim = 3, constraint = isochoric, kinetic(body_inertia = diag(1, 0.7, 0.4)), potential = tr(G))]
struct Fluid;
#[affine_model(dim = 3, constraint = isochoric, kinetic(casimir2 = 0.2, space_inertia = 1), potential = Ct[1,2])]
struct InSpace;
#[affine_model(dim = 3, constraint = conformal, kinetic(body_inertia = 1, casimir2 = 0.2), potential = q^2)]
struct Bubble;

/// A point on the group of a constraint.
fn confined<const N: usize, M: Model<N>>(model: &M, constraint: Constraint) -> M::Point<f64> {
    let any = point::<N, M>(model);
    let exponent = projected(constraint, &Matrix::<N>::from_fn(|i, a| number(N * i + a + 40)));
    any.moved(any.x(), exponent.exponential(), |spin| projected(constraint, spin))
}

/// `P X` of the constraints.
fn projected<const N: usize>(constraint: Constraint, x: &Matrix<N>) -> Matrix<N> {
    let mean = Matrix::<N>::identity() * (x.trace() / N as f64);
    let skew = (x - x.transpose()) / 2.0;
    match constraint {
        Constraint::Isochoric => x - mean,
        Constraint::Rigid => skew,
        Constraint::Conformal => skew + mean,
    }
}

/// On groups likewise, where momenta are those of the group.
#[test]
fn the_bracket_of_a_group_is_the_rate() {
    fn check<const N: usize, M: Model<N>>(model: &M) {
        let constraint = M::DESCRIPTION.constraint.unwrap();
        is_the_rate_at(model, confined(model, constraint));
    }
    check::<2, _>(&Pendulum);
    check::<3, _>(&Top);
    check::<3, _>(&Fluid);
    check::<3, _>(&InSpace);
    check::<3, _>(&Bubble);
}
