//! `self_gravity(k)`: its energy and forces against integrals of another implementation, where stretches coincide too, in every
//! number, and what follows from them for the ellipsoids of Maclaurin.

use affine_runtime::dual::Dual;
use affine_runtime::elliptic::carlson_rf;
use affine_runtime::frames::Matrix;
use affine_runtime::prelude::*;
use affine_runtime::scalar::Scalar;
use affine_runtime::variation::Variation;
use ellip::{elliprd, elliprf};

/// A cloud that nothing but its gravity holds.
#[affine_model(dim = 3, kinetic(dalembert = 0.2), potential = self_gravity(k), emit(tangent))]
struct Cloud {
    k: f64,
}

/// A star in units `G = m = r = 1`.
#[affine_model(dim = 3, constraint = isochoric, kinetic(dalembert = 0.2), potential = self_gravity(1))]
struct Star;

/// A rotation about an axis without a name.
fn turn(angle: f64) -> Matrix<3> {
    let (s, c) = angle.sin_cos();
    let about = |k: usize| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        let mut turn = Matrix::<3>::identity();
        (turn[(i, i)], turn[(j, j)], turn[(i, j)], turn[(j, i)]) = (c, c, -s, s);
        turn
    };
    about(0) * about(1) * about(2)
}

/// `U` of stretches, and `dU/dQ_a = (1/5) k Q_a R_D(Q_b^2, Q_c^2, Q_a^2)` (NIST DLMF 19.18.1).
fn expected(k: f64, stretches: [f64; 3]) -> (f64, [f64; 3]) {
    let [x, y, z] = stretches.map(|stretch| stretch * stretch);
    let slope = |a: usize, [x, y, z]: [f64; 3]| k / 5.0 * stretches[a] * elliprd(x, y, z).unwrap();
    let slopes = [slope(0, [y, z, x]), slope(1, [z, x, y]), slope(2, [x, y, z])];
    (-0.6 * k * elliprf(x, y, z).unwrap(), slopes)
}

/// `dU/dphi` of the cloud at rest, from `dPi/dt = -(dU/dphi)^T`.
fn slopes<T: Scalar>(k: f64, phi: &Matrix<3, T>) -> Matrix<3, T> {
    let mut state = [T::zero(); 18];
    state[..9].copy_from_slice(phi.transpose().as_slice());
    let rates = Cloud { k }.prepare().unwrap().hamilton_equations(T::zero(), &state);
    Matrix::<3, T>::from_fn(|i, a| -rates[9 + 3 * a + i])
}

fn energy(k: f64, phi: Matrix<3>) -> f64 {
    let cloud = Cloud { k }.prepare().unwrap();
    cloud.hamiltonian(0.0, &cloud.at_velocity(phi, Matrix::<3>::zeros()).unwrap())
}

/// Balls, spheroids, ellipsoids, needles and pancakes.
const STRETCHES: [[f64; 3]; 7] = [
    [1.0, 1.0, 1.0],
    [2.0, 0.5, 0.5],
    [1.3, 1.3, 0.4],
    [1.2, 1.0, 0.8],
    [1.0, 1.0 + 1e-9, 1.0 - 1e-9],
    [1e4, 1e-3, 1e-2],
    [30.0, 20.0, 1e-4],
];

#[test]
fn energy_and_forces_are_those_of_the_integrals() {
    for stretches in STRETCHES {
        let (left, right) = (turn(0.7), turn(-0.4));
        let (known, along) = expected(2.5, stretches);
        // Rotations round the smallest stretch off by what the largest has: there the axes are left where they are.
        let near = stretches.iter().fold(0.0, |most: f64, q| most.max(*q)) < 10.0;
        let (left, right) = if near { (left, right) } else { (Matrix::identity(), Matrix::identity()) };
        let phi = left * Matrix::<3>::from_diagonal(&stretches.into()) * right.transpose();
        let found = energy(2.5, phi);
        assert!((found / known - 1.0).abs() < 2e-15, "{stretches:?}: {found} {known}");
        let pulled = left.transpose() * slopes(2.5, &phi) * right;
        for (a, b) in (0..3).flat_map(|a| (0..3).map(move |b| (a, b))) {
            let known = if a == b { along[a] } else { 0.0 };
            let size = if a == b || !near { known } else { along.iter().fold(0.0, |s: f64, x| s.max(*x)) };
            let error = (pulled[(a, b)] - known).abs();
            assert!(error <= 1e-14 * size, "{stretches:?} {a} {b}: {error:e} of {size:e}");
        }
    }
}

/// A second difference of the energy, along every direction, at a ball, a spheroid and an ellipsoid: numbers with a derivative
/// know nothing of single stretches.
#[test]
fn derivatives_exist_where_stretches_coincide() {
    for stretches in [[1.0, 1.0, 1.0], [1.3, 1.3, 0.4], [1.2, 1.0, 0.8]] {
        let phi = turn(0.3) * Matrix::<3>::from_diagonal(&stretches.into()) * turn(1.1);
        for (j, b) in (0..3).flat_map(|j| (0..3).map(move |b| (j, b))) {
            let moved = |step: f64| {
                let mut moved = phi;
                moved[(j, b)] += step;
                slopes(1.0, &moved)
            };
            let h = 1e-3;
            let quotient = ((moved(h) - moved(-h)) * 8.0 - (moved(2.0 * h) - moved(-2.0 * h))) / (12.0 * h);
            let mut both = phi.map(Dual::fixed);
            both[(j, b)].slope = 1.0;
            let found = slopes(1.0, &both).map(|entry| entry.slope);
            let error = (found - quotient).norm();
            assert!(error < 1e-9 * quotient.norm(), "{stretches:?}: {error:e}");
        }
    }
}

/// The second derivative of `U` along the pure shear `diag(e^s, e^-s, 1)` of a ball is `8/25 k`: the energy of an ellipsoid near
/// a ball is `-3/5 k (1 - 4/45 (..))`, Kelvin's `sigma^2 = 16/15 pi G rho = 4/5`, with the mass 2/5 of that shear.
#[test]
fn a_ball_oscillates_as_kelvin_says() {
    let mut phi = Matrix::<3>::identity().map(Dual::fixed);
    (phi[(0, 0)].slope, phi[(1, 1)].slope) = (1.0, -1.0);
    let slopes = slopes(1.0, &phi);
    // Along s: d/ds (Q_1 dU/dQ_1 - Q_2 dU/dQ_2).
    let along = slopes[(0, 0)] * phi[(0, 0)] - slopes[(1, 1)] * phi[(1, 1)];
    let mass = 2.0 * 0.2;
    assert!((along.slope / mass - 0.8).abs() < 1e-14, "{}", along.slope);
}

/// Straight-line code in the invariants, and duplication of the three arguments until they are close.
#[test]
fn double_doubles_keep_their_digits() {
    use affine_runtime::scalar::Real;
    let phi = Matrix::<3>::from_diagonal(&[1.25, 1.0, 0.8].into());
    let at_rest = Star.flatten(&Star.at_velocity(phi, Matrix::<3>::zeros()).unwrap());
    let point = Star.unflatten(&at_rest.map(|entry| qd::Quad::constant(entry, 0.0)));
    let found = Star.hamiltonian(qd::Quad::constant(0.0, 0.0), &point);
    let squares = [1.25_f64, 1.0, 0.8].map(|q| qd::Quad::constant(q, 0.0)).map(|q| q * q);
    let known = carlson_rf(squares[0], squares[1], squares[2]) * qd::Quad::constant(3.0, 0.0)
        / qd::Quad::constant(5.0, 0.0);
    assert!(Scalar::abs(found + known).to_f64() < 1e-30, "{found:?} {known:?}");
}

/// `Omega^2/(pi G rho) = 2 sqrt(1 - e^2)/e^3 (3 - 2 e^2) asin e - 6 (1 - e^2)/e^2` (Chandrasekhar, section 32), with
/// `pi G rho = 3/4`.
#[test]
fn spheroids_of_maclaurin_are_in_balance() {
    for e in [0.3_f64, 0.8126, 0.95] {
        let polar = 1.0 - e * e;
        let squared = 2.0 * polar.sqrt() / e.powi(3) * (3.0 - 2.0 * e * e) * e.asin() - 6.0 * polar / (e * e);
        let equator = polar.powf(-1.0 / 6.0);
        let pole = 1.0 / (equator * equator);
        let phi = Matrix::<3>::from_diagonal(&[equator, equator, pole].into());
        let slopes = slopes(1.0, &phi);
        // The pressure takes up Q_a dU/dQ_a - m Omega^2 Q_a^2 at equator and pole alike, m = 1/5.
        let excess = slopes[(0, 0)] * equator - slopes[(2, 2)] * pole;
        let found = excess / (0.2 * equator * equator * 0.75);
        assert!((found - squared).abs() < 1e-13, "{e}: {found} {squared}");
    }
}

#[test]
fn variations_and_equations_are_of_one_motion() {
    let cloud = Cloud { k: 1.0 }.prepare().unwrap();
    let start = |entry: f64| {
        let phi = Matrix::<3>::new(1.0, 0.1, 0.0, 0.0, 1.0, 0.2, 0.0, 0.0, 1.0 + entry);
        cloud.at_velocity(phi, Matrix::<3>::new(0.0, 0.3, 0.0, -0.2, 0.1, 0.0, 0.1, 0.0, 0.0)).unwrap()
    };
    let end = |entry: f64| {
        *Simulation::new(&cloud, start(entry)).until(1.0).tolerance(1e-13).run().unwrap().end().1
    };
    let mut change = [0.0; 18];
    change[8] = 1.0;
    let mut variation = Variation::new(&cloud, (0.0, &start(0.0)), &change, 1e-12).unwrap();
    variation.advance_to(1.0).unwrap();
    let h = 1e-4;
    let quotient = (end(h).phi() - end(-h).phi()) / (2.0 * h);
    let found = Matrix::<3>::from_fn(|i, a| variation.change()[3 * i + a]);
    assert!((found - quotient).norm() < 1e-6, "{found} {quotient}");
}

#[test]
fn what_stays_conserved_follows_from_its_class() {
    let conserved = format!("{:?}", Star::DESCRIPTION.conserved);
    assert_eq!(conserved, "[Energy, Spin, SpinNorm, Vorticity, VorticityNorm]");
    let text = Star::DESCRIPTION.hamiltonian.text;
    assert!(text.ends_with("U_g, U_g = -3/5 R_F(Q_1^2, Q_2^2, Q_3^2)"), "{text}");
}
