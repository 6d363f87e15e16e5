//! Inertias of shapes against integrals over them, and moments and velocities of bodies against sums over their particles.
#![allow(missing_docs, clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::f64::consts::TAU;

use affine_runtime::inertia::{InertiaTensor, MassDistribution};
use affine_runtime::kinematics::InertialQuadrupole;
use affine_runtime::material::Material;
use affine_runtime::prelude::*;

/// Gauss-Legendre points and weights on (-1, 1), three of them: exact for polynomials of degree 5. The moments below have
/// degree 4 at most.
const GAUSS: [(f64, f64); 3] =
    [(-0.774_596_669_241_483_4, 5.0 / 9.0), (0.0, 8.0 / 9.0), (0.774_596_669_241_483_4, 5.0 / 9.0)];
/// Equal angles of a turn: exact for products of up to seven sines and cosines.
const ANGLES: usize = 8;
/// Rounding of some hundred terms.
const ROUNDING: f64 = 1e-14;

fn turn() -> impl Iterator<Item = (f64, f64, f64)> {
    (0..ANGLES).map(|k| (TAU * k as f64 / ANGLES as f64).sin_cos()).map(|(s, c)| (c, s, TAU / ANGLES as f64))
}

/// Radii of the unit ball with their weights, `dr`.
fn radii() -> impl Iterator<Item = (f64, f64)> {
    GAUSS.iter().map(|(u, w)| ((1.0 + u) / 2.0, w / 2.0))
}

/// A shape as nodes with volumes, scaled to a mass: what integrates `1` and `a a^T` exactly.
fn with_mass<const N: usize>(mass: f64, nodes: Vec<(f64, Vector<N>)>) -> MassDistribution<N> {
    let volume: f64 = nodes.iter().map(|(w, _)| w).sum();
    let nodes: Vec<_> = nodes.into_iter().map(|(w, a)| (w * mass / volume, a)).collect();
    let direct = nodes.iter().fold(Matrix::<N>::zeros(), |sum, (m, a)| sum + a * a.transpose() * *m);
    let found = MassDistribution::particles(&nodes);
    assert!(found.centre.norm() < ROUNDING && (found.quadrupole - direct).norm() < ROUNDING * direct.norm());
    found
}

fn assert_same<const N: usize>(found: Matrix<N>, expected: Matrix<N>) {
    assert!((found - expected).norm() <= ROUNDING * expected.norm(), "{found} {expected}");
}

#[test]
fn blocks_and_ellipsoids_of_the_plane_are_what_integrals_give() {
    let (mass, [a, b]) = (1.7, [0.6, 2.3]);
    let line =
        |w: f64, u: f64| GAUSS.map(|(v, weight)| (w * weight, Vector::<2>::new(a / 2.0 * u, b / 2.0 * v)));
    let rectangle = GAUSS.iter().flat_map(|(u, w)| line(*w, *u)).collect();
    assert_same(MassDistribution::block(mass, [a, b]).quadrupole, with_mass(mass, rectangle).quadrupole);

    let ellipse = radii().flat_map(|(r, w)| {
        turn().map(move |(c, s, angle)| (w * r * angle, Vector::<2>::new(a * r * c, b * r * s)))
    });
    assert_same(
        MassDistribution::ellipsoid(mass, [a, b]).quadrupole,
        with_mass(mass, ellipse.collect()).quadrupole,
    );
}

#[test]
fn bodies_of_space_are_what_integrals_give() {
    let (mass, [a, b, c]) = (0.8, [0.6, 2.3, 1.1]);
    let mut cells = Vec::new();
    let (mut ball, mut round) = (Vec::new(), Vec::new());
    for (u, wu) in GAUSS {
        for (v, wv) in GAUSS {
            cells.extend(GAUSS.map(|(z, wz)| (wu * wv * wz, Vector::<3>::new(a * u, b * v, c * z) / 2.0)));
        }
        for (r, wr) in radii() {
            for (cos, sin, angle) in turn() {
                // Spheres by the cosine u of the polar angle; discs by the height u.
                let across = r * (1.0 - u * u).sqrt();
                ball.push((
                    wr * r * r * wu * angle,
                    Vector::<3>::new(a * across * cos, b * across * sin, c * r * u),
                ));
                round.push((wr * r * wu * angle, Vector::<3>::new(a * r * cos, a * r * sin, c / 2.0 * u)));
            }
        }
    }
    assert_same(MassDistribution::block(mass, [a, b, c]).quadrupole, with_mass(mass, cells).quadrupole);
    assert_same(MassDistribution::ellipsoid(mass, [a, b, c]).quadrupole, with_mass(mass, ball).quadrupole);
    assert_same(MassDistribution::cylinder(mass, a, c).quadrupole, with_mass(mass, round).quadrupole);
}

/// Points in no plane, with masses, off the origin.
fn cloud() -> Vec<(f64, Vector<3>)> {
    (0..9_u32)
        .map(|k| {
            let wave = |f: f64| (f64::from(k + 1) * f).sin();
            (1.0 + 0.5 * wave(2.3), Vector::<3>::new(0.4 + wave(1.1), wave(1.7) - 0.2, wave(2.9)))
        })
        .collect()
}

/// `I = sum m (|a|^2 1 - a a^T)` (Goldstein, *Classical Mechanics*, section 5.3), summed as it stands there.
#[test]
fn the_tensor_of_rotations_leads_to_the_quadrupole() {
    let MassDistribution { mass, centre, quadrupole } = MassDistribution::particles(&cloud());
    let rotational = cloud().iter().fold(Matrix::<3>::zeros(), |sum, (m, a)| {
        let a = a - centre;
        sum + (Matrix::<3>::identity() * a.norm_squared() - a * a.transpose()) * *m
    });
    assert_same(MassDistribution::from_rotational(mass, &rotational).quadrupole, quadrupole);
    // A ball: 2/5 m r^2.
    let ball = Matrix::<3>::from_diagonal_element(0.4 * 1.5 * 0.7 * 0.7);
    let [table, shape] =
        [MassDistribution::from_rotational(1.5, &ball), MassDistribution::ellipsoid(1.5, [0.7; 3])];
    assert_same(table.quadrupole, shape.quadrupole);
}

#[affine_model(dim = 3, kinetic(dalembert = j, space_translation = m))]
struct Cloud {
    j: Matrix<3>,
    m: f64,
}

/// Kinetic energy and moments of the model are sums over particles that move with it, and the fields of velocities are those
/// of the particles.
#[test]
fn energy_moments_and_velocities_are_those_of_the_particles() {
    let MassDistribution { mass, centre, quadrupole } = MassDistribution::particles(&cloud());
    let model = Cloud { j: quadrupole, m: mass }.prepare().unwrap();
    let phi = Matrix::<3>::new(1.1, 0.2, -0.1, 0.05, 0.9, 0.15, -0.2, 0.1, 1.05);
    let phi_dot = Matrix::<3>::new(0.3, -0.5, 0.1, 0.7, 0.2, -0.4, 0.6, 0.1, -0.2);
    let (x, x_dot) = (Vector::<3>::new(0.3, -1.2, 0.7), Vector::<3>::new(-0.4, 0.8, 0.5));
    let point = model.at_velocity(x, phi, x_dot, phi_dot).unwrap();
    let velocity = model.velocity(&point);
    let o = Vector::<3>::new(2.0, -0.6, 1.3);

    // Places and their velocities, by differences in time along phi + t phi_dot, x + t x_dot.
    let place = |t: f64, a: &Vector<3>| x + x_dot * t + (phi + phi_dot * t) * (a - centre);
    let (mut energy, mut dipole) = (0.0, Matrix::<3>::zeros());
    for (m, a) in cloud() {
        let (y, v) = (place(0.0, &a), (place(0.5, &a) - place(-0.5, &a)));
        let label = a - centre;
        assert!((point.place(&label) - y).norm() < ROUNDING);
        assert!((point.point_at(&y) - label).norm() < ROUNDING);
        assert!((point.velocity_of(&velocity, &label) - v).norm() < ROUNDING);
        assert!((point.velocity_at(&velocity, &y) - v).norm() < ROUNDING);
        let seen = point.comoving_velocity_of(&velocity, &label).0.0;
        assert!((phi * seen - v).norm() < ROUNDING);
        let by_body = point.v_hat(&velocity).0.0 + point.omega_hat(&velocity).0.0 * label;
        assert!((seen - by_body).norm() < ROUNDING);
        energy += m / 2.0 * v.norm_squared();
        dipole += (y - o) * v.transpose() * m;
    }
    assert!((model.hamiltonian(0.0, &point) - energy).abs() < ROUNDING * energy);
    let body = (mass, Comoving(InertialQuadrupole(quadrupole)));
    assert_same(point.kinematical_dipole_about(&o, &velocity, body), dipole);
    // Momenta of d'Alembert's model are those of its particles.
    assert_same(point.affine_momentum_about(&o).0.0, dipole);
    let angular = point.affine_momentum_about(&o).angular_momentum().0.0;
    assert_same(angular, dipole - dipole.transpose());
    let origin = point.affine_momentum_about(&Vector::<3>::zeros());
    assert_same(origin.0.0, point.total_affine_momentum().0.0);
}

/// A symmetric tensor without a pattern, `K[(A,B)][(C,D)]` as a matrix of pairs.
fn pairs() -> [[f64; 9]; 9] {
    let entry =
        |a: usize, b: usize| ((a * b + 3 * (a + b)) as f64).sin() * 0.1 + if a == b { 2.0 } else { 0.0 };
    core::array::from_fn(|a| core::array::from_fn(|b| entry(a, b)))
}

/// `1/2 K[nA+B][nC+D] Oh[A][B] Oh[C][D]`, affine in space.
#[affine_model(dim = 3, kinetic(body_tensor = k))]
struct Left {
    k: [[f64; 9]; 9],
}

/// The same over `Om`, affine in the body.
#[affine_model(dim = 3, kinetic(space_tensor = k))]
struct Right {
    k: [[f64; 9]; 9],
}

/// (4.6), (4.12) of an energy that is affine in space, (4.8), (4.13) of one that is affine in the body: what was stated, what
/// `phi` carries to the other side, and the spins that both give.
#[test]
fn tensors_of_kinetic_energies() {
    let k = pairs();
    let phi = Matrix::<3>::new(1.1, 0.2, -0.1, 0.05, 0.9, 0.15, -0.2, 0.1, 1.05);
    let rate = Matrix::<3>::new(0.1, 0.4, -0.3, -0.2, -0.15, 0.25, 0.35, -0.1, 0.05);
    let inverse = phi.try_inverse().unwrap();
    // Sigma^A_B = dT/dO^B_A.
    let stated = |a: usize, b: usize, c: usize, d: usize| k[3 * b + a][3 * d + c];
    let all = || (0..81).map(|m| [m / 27, m / 9 % 3, m / 3 % 3, m % 3]);
    let spin = |tensor: &[[[[f64; 3]; 3]; 3]; 3], velocity: &Matrix<3>| {
        Matrix::<3>::from_fn(|i, j| {
            (0..9).map(|m| tensor[i][j][m / 3][m % 3] * velocity[(m % 3, m / 3)]).sum::<f64>()
        })
    };
    let close = |found: f64, known: f64| assert!((found - known).abs() < 1e-13, "{found} {known}");
    let left = Left { k }.prepare().unwrap();
    let (body, space) = (InertiaTensor::comoving(&left, &phi).0.0, InertiaTensor::spatial(&left, &phi).0.0);
    let start = left.at_velocity(phi, rate).unwrap();
    for [a, b, c, d] in all() {
        close(body[a][b][c][d], stated(a, b, c, d));
        let carried = all().map(|[e, f, g, h]| {
            phi[(a, e)] * inverse[(f, b)] * phi[(c, g)] * inverse[(h, d)] * stated(e, f, g, h)
        });
        close(space[a][b][c][d], carried.sum());
    }
    assert_same(spin(&body, &(inverse * rate)), start.sigma_hat().0.0);
    assert_same(spin(&space, &(rate * inverse)), start.sigma().0.0);

    let right = Right { k }.prepare().unwrap();
    let (body, space) = (InertiaTensor::comoving(&right, &phi).0.0, InertiaTensor::spatial(&right, &phi).0.0);
    let start = right.at_velocity(phi, rate).unwrap();
    for [i, j, k, l] in all() {
        close(space[i][j][k][l], stated(i, j, k, l));
        let carried = all().map(|[e, f, g, h]| {
            inverse[(i, e)] * phi[(f, j)] * inverse[(k, g)] * phi[(h, l)] * stated(e, f, g, h)
        });
        close(body[i][j][k][l], carried.sum());
    }
    assert_same(spin(&body, &(inverse * rate)), start.sigma_hat().0.0);
    assert_same(spin(&space, &(rate * inverse)), start.sigma().0.0);
}

/// `dG/dt` and `dC/dt` against differences along `phi + t phi_dot`.
#[test]
fn rates_of_the_deformation_tensors() {
    #[affine_model(dim = 3, kinetic(dalembert = 1))]
    struct Free;
    let phi = Matrix::<3>::new(1.1, 0.2, -0.1, 0.05, 0.9, 0.15, -0.2, 0.1, 1.05);
    let rate = Matrix::<3>::new(0.1, 0.4, -0.3, -0.2, -0.15, 0.25, 0.35, -0.1, 0.05);
    let at = |t: f64| Free.at_velocity(phi + rate * t, rate).unwrap();
    let (start, h) = (at(0.0), 1e-5);
    let velocity = Free.velocity(&start);
    let green = (at(h).green().0.0 - at(-h).green().0.0) / (2.0 * h);
    let cauchy = (at(h).cauchy().0.0 - at(-h).cauchy().0.0) / (2.0 * h);
    assert!((start.green_rate(&velocity).0 - green).norm() < 1e-9);
    assert!((start.cauchy_rate(&velocity).0 - cauchy).norm() < 1e-8);
}
