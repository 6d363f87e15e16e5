//! What is read off a phase point of a model with metrics, against the formulas with the metrics written out.

use affine_oracle::Random;
use affine_runtime::model::Conserved;
use affine_runtime::prelude::*;

use super::{close, rows};

/// As they stand in the attribute below.
fn metrics() -> [Matrix<3>; 2] {
    [
        Matrix::<3>::new(2.0, 0.5, 0.0, 0.5, 1.5, -0.25, 0.0, -0.25, 1.0),
        Matrix::<3>::new(1.0, -0.4, 0.2, -0.4, 3.0, 0.0, 0.2, 0.0, 1.25),
    ]
}

#[affine_model(
    dim = 3,
    metrics(space = [[2, 0.5, 0], [0.5, 1.5, -0.25], [0, -0.25, 1]],
            body = [[1, -0.4, 0.2], [-0.4, 3, 0], [0.2, 0, 1.25]]),
    kinetic(casimir2 = 0.2, body_inertia = 1, body_translation = 2),
    potential = det
)]
struct Missile;

#[affine_model(
    dim = 3,
    metrics(space = g, body = eta),
    kinetic(casimir2 = 0.2, body_inertia = 1, body_translation = 2),
    potential = det
)]
struct Given {
    g: Matrix<3>,
    eta: Matrix<3>,
}

fn inverse(matrix: &Matrix<3>) -> Matrix<3> {
    matrix.try_inverse().unwrap()
}

/// Deformation tensors and spins by their components in the bases of the model, invariants by traces of mixed tensors.
fn reads_with_its_metrics<M: Model<3>>(
    model: &M,
    at: impl Fn(Vector<3>, Matrix<3>, Vector<3>, Matrix<3>) -> M::Point<f64>,
) {
    let [g, eta] = metrics();
    for seed in 0..4 {
        let state = Random::new(7300 + seed).state(3);
        let [phi, pi] = [&state.phi, &state.pi].map(|m| Matrix::<3>::from_row_slice(&m.to_f64()));
        let [x, p] = [&state.x, &state.p].map(|v| Vector::<3>::from_column_slice(&v.to_f64()));
        let point = at(x, phi, p, pi);
        let there = model.orthonormal(&point);
        let agrees = |what: &str, found: Matrix<3>, expected: Matrix<3>| {
            close(what, &rows(&found), &rows(&expected), 1.0)
        };
        let to_body = inverse(&phi);
        let (green, cauchy) = (phi.transpose() * g * phi, to_body.transpose() * eta * to_body);
        agrees("G", model.components(there.green()), green);
        agrees("G^-1", model.components(there.green_inverse()), inverse(&green));
        agrees("C", model.components(there.cauchy()), cauchy);
        agrees("C^-1", model.components(there.cauchy_inverse()), inverse(&cauchy));
        agrees("E", model.components(there.lagrange_strain()), (green - eta) * 0.5);
        agrees("e", model.components(there.euler_strain()), (g - cauchy) * 0.5);

        let mixed = inverse(&eta) * green;
        let determinant = phi.determinant() * (g.determinant() / eta.determinant()).sqrt();
        let second = 0.5 * (mixed.trace() * mixed.trace() - (mixed * mixed).trace());
        close("I", &there.invariants(), &[mixed.trace(), second, determinant * determinant], 1.0);
        close("tr G^2", &[there.green().power_trace(2)], &[(mixed * mixed).trace()], 1.0);
        close("q", &[there.mean_log_stretch()], &[determinant.ln() / 3.0], 1.0);
        close(
            "U",
            &[model.hamiltonian(0.0, &point) - model.kinetic_energy(&phi, &model.velocity(&point))],
            &[determinant],
            10.0,
        );

        // S^i_j = Sigma^i_j - g^ik Sigma^l_k g_lj, and |S|^2 = -tr(S^2)/2.
        let skew =
            |matrix: Matrix<3>, metric: Matrix<3>| matrix - inverse(&metric) * matrix.transpose() * metric;
        let (spin, vorticity) = (skew(phi * pi, g), skew(pi * phi, eta));
        let angular_momentum = skew(x * p.transpose() + phi * pi, g);
        agrees("S_ij", model.components(there.spin()), g * spin);
        agrees("Vort^AB", model.components(there.vorticity()), vorticity * inverse(&eta));
        agrees("I - I^T", model.components(there.total_angular_momentum()), g * angular_momentum);
        close("|S|^2", &[there.spin().norm_squared()], &[-0.5 * (spin * spin).trace()], 1.0);
        close(
            "|Vort|^2",
            &[there.vorticity().norm_squared()],
            &[-0.5 * (vorticity * vorticity).trace()],
            1.0,
        );
    }
}

#[test]
fn numbers() {
    reads_with_its_metrics(&Missile, |x, phi, p, pi| Missile.at_momentum(x, phi, p, TwoPoint(pi)).unwrap());
}

#[test]
fn fields() {
    let [g, eta] = metrics();
    let model = Given { g, eta }.prepare().unwrap();
    reads_with_its_metrics(&model, |x, phi, p, pi| model.at_momentum(x, phi, p, TwoPoint(pi)).unwrap());
}

/// Without metrics the orthonormal point is the point, to the bit.
#[test]
fn identity_metrics() {
    #[affine_model(dim = 2, kinetic(casimir2 = 0.2, body_inertia = 1))]
    struct Body;
    let phi = Matrix::<2>::new(1.3, 0.2, 0.1, 0.8);
    let point = Body.at_momentum(phi, Comoving(Matrix::<2>::new(0.3, 0.5, -0.9, -0.3))).unwrap();
    assert_eq!(Body.orthonormal(&point), point);
    assert_eq!(Body.components(point.green()), phi.transpose() * phi);
}

/// What the model says it conserves, read off both ends of a run.
#[test]
fn what_is_listed_is_conserved() {
    #[affine_model(
        dim = 2,
        metrics(space = [[2, 0.5], [0.5, 1.5]], body = [[1, -0.4], [-0.4, 3]]),
        kinetic(casimir2 = 0.2, body_inertia = 1),
        potential = 0.3*(tr(G)*exp(-2*q) - 2) + q^2
    )]
    struct Body;
    let start = Body
        .at_momentum(Matrix::<2>::new(1.3, 0.2, 0.1, 0.8), Comoving(Matrix::<2>::new(0.3, 0.5, -0.9, -0.3)))
        .unwrap();
    let run = Simulation::new(&Body, start).until(2.0).tolerance(1e-12).run().unwrap();
    let listed = run.description().conserved;
    assert!(listed.contains(&Conserved::Vorticity) && listed.contains(&Conserved::Spin), "{listed:?}");
    for quantity in listed.iter().filter(|quantity| **quantity != Conserved::Energy) {
        let value = |point| quantity.of(point, Body.bases().as_ref()).unwrap();
        let (begin, end) = (value(run.start().1), value(run.end().1));
        let distance = begin.distance(&end);
        assert!(distance < 1e-10 * (1.0 + begin.norm()), "{quantity:?} {distance:e}");
    }
}

mod stretched {
    use affine_runtime::prelude::*;
    #[affine_model(dim = 2, metrics(space = diag(4, 1), body = diag(1, 0.25)), kinetic(casimir2 = 0.2, body_inertia = 1),
        potential = tr(G))]
    pub(super) struct Body;
}

mod plain {
    use affine_runtime::prelude::*;
    #[affine_model(dim = 2, kinetic(casimir2 = 0.2, body_inertia = 1), potential = tr(G))]
    pub(super) struct Body;
}

/// The same body in other bases has the same picture: entries of the change of bases are powers of two.
#[test]
fn pictures_show_the_body_in_orthonormal_bases() {
    let (given, there) = (Matrix::<2>::new(0.65, 0.2, 0.1, 0.8), Matrix::<2>::new(1.3, 0.8, 0.1, 1.6));
    let spin = Matrix::<2>::new(0.3, 0.5, -0.9, -0.3);
    // Sigma_hat' = B Sigma_hat B^-1 with B = diag(1, 1/2).
    let carried = Matrix::<2>::new(0.3, 1.0, -0.45, -0.3);
    let with_metrics = stretched::Body.at_momentum(given, Comoving(spin)).unwrap();
    let without = plain::Body.at_momentum(there, Comoving(carried)).unwrap();
    let first = Simulation::new(&stretched::Body, with_metrics).until(1.0).every(0.1).run().unwrap();
    let second = Simulation::new(&plain::Body, without).until(1.0).every(0.1).run().unwrap();
    assert_eq!(stretched::Body.orthonormal(first.end().1).phi(), second.end().1.phi());
    assert!(first.to_svg() == second.to_svg());
}

/// Levels of the stretches and of the determinant are found where `eta^-1 phi^T g phi` has them, in steps and in closed form.
#[test]
fn events_ask_for_the_metrics_of_the_model() {
    #[affine_model(
        dim = 2,
        metrics(space = [[4, 0.5], [0.5, 1]], body = [[1, -0.4], [-0.4, 3]]),
        kinetic(casimir2 = 0.2, body_inertia = 1)
    )]
    struct Body;
    let g = Matrix::<2>::new(4.0, 0.5, 0.5, 1.0);
    let eta = Matrix::<2>::new(1.0, -0.4, -0.4, 3.0);
    /// The squares of the largest and the smallest stretch, and of the determinant.
    fn squares(eta: &Matrix<2>, g: &Matrix<2>, phi: &Matrix<2>) -> [f64; 3] {
        let mixed = eta.try_inverse().unwrap() * phi.transpose() * g * phi;
        let (half, det) = (0.5 * mixed.trace(), mixed.determinant());
        let root = (half * half - det).sqrt();
        [half + root, half - root, det]
    }
    let start = Body
        .at_momentum(Matrix::<2>::new(1.3, 0.2, 0.1, 0.8), Comoving(Matrix::<2>::new(0.3, 0.5, -0.9, -0.5)))
        .unwrap();
    for method in [Method::Automatic, Method::RungeKutta8, Method::Gauss { stages: 3, step: 1e-2 }] {
        let simulation = || Simulation::new(&Body, start).until(0.4).method(method).tolerance(1e-12);
        let ends = simulation().run().unwrap();
        let [before, after] = [&start, ends.end().1].map(|point| squares(&eta, &g, point.phi()));
        let levels: Vec<f64> = before.iter().zip(&after).map(|(a, b)| (0.5 * (a + b)).sqrt()).collect();
        let events = [
            Event::largest_stretch(levels[0]),
            Event::smallest_stretch(levels[1]),
            Event::determinant(levels[2]),
        ];
        for (k, event) in events.into_iter().enumerate() {
            let stopped = simulation().event(event.stop()).run().unwrap();
            assert!(stopped.stopped_by().is_some(), "{method:?}: {:?} to {:?}", before, after);
            let there = squares(&eta, &g, stopped.end().1.phi())[k].sqrt();
            assert!((there - levels[k]).abs() < 1e-11 * levels[k], "{method:?}: {there} {}", levels[k]);
        }
    }
}
