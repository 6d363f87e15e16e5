//! Models with constant metrics against the same energies with the metrics written out.
#![allow(missing_docs, clippy::unwrap_used, clippy::expect_used, clippy::panic)]

#[path = "metrics/components.rs"]
mod components;
#[path = "metrics/conserved.rs"]
mod conserved;
#[path = "metrics/dissipation.rs"]
mod dissipation;
#[path = "metrics/fields.rs"]
mod fields;
#[path = "metrics/forces.rs"]
mod forces;
#[path = "metrics/kinematics.rs"]
mod kinematics;
#[path = "metrics/matrices.rs"]
mod matrices;
#[path = "metrics/quantities.rs"]
mod quantities;

use affine_oracle::{Expected, Kinetic, Matrix as Exact, Random, Rational, State, Term, rational};
use affine_runtime::prelude::*;

/// Of conversions between the bases and of the Legendre transformation, in models of condition below 1e3.
const TOLERANCE: f64 = 1e-12;

fn close(what: &str, found: &[f64], expected: &[f64], size: f64) {
    let norm = |entries: &[f64]| entries.iter().fold(0.0, |length, entry| f64::hypot(length, *entry));
    assert_eq!(found.len(), expected.len(), "{what}");
    let difference: Vec<f64> = found.iter().zip(expected).map(|(f, e)| f - e).collect();
    let size = size.max(norm(expected));
    assert!(norm(&difference) <= TOLERANCE * size, "{what}: {found:?} {expected:?}");
}

fn rows<const N: usize>(matrix: &Matrix<N>) -> Vec<f64> {
    matrix.transpose().as_slice().to_vec()
}

/// `[[..], ..]` of quotients of 20, as an exact matrix.
fn twentieths(n: usize, entries: &[i64]) -> Exact {
    let entries: Vec<Rational> = entries.iter().map(|entry| rational(*entry, 20)).collect();
    Exact::from_rationals(n, n, &entries)
}

/// `K[(A,B),(C,D)] = left[A,C] right[B,D]`: the form `tr(right O^T left O)`.
fn product(n: usize, left: &Exact, right: &Exact) -> Exact {
    let pairs = || (0..n * n).map(|k| (k / n, k % n));
    let entries: Vec<Rational> = pairs()
        .flat_map(|(a, b)| pairs().map(move |(c, d)| (a, b, c, d)))
        .map(|(a, b, c, d)| left.entry(a, c) * right.entry(b, d))
        .collect();
    Exact::from_rationals(n * n, n * n, &entries)
}

/// What a point has, and what moves it, against the canonical equations in the user's own coordinates.
fn agrees<const N: usize, M: Model<N>>(
    model: &M,
    kinetic: &Kinetic,
    at: impl Fn(&State) -> M::Point<f64>,
    back: impl Fn(&M::Point<f64>, &affine_runtime::model::Velocity<N>) -> M::Point<f64>,
) {
    agrees_under(model, kinetic, |state| kinetic.expected(state).unwrap(), at, back);
}

/// The same with whatever else moves the point.
fn agrees_under<const N: usize, M: Model<N>>(
    model: &M,
    kinetic: &Kinetic,
    motion: impl Fn(&State) -> Expected,
    at: impl Fn(&State) -> M::Point<f64>,
    back: impl Fn(&M::Point<f64>, &affine_runtime::model::Velocity<N>) -> M::Point<f64>,
) {
    for seed in 0..4 {
        let mut state = Random::new(3100 + seed).state(N);
        if !kinetic.has_translation() {
            state = State { x: Exact::zeros(N, 1), ..state.at_rest() };
        }
        let expected = motion(&state);
        let point = at(&state);
        let velocity = model.velocity(&point);
        let energy = kinetic.expected(&state).unwrap().hamiltonian;
        close("x_dot", velocity.x_dot.as_slice(), &expected.x_dot, 1.0);
        close("phi_dot", &rows(&velocity.phi_dot), &expected.phi_dot, 1.0);
        close("H", &[model.hamiltonian(0.0, &point)], &[expected.hamiltonian], 10.0);
        close("T", &[model.kinetic_energy(point.phi(), &velocity)], &[energy], 10.0);
        let again = back(&point, &velocity);
        close("Pi", &rows(&again.pi().0.0), &state.pi.to_f64(), 1.0);
        close("p", again.p().as_slice(), &state.p.to_f64(), 1.0);

        // Along Hamilton's equations of the plain array, and along the reduced ones, by central differences that are
        // exact for the quadratic part of the motion.
        let (full, h) = (model.flatten(&point), 1e-4);
        let rates = model.hamilton_equations(0.0, &full);
        let shifted = |h: f64| {
            let mut full = full;
            for (value, rate) in full.as_mut().iter_mut().zip(rates.as_ref()) {
                *value += h * rate;
            }
            model.unflatten(&full)
        };
        let (reduced, constants) = model.reduce(0.0, &point);
        let reduced_rates = model.reduced_equations(0.0, &constants, &reduced);
        let expanded = |h: f64| {
            let mut reduced = reduced;
            for (value, rate) in reduced.as_mut().iter_mut().zip(reduced_rates.as_ref()) {
                *value += h * rate;
            }
            model.expand(h, &constants, &reduced)
        };
        let slope = |curve: &dyn Fn(f64) -> M::Point<f64>, of: &dyn Fn(&M::Point<f64>) -> Vec<f64>| {
            let (after, before) = (of(&curve(h)), of(&curve(-h)));
            after.iter().zip(&before).map(|(a, b)| (a - b) / (2.0 * h)).collect::<Vec<f64>>()
        };
        for curve in [&shifted as &dyn Fn(f64) -> M::Point<f64>, &expanded] {
            for (what, of, expected) in [
                (
                    "phi",
                    &(|p: &M::Point<f64>| rows(p.phi())) as &dyn Fn(&M::Point<f64>) -> Vec<f64>,
                    &expected.phi_dot,
                ),
                ("x", &|p: &M::Point<f64>| p.x().as_slice().to_vec(), &expected.x_dot),
                ("p", &|p: &M::Point<f64>| p.p().as_slice().to_vec(), &expected.p_dot),
                ("Pi", &|p: &M::Point<f64>| rows(&p.pi().0.0), &expected.pi_dot),
            ] {
                let found = slope(curve, of);
                let size = expected.iter().fold(1.0_f64, |size, value| size.max(value.abs()));
                let error =
                    found.iter().zip(expected).fold(0.0_f64, |error, (f, e)| error.max((f - e).abs()));
                // Third derivatives times h^2, and eps/h.
                assert!(error <= 1e-5 * size, "{what}: {found:?} {expected:?}");
            }
        }
    }
}

macro_rules! pinned {
    ($model:ident, $n:literal) => {
        (
            |state: &affine_oracle::State| {
                let (phi, pi) = (state.phi.to_f64(), state.pi.to_f64());
                let [phi, pi] = [phi, pi].map(|m| Matrix::<$n>::from_row_slice(&m));
                $model.at_momentum(phi, TwoPoint(pi)).unwrap()
            },
            |point: &_, velocity: &affine_runtime::model::Velocity<$n>| {
                $model.at_velocity(*Phase::<$n>::phi(point), velocity.phi_dot).unwrap()
            },
        )
    };
}

macro_rules! moving {
    ($model:ident, $n:literal) => {
        (
            |state: &affine_oracle::State| {
                let [x, p] = [&state.x, &state.p].map(|v| Vector::<$n>::from_column_slice(&v.to_f64()));
                let [phi, pi] = [&state.phi, &state.pi].map(|m| Matrix::<$n>::from_row_slice(&m.to_f64()));
                $model.at_momentum(x, phi, p, TwoPoint(pi)).unwrap()
            },
            |point: &_, velocity: &affine_runtime::model::Velocity<$n>| {
                let (x, phi) = (Phase::<$n>::x(point), *Phase::<$n>::phi(point));
                $model.at_velocity(x, phi, velocity.x_dot, velocity.phi_dot).unwrap()
            },
        )
    };
}

fn plane() -> [Exact; 4] {
    let (g, eta) = (twentieths(2, &[40, 10, 10, 30]), twentieths(2, &[20, -8, -8, 60]));
    let [g_inverse, eta_inverse] = [&g, &eta].map(|m| m.inverse().unwrap());
    [g, g_inverse, eta, eta_inverse]
}

fn space() -> [Exact; 4] {
    let g = twentieths(3, &[40, 10, 0, 10, 30, -5, 0, -5, 20]);
    let eta = twentieths(3, &[20, -8, 4, -8, 60, 0, 4, 0, 25]);
    let [g_inverse, eta_inverse] = [&g, &eta].map(|m| m.inverse().unwrap());
    [g, g_inverse, eta, eta_inverse]
}

pub(crate) use {moving, pinned};

/// `I/2 tr(eta^-1 Oh^T eta Oh) + A/2 tr Oh^2 + B/2 (tr Oh)^2 + m/2 g(x_dot, x_dot)`.
#[test]
fn spatially_affine() {
    #[affine_model(
        dim = 3,
        metrics(space = [[2, 0.5, 0], [0.5, 1.5, -0.25], [0, -0.25, 1]],
                body = [[1, -0.4, 0.2], [-0.4, 3, 0], [0.2, 0, 1.25]]),
        kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, space_translation = 2)
    )]
    struct Body;
    let [g, _, eta, eta_inverse] = space();
    let kinetic = Kinetic::new(
        3,
        vec![
            Term::BodyTensor(product(3, &eta, &eta_inverse)),
            Term::Casimir2(rational(1, 5)),
            Term::Casimir1Squared(rational(1, 10)),
            Term::SpaceTranslationMetric(g.scaled(&rational(2, 1))),
        ],
    )
    .unwrap();
    let (at, back) = moving!(Body, 3);
    agrees(&Body, &kinetic, at, back);
}

/// `I/2 tr(g^-1 Om^T g Om) + A/2 tr Om^2 + m/2 eta(phi^-1 x_dot, phi^-1 x_dot)`.
#[test]
fn materially_affine() {
    #[affine_model(
        dim = 2,
        metrics(space = [[2, 0.5], [0.5, 1.5]], body = [[1, -0.4], [-0.4, 3]]),
        kinetic(casimir2 = 0.2, space_inertia = 1, body_translation = 2)
    )]
    struct Body;
    let [g, g_inverse, eta, _] = plane();
    let kinetic = Kinetic::new(
        2,
        vec![
            Term::SpaceTensor(product(2, &g, &g_inverse)),
            Term::Casimir2(rational(1, 5)),
            Term::BodyTranslationMetric(eta.scaled(&rational(2, 1))),
        ],
    )
    .unwrap();
    let (at, back) = moving!(Body, 2);
    agrees(&Body, &kinetic, at, back);
}

/// `I/2 tr(eta^-1 phi_dot^T g phi_dot)`.
#[test]
fn dalembert() {
    #[affine_model(
        dim = 3,
        metrics(space = [[2, 0.5, 0], [0.5, 1.5, -0.25], [0, -0.25, 1]],
                body = [[1, -0.4, 0.2], [-0.4, 3, 0], [0.2, 0, 1.25]]),
        kinetic(dalembert = 3)
    )]
    struct Body;
    let [g, _, _, eta_inverse] = space();
    let tensor = product(3, &g, &eta_inverse).scaled(&rational(3, 1));
    let kinetic = Kinetic::new(3, vec![Term::FlatTensor(tensor)]).unwrap();
    let (at, back) = pinned!(Body, 3);
    agrees(&Body, &kinetic, at, back);
}

/// The closed form, the integrated motion and its drifts: metric spin, vorticity and norms are conserved.
#[test]
fn motions() {
    #[affine_model(
        dim = 2,
        metrics(space = [[2, 0.5], [0.5, 1.5]], body = [[1, -0.4], [-0.4, 3]]),
        kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1),
        potential = hyperbolic_dilatation(2) + neo_hookean(0.5)
    )]
    struct Vibrating;
    #[affine_model(
        dim = 2,
        metrics(space = [[2, 0.5], [0.5, 1.5]], body = [[1, -0.4], [-0.4, 3]]),
        kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1)
    )]
    struct Free;
    let phi = Matrix::<2>::new(1.1, 0.2, -0.1, 0.9);
    let spin = Comoving(Matrix::<2>::new(0.1, 0.4, -0.3, -0.2));
    let start = Vibrating.at_momentum(phi, spin).unwrap();
    let run = Simulation::new(&Vibrating, start).until(5.0).tolerance(1e-13).run().unwrap();
    let conservation = run.conservation();
    assert!(conservation.of(affine_runtime::model::Conserved::Vorticity).is_some());
    assert!(conservation.worst() < 1e-11, "{conservation}");
    // U = kappa/2 sinh(q)^2 + c (tr(eta^-1 phi^T g phi) exp(-2q) - n), q of the metrics' volumes.
    let (g, eta) = (Matrix::<2>::new(2.0, 0.5, 0.5, 1.5), Matrix::<2>::new(1.0, -0.4, -0.4, 3.0));
    let green = eta.try_inverse().unwrap() * phi.transpose() * g * phi;
    let q = 0.25 * green.determinant().ln();
    let potential = q.sinh().powi(2) + 0.5 * (green.trace() * (-2.0 * q).exp() - 2.0);
    let free = Free.at_momentum(phi, spin).unwrap();
    close("U", &[Vibrating.hamiltonian(0.0, &start) - Free.hamiltonian(0.0, &free)], &[potential], 1.0);

    let geodesic = Free.geodesic(0.0, &free).expect("a closed form");
    let later = Free.on_geodesic(&geodesic, 2.0, &free);
    let method = affine_runtime::Method::RungeKutta8;
    let run = Simulation::new(&Free, free).until(2.0).tolerance(1e-13).method(method).run().unwrap();
    let end = run.end().1;
    let error = (later.phi() - end.phi()).norm() + (later.sigma_hat().0.0 - end.sigma_hat().0.0).norm();
    assert!(error < 1e-11, "{error:e}");
}

/// Metrics that are the identity leave no trace, and square entries stay exact.
#[test]
fn identity_and_squares() {
    let expand = |args: &str| {
        affine_codegen::expand(args.parse().unwrap(), "pub struct Body;".parse().unwrap()).to_string()
    };
    let plain = "dim = 2, kinetic(casimir2 = 0.2, body_inertia = 1)";
    for metrics in ["space = diag(1, 1)", "body = [[1, 0], [0, 1]]", "space = 1, body = diag(1, 2/2)"] {
        assert_eq!(expand(plain), expand(&format!("{plain}, metrics({metrics})")));
    }
    let squares = expand(&format!("{plain}, metrics(space = diag(4, 9/4), body = 0.25)"));
    for factor in ["constant (2.0 , 0.0)", "constant (1.5 , 0.0)", "constant (0.5 , 0.0)"] {
        assert!(squares.contains(factor), "{factor}: {squares}");
    }
}
