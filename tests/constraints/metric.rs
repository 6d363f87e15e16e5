//! `emit(metric)` and `emit(acceleration)` of confined motions: the metric gives the kinetic energy of every velocity that is
//! left free, its inverse gives the velocity back from the momentum.

use affine_runtime::kinematics::Kinematics;
use affine_runtime::model::Velocity;
use affine_runtime::prelude::*;

/// Some hundred roundings.
const ALGEBRA: f64 = 1e-13;

/// A rotation, by Cayley's formula.
fn rotation<const N: usize>(w: &Matrix<N>) -> Matrix<N> {
    (Matrix::<N>::identity() - w).try_inverse().unwrap() * (Matrix::<N>::identity() + w)
}

fn skew<const N: usize>(seed: usize) -> Matrix<N> {
    let m = Matrix::<N>::from_fn(|i, j| ((5 * i + 3 * j + 7 * seed) % 11) as f64 * 0.1 - 0.4);
    m - m.transpose()
}

macro_rules! metrics {
    ($($name:ident $n:literal $group:ident ($($kinetic:tt)*) $phi:expr, $omega_hat:expr;)*) => { $(
        #[test]
        fn $name() {
            #[affine_model(dim = $n, constraint = $group, kinetic($($kinetic)*), emit(metric))]
            struct Body;
            for seed in 0..4 {
                let (phi, turn): (Matrix<$n>, Matrix<$n>) = ($phi(rotation(&skew(seed))), skew(seed + 5));
                let velocity = Velocity { x_dot: Vector::<$n>::zeros(), phi_dot: phi * $omega_hat(turn) };
                let start = Body.at_velocity(phi, velocity.phi_dot).unwrap();
                // Row by row, and Pi^T likewise.
                let rows = velocity.phi_dot.transpose();
                let (v, pi) = (rows.as_slice(), start.pi().0.0);
                let (metric, inverse) = (Body.metric(&phi), Body.inverse_metric(&phi));
                let times = |m: &Matrix<{ $n * $n }>, u: &[f64], i: usize| (0..u.len()).map(|j| m[(i, j)] * u[j]).sum::<f64>();
                let twice: f64 = (0..v.len()).map(|i| v[i] * times(&metric, v, i)).sum();
                let energy = Body.kinetic_energy(&phi, &velocity);
                assert!((twice - 2.0 * energy).abs() <= ALGEBRA * energy.abs(), "T {twice} {energy}");
                let size = v.iter().fold(1.0, |size: f64, entry| size.max(entry.abs()));
                for (i, entry) in v.iter().enumerate() {
                    let found = times(&inverse, pi.as_slice(), i);
                    assert!((found - entry).abs() <= ALGEBRA * size, "velocity {i}: {found} {entry}");
                }
            }
        }
    )* };
}

fn same<const N: usize>(m: Matrix<N>) -> Matrix<N> {
    m
}

fn stretched<const N: usize>(rotation: Matrix<N>) -> Matrix<N> {
    rotation * 1.3
}

fn sheared<const N: usize>(rotation: Matrix<N>) -> Matrix<N> {
    let mut shear = Matrix::<N>::identity();
    shear[(0, 1)] = 0.7;
    rotation * shear
}

fn growing<const N: usize>(turn: Matrix<N>) -> Matrix<N> {
    turn + Matrix::<N>::identity() * 0.3
}

fn shearing<const N: usize>(turn: Matrix<N>) -> Matrix<N> {
    let mut shear = turn;
    shear[(0, 0)] += 0.2;
    shear[(1, 1)] -= 0.2;
    shear
}

metrics! {
    rigid_body_2 2 rigid (body_inertia = diag(1, 2)) same, same;
    rigid_body_3 3 rigid (body_inertia = diag(1, 1.25, 0.75), casimir2 = 0.125) same, same;
    rigid_space_3 3 rigid (space_inertia = diag(1, 1.25, 0.75)) same, same;
    rigid_dalembert_3 3 rigid (dalembert = diag(1, 1.25, 0.75)) same, same;
    isochoric_body_3 3 isochoric (body_inertia = diag(1, 1.25, 0.75), casimir2 = 0.125) sheared, shearing;
    isochoric_dalembert_2 2 isochoric (dalembert = diag(1, 2)) sheared, shearing;
    isochoric_dalembert_3 3 isochoric (dalembert = diag(1, 1.25, 0.75)) sheared, shearing;
    isochoric_sum_2 2 isochoric (dalembert = diag(1, 2), body_inertia = diag(1, 3)) sheared, shearing;
    rigid_sum_3 3 rigid (body_inertia = diag(1, 1.25, 0.75), space_inertia = diag(2, 1, 0.5)) same, same;
    conformal_body_3 3 conformal (body_inertia = diag(1, 1.25, 0.75), casimir1_squared = 0.5) stretched, growing;
    conformal_dalembert_2 2 conformal (dalembert = [[1, 0.25], [0.25, 2]]) stretched, growing;
    conformal_sum_2 2 conformal (dalembert = diag(1, 2), body_inertia = diag(2, 1)) stretched, growing;
    conformal_dalembert_3 3 conformal (dalembert = diag(1, 1.25, 0.75)) stretched, growing;
}

/// On R+ SO(n) `dx/dt = D^2 p/m`, so that `d^2x/dt^2 = (2 q' D^2 p - D^2 x)/m` under `U = |x|^2/2`; the metric is that of both
/// masses.
#[test]
fn of_a_moving_conformal_body() {
    #[affine_model(
        dim = 2,
        constraint = conformal,
        kinetic(dalembert = j, body_translation = 1.5),
        potential = norm(x)^2/2 + gas(0.5),
        emit(metric, acceleration)
    )]
    struct Body {
        j: Matrix<2>,
    }
    let model = Body { j: Matrix::<2>::new(1.0, 0.25, 0.25, 2.0) }.prepare().unwrap();
    for seed in 0..4 {
        let phi = rotation(&skew::<2>(seed)) * 1.25;
        let (x, x_dot) = (Vector::<2>::new(0.3, seed as f64), Vector::<2>::new(-0.2, 0.5));
        let start = model.at_velocity(x, phi, x_dot, phi * growing(skew(seed + 5))).unwrap();
        let velocity = model.velocity(&start);
        let rate = start.omega(&velocity).0.0.trace() / 2.0;
        let expected = (start.p() * (2.0 * rate) - x) * (1.25 * 1.25 / 1.5);
        let found = model.acceleration(&start);
        assert!((found - expected).norm() <= ALGEBRA * expected.norm(), "{found} {expected}");
        let metric = model.metric(&phi);
        let rows = velocity.phi_dot.transpose();
        let v = joined(&x_dot, rows.as_slice());
        let twice: f64 = (0..6).map(|i| v[i] * (0..6).map(|j| metric[(i, j)] * v[j]).sum::<f64>()).sum();
        let energy = model.kinetic_energy(&phi, &velocity);
        assert!((twice - 2.0 * energy).abs() <= ALGEBRA * energy, "{twice} {energy}");
    }
}

/// A centre of mass whose weight the body carries in part: the metric of both masses, and the acceleration against differences
/// of the velocity along the motion.
#[test]
fn of_a_moving_isochoric_body() {
    #[affine_model(
        dim = 2,
        constraint = isochoric,
        kinetic(dalembert = diag(1, 2), body_translation = 1.5, space_translation = 0.5),
        potential = norm(x)^2/2 + tr(G),
        emit(metric, acceleration)
    )]
    struct Body;
    /// Its square, over all terms, is below the tolerance.
    const STEP: f64 = 1e-5;
    for seed in 0..4 {
        let phi = sheared(rotation(&skew::<2>(seed)));
        let (x, x_dot) = (Vector::<2>::new(0.3, seed as f64), Vector::<2>::new(-0.2, 0.5));
        let start = Body.at_velocity(x, phi, x_dot, phi * shearing(skew(seed + 5))).unwrap();
        let velocity = Body.velocity(&start);
        let rows = velocity.phi_dot.transpose();
        let v = joined(&x_dot, rows.as_slice());
        let metric = Body.metric(&phi);
        let twice: f64 = (0..6).map(|i| v[i] * (0..6).map(|j| metric[(i, j)] * v[j]).sum::<f64>()).sum();
        let energy = Body.kinetic_energy(&phi, &velocity);
        assert!((twice - 2.0 * energy).abs() <= ALGEBRA * energy, "{twice} {energy}");
        let momenta = joined(&start.p(), start.pi().0.0.as_slice());
        let inverse = Body.inverse_metric(&phi);
        for (i, entry) in v.iter().enumerate() {
            let found: f64 = (0..6).map(|j| inverse[(i, j)] * momenta[j]).sum();
            assert!((found - entry).abs() <= ALGEBRA * (1.0 + entry.abs()), "velocity {i}: {found} {entry}");
        }
        let full = Body.flatten(&start);
        let rates = Body.hamilton_equations(0.0, &full);
        let x_dot_at = |time: f64| {
            let moved: Vec<f64> = full.iter().zip(&rates).map(|(value, rate)| value + time * rate).collect();
            Body.velocity(&Body.unflatten(&moved.try_into().unwrap())).x_dot
        };
        let expected = (x_dot_at(STEP) - x_dot_at(-STEP)) / (2.0 * STEP);
        let found = Body.acceleration(&start);
        assert!((found - expected).norm() <= 1e-8 * expected.norm(), "{found} {expected}");
    }
}

fn joined(x_dot: &Vector<2>, rows: &[f64]) -> Vec<f64> {
    x_dot.iter().chain(rows).copied().collect()
}

/// The factors between momentum and velocity on what a constraint leaves free: `j_a + j_b` on skew velocities of
/// `1/2 tr(Oh J Oh^T)`, and for isotropic energies `I - A` on skew ones, `I + A` on symmetric ones, `I + A + n B` on the trace.
#[test]
fn condition_on_what_is_left_free() {
    #[affine_model(dim = 3, constraint = rigid, kinetic(dalembert = i, space_translation = 1))]
    struct Ball {
        i: f64,
    }
    #[affine_model(dim = 2, constraint = rigid, kinetic(dalembert = i))]
    struct Disc {
        i: f64,
    }
    #[affine_model(dim = 3, constraint = rigid, kinetic(body_inertia = diag(i, 2, 3)))]
    struct Top {
        i: f64,
    }
    #[affine_model(dim = 3, constraint = conformal, kinetic(space_inertia = i, casimir2 = 0.2, casimir1_squared = 0.5))]
    struct Swelling {
        i: f64,
    }
    #[affine_model(dim = 2, constraint = conformal, kinetic(body_inertia = i, casimir2 = 0.2))]
    struct Round {
        i: f64,
    }
    #[affine_model(dim = 3, constraint = isochoric, kinetic(body_inertia = i, casimir2 = 0.2))]
    struct Drop {
        i: f64,
    }

    macro_rules! found {
        ($model:ident { $i:literal }, $n:literal) => {
            $model { i: $i }.prepare().unwrap().condition(&Matrix::<$n>::identity()).unwrap()
        };
    }
    for (found, expected) in [
        (found!(Ball { 0.25 }, 3), 1.0),
        (found!(Disc { 0.25 }, 2), 1.0),
        (found!(Top { 0.25 }, 3), 5.0 / 2.25),
        (found!(Swelling { 1.0 }, 3), 2.7 / 0.8),
        (found!(Round { 1.0 }, 2), 1.2 / 0.8),
        (found!(Drop { 1.0 }, 3), 1.2 / 0.8),
    ] {
        assert!((found / expected - 1.0).abs() < 1e-14, "{found} {expected}");
    }
    let top = Top { i: 0.25 }.prepare().unwrap();
    let spin = Matrix::<3>::new(0.0, -1.0, 0.5, 1.0, 0.0, 0.2, -0.5, -0.2, 0.0);
    let run =
        Simulation::new(&top, top.at_velocity(Matrix::identity(), spin).unwrap()).until(0.1).run().unwrap();
    assert!(!run.why().to_string().contains("degenerate"), "{}", run.why());
}
