//! What is conserved stands in the bases that the user states the model in: in the list, in tables, and as generators.

use affine_runtime::analysis::{AnalysisError, Condition, Generator, relative_equilibrium};
use affine_runtime::model::Conserved;
use affine_runtime::prelude::*;

/// The sums of entries that a model lists.
fn components(listed: &[Conserved]) -> Vec<&str> {
    let components = listed.iter().filter(|quantity| matches!(quantity, Conserved::Component(_)));
    components.map(|quantity| quantity.symbol()).collect()
}

/// `dp/dt = -dU/dx` in every basis: `p_2` stays where `U` reads `x[1]`, whatever the metric and the roots of its pivots.
#[test]
fn components_of_the_linear_momentum() {
    macro_rules! pushed {
        ($($space:tt)*) => {{
            #[affine_model(
                dim = 2,
                metrics(space = $($space)*),
                kinetic(dalembert = 1, space_translation = 1),
                potential = tr(G) - q + x[1]
            )]
            struct Body;
            assert_eq!(components(Body::DESCRIPTION.conserved), ["p_2"]);
            let (x, v) = (Vector::<2>::new(0.3, -0.2), Vector::<2>::new(0.1, 0.2));
            let phi = Matrix::<2>::new(1.1, 0.2, -0.1, 0.9);
            let start = Body.at_velocity(x, phi, v, Matrix::<2>::new(0.1, 0.4, -0.3, -0.2)).unwrap();
            let run = Simulation::new(&Body, start).until(2.0).every(1.0).tolerance(1e-12).run().unwrap();
            assert!(run.conservation().worst() < 1e-11, "{}", run.conservation());
            let (table, points) = (run.table(), run.iter().map(|(_, point)| point));
            assert!((table.column("p1").unwrap()[2] - start.p()[0] + 2.0).abs() < 1e-9, "a force of -1");
            let listed = points.map(|point| point.p()[1]).zip(table.column("p_2").unwrap());
            listed.for_each(|(own, listed)| assert!((own - listed).abs() < 1e-14 && (own - start.p()[1]).abs() < 1e-11));
        }};
    }
    pushed!([[2, 0.3], [0.3, 1]]);
    pushed!([[4, 2], [2, 2]]);
    pushed!([[1, 0.3], [0.3, 1]]);
}

/// Where the metric is a field, what stays for every metric is listed.
#[test]
fn metrics_that_are_fields() {
    #[affine_model(
        dim = 2,
        metrics(space = g),
        kinetic(dalembert = 1, space_translation = 1),
        potential = tr(G) - q + x[1]
    )]
    struct Read {
        g: Matrix<2>,
    }
    assert_eq!(components(PreparedRead::DESCRIPTION.conserved), ["p_2"]);
    let read = Read { g: Matrix::<2>::new(2.0, 0.3, 0.3, 1.0) }.prepare().unwrap();
    let (x, v) = (Vector::<2>::new(0.3, -0.2), Vector::<2>::new(0.1, 0.2));
    let start = read.at_velocity(x, Matrix::<2>::identity(), v, Matrix::<2>::zeros()).unwrap();
    let run = Simulation::new(&read, start).until(2.0).run().unwrap();
    assert!((run.end().1.p()[1] - start.p()[1]).abs() < 1e-9);

    #[affine_model(
        dim = 3,
        metrics(space = g, body = eta),
        kinetic(dalembert = 1, space_translation = 1),
        potential = tr(G) - q
    )]
    struct Free {
        g: Matrix<3>,
        eta: Matrix<3>,
    }
    assert!(components(PreparedFree::DESCRIPTION.conserved).is_empty(), "whole momenta are conserved");
}

/// `S_ij = g_ik S^k_j`, `x_i = g_ij x^j`, `Vort^AB = Vort^A_C eta^CB`: a plane of rotations that leave the third coordinate of
/// space or of the body alone is that of the first two, whatever the metric.
#[test]
fn entries_of_angular_momenta_and_vorticity() {
    #[affine_model(
        dim = 3,
        metrics(space = [[2, 0.3, 0.1], [0.3, 1, 0.2], [0.1, 0.2, 3]], body = [[1, 0.2, 0], [0.2, 3, 0.1], [0, 0.1, 2]]),
        kinetic(dalembert = 1, space_translation = 1),
        potential = tr(G)^2/8 - q + x[3]^2 + phi[3, 3]^2
    )]
    struct Body;
    let listed = components(Body::DESCRIPTION.conserved);
    assert_eq!(listed, ["p_1", "p_2", "S_12", "x_1*p_2 - x_2*p_1", "Vort_12"]);
    let g = Matrix::<3>::new(2.0, 0.3, 0.1, 0.3, 1.0, 0.2, 0.1, 0.2, 3.0);
    let eta = Matrix::<3>::new(1.0, 0.2, 0.0, 0.2, 3.0, 0.1, 0.0, 0.1, 2.0);
    let (x, v) = (Vector::<3>::new(0.3, -0.2, 0.1), Vector::<3>::new(0.1, 0.2, -0.3));
    let phi = Matrix::<3>::new(1.1, 0.2, 0.0, -0.1, 0.9, 0.1, 0.0, 0.2, 1.2);
    let phi_dot = Matrix::<3>::new(0.1, 0.4, -0.3, -0.2, -0.15, 0.25, 0.35, -0.1, 0.05);
    let start = Body.at_velocity(x, phi, v, phi_dot).unwrap();
    let run = Simulation::new(&Body, start).until(1.0).every(0.5).tolerance(1e-12).run().unwrap();
    assert!(run.conservation().worst() < 1e-10, "{}", run.conservation());
    let across = |m: Matrix<3>| m[(0, 1)] - m[(1, 0)];
    let table = run.table();
    for (row, (_, point)) in run.iter().enumerate() {
        let (raised, lowered) = (eta.try_inverse().unwrap(), g * point.sigma().0.0);
        let expected = [
            ("S_12", across(lowered)),
            ("x_1*p_2___x_2*p_1", across(g * point.x() * point.p().transpose())),
            ("Vort_12", across(point.sigma_hat().0.0 * raised)),
        ];
        for (name, value) in expected {
            let column = table.column(name).unwrap();
            assert!((column[row] - value).abs() < 1e-12, "{name}: {} {value}", column[row]);
            assert!((column[row] - column[0]).abs() < 1e-10, "{name}");
        }
        let moved = point.sigma().0.0[(0, 1)] - start.sigma().0.0[(0, 1)];
        assert!(moved.abs() > 1e-3 || row == 0, "{moved}");
    }
}

/// Columns of whole momenta have the entries that the point has, and the drift is the norm by the metrics.
#[test]
fn columns_of_whole_momenta() {
    #[affine_model(
        dim = 2,
        metrics(space = [[2, 0.3], [0.3, 1]], body = [[1, 0.2], [0.2, 3]]),
        kinetic(body_inertia = 1, casimir2 = 0.2, body_translation = 1)
    )]
    struct Body;
    let (x, v) = (Vector::<2>::new(0.3, -0.2), Vector::<2>::new(0.1, 0.2));
    let phi = Matrix::<2>::new(1.1, 0.2, -0.1, 0.9);
    let start = Body.at_velocity(x, phi, v, Matrix::<2>::new(0.1, 0.4, -0.3, -0.2)).unwrap();
    let run = Simulation::new(&Body, start).until(1.0).every(1.0).run().unwrap();
    let table = run.table();
    let (total, eta) = (start.total_affine_momentum().0.0, Matrix::<2>::new(1.0, 0.2, 0.2, 3.0));
    let raised = start.sigma_hat().0.0 * eta.try_inverse().unwrap();
    let expected = [
        ("linear_momentum1", start.p()[0]),
        ("linear_momentum2", start.p()[1]),
        ("total_affine_momentum12", total[(0, 1)]),
        ("total_affine_momentum21", total[(1, 0)]),
        ("vorticity12", raised[(0, 1)] - raised[(1, 0)]),
    ];
    for (name, value) in expected {
        let column = table.column(name).unwrap();
        assert!((column[0] - value).abs() < 1e-14, "{name}: {} {value}", column[0]);
    }
    assert!(table.column("drift_linear_momentum").unwrap()[1] < 1e-9);
}

/// The generator of a listed component is one of the symmetries that analysis knows.
#[test]
fn components_are_symmetries_of_the_analysis() {
    #[affine_model(
        dim = 2,
        metrics(space = [[2, 0.3], [0.3, 1]]),
        kinetic(dalembert = 1, space_translation = 1),
        potential = tr(G) - 2*q + x[1]^2
    )]
    struct Body;
    // The second axis of the user in orthonormal bases, where translations along both axes change `U`.
    let drift = Body.bases().unwrap().space.column(1).into_owned();
    let along = Generator { drift, ..Generator::zero() };
    let (zero, phi) = (Vector::<2>::zeros(), Matrix::<2>::identity());
    let guess = Body.at_velocity(zero, phi, Vector::<2>::new(0.0, 0.1), Matrix::<2>::zeros()).unwrap();
    let moving = relative_equilibrium(&Body, &guess, &[along], &[Condition::Velocity(0, 0.1)]).unwrap();
    assert!(moving.point.x()[0].abs() < 1e-12);
    let x_dot = Body.velocity(&moving.point).x_dot;
    assert!((x_dot - Vector::<2>::new(0.0, 0.1)).norm() < 1e-12, "{x_dot}");
}

/// Of the planes of space and body, in orthonormal bases, those are symmetries whose entries are listed.
#[test]
fn turns_are_symmetries_of_the_analysis() {
    #[affine_model(
        dim = 3,
        metrics(space = [[2, 0.3, 0.1], [0.3, 1, 0.2], [0.1, 0.2, 3]], body = [[1, 0.2, 0], [0.2, 3, 0.1], [0, 0.1, 2]]),
        kinetic(dalembert = 1),
        potential = tr(G)^2/8 - q + phi[3, 3]^2
    )]
    struct Body;
    assert_eq!(components(Body::DESCRIPTION.conserved), ["S_12", "Vort_12"]);
    let bases = Body.bases().unwrap();
    let plane = |i: usize, j: usize| {
        let mut plane = Matrix::<3>::zeros();
        (plane[(j, i)], plane[(i, j)]) = (1.0, -1.0);
        plane
    };
    // `tr(Sigma' A W A^T)` is the pairing of `W` with `A^T Sigma' A`, whose indices are lowered, and so for the body.
    let turn =
        |i, j| Generator { space: bases.space * plane(i, j) * bases.space.transpose(), ..Generator::zero() };
    let of_body = |i, j| {
        let body = bases.body_inverse.transpose() * plane(i, j) * bases.body_inverse;
        Generator { body, ..Generator::zero() }
    };
    let guess = Body.at_velocity(Matrix::<3>::identity(), Matrix::<3>::zeros()).unwrap();
    let is_one = |generator| {
        let found = relative_equilibrium(&Body, &guess, &[generator], &[Condition::Velocity(0, 0.0)]);
        !matches!(found, Err(AnalysisError::NotASymmetry { .. }))
    };
    assert!(is_one(turn(0, 1)) && is_one(of_body(0, 1)));
    assert!(![turn(0, 2), turn(1, 2), of_body(0, 2), of_body(1, 2)].into_iter().any(is_one));
}
