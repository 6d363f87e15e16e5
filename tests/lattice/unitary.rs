//! The lattice on the circle: U(n), (89), against the exponential of its generator.

use affine_runtime::frames::Matrix;
use affine_runtime::lattice::{CircleFlow, Lattice, LatticeForm, StopReason, Variables};
use affine_runtime::prelude::*;

use crate::reduced_flow::start;

/// `phi(t)` entry by entry.
const PLACEMENT: f64 = 1e-12;

const A: f64 = 0.9;
const B: f64 = 0.3;

#[affine_model(dim = 2, kinetic(casimir2 = 0.9, casimir1_squared = 0.3), group = unitary)]
struct Unitary2;

#[affine_model(dim = 3, kinetic(casimir2 = a, casimir1_squared = 0.3), group = unitary)]
struct Unitary3 {
    a: f64,
}

/// `phi(t) = exp(E t) phi0`, `E = phi_dot phi^-1` at the start, with `L = R = 1` there:
/// `E = (chi_hat D + i diag(dq/dt) D - D theta_hat) D^-1`, `H_M = M/(8A sin^2 x)`, `H_N = N/(8A cos^2 x)`,
/// `chi_hat = H_M - H_N`, `theta_hat = H_M + H_N`, `dq_a/dt = p_a/A - B p/(A(A + nB))`. Complex matrices as real ones of
/// twice the size, `[[re, -im], [im, re]]`.
macro_rules! generator {
    ($n:literal, $twice:literal, $start:expr) => {{
        let start: Lattice<$n> = $start;
        let mut generator = Matrix::<$twice>::zeros();
        for a in 0..$n {
            let rate = start.p[a] / A - B * start.p.sum() / (A * (A + $n as f64 * B));
            generator[(a, $n + a)] = -rate;
            generator[($n + a, a)] = rate;
            for b in (0..$n).filter(|b| *b != a) {
                let x = 0.5 * (start.q[a] - start.q[b]);
                let h_m = start.m[(a, b)] / (8.0 * A * x.sin().powi(2));
                let h_n = start.n[(a, b)] / (8.0 * A * x.cos().powi(2));
                // (D theta D^-1)_ab = theta_ab exp(2 i x)
                let (chi, theta) = (h_m - h_n, h_m + h_n);
                let (re, im) = (chi - theta * (2.0 * x).cos(), -theta * (2.0 * x).sin());
                generator[(a, b)] = re;
                generator[($n + a, $n + b)] = re;
                generator[(a, $n + b)] = -im;
                generator[($n + a, b)] = im;
            }
        }
        generator
    }};
}

/// `[[re, -im], [im, re]]` of `phi`.
macro_rules! doubled {
    ($n:literal, $twice:literal, $lattice:expr) => {{
        let (re, im) = $lattice.unitary_placement();
        Matrix::<$twice>::from_fn(|i, j| match (i < $n, j < $n) {
            (true, true) => re[(i, j)],
            (false, false) => re[(i - $n, j - $n)],
            (true, false) => -im[(i, j - $n)],
            (false, true) => im[(i - $n, j)],
        })
    }};
}

macro_rules! assert_exponential {
    ($n:literal, $twice:literal, $model:expr) => {{
        let model = $model;
        let first = Lattice::<$n> { left: Matrix::identity(), right: Matrix::identity(), ..start() };
        let generator = generator!($n, $twice, first);
        let mut flow = CircleFlow::new(&model, 0.0, first).tolerance(1e-14);
        for k in 1..=8 {
            let t = 0.25 * f64::from(k);
            let found = *flow.advance_to(t).unwrap();
            let expected = (generator * t).exp() * doubled!($n, $twice, first);
            let error = (doubled!($n, $twice, found) - expected).amax();
            assert!(error < PLACEMENT, "t = {t}: {error:e}");
            // phi is unitary.
            let phi = doubled!($n, $twice, found);
            assert!((phi.tr_mul(&phi) - Matrix::<$twice>::identity()).amax() < 1e-13);
        }
    }};
}

#[test]
fn planar_motion_is_an_exponential() {
    assert_exponential!(2, 4, Unitary2);
    assert_eq!(Unitary2::LATTICE.variables, Variables::Angles);
}

#[test]
fn spatial_motion_is_an_exponential() {
    assert_exponential!(3, 6, Unitary3 { a: A }.prepare().unwrap());
}

/// Potentials of the angles.
#[affine_model(dim = 2, kinetic(casimir2 = 0.9, casimir1_squared = 0.3), group = unitary, potential = pairs(-cos(d)))]
struct Pendulum;
#[affine_model(
    dim = 3,
    kinetic(casimir2 = 0.9, casimir1_squared = 0.3),
    group = unitary,
    potential = cos(q1) + cos(q2) + cos(q3) + pairs(cos(2*d)) + sin(3*q)
)]
struct Held3;

/// `x = q_1 - q_2` without couplings is a pendulum, `x'' = -(2/A) sin x`: from rest it is at the other side after half of
/// `2 pi sqrt(A/2)/agm(1, cos(x_0/2))`.
#[test]
fn two_angles_are_a_pendulum() {
    let turn = 1.3_f64;
    let (mut a, mut b) = (1.0, (turn / 2.0).cos());
    for _ in 0..6 {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    let half = std::f64::consts::PI * (A / 2.0).sqrt() / a;
    let mut first = start::<2>();
    first.q = Vector::<2>::new(0.3 + turn / 2.0, 0.3 - turn / 2.0);
    first.p.fill(0.0);
    first.m.fill(0.0);
    first.n.fill(0.0);
    let mut flow = CircleFlow::new(&Pendulum, 0.0, first).tolerance(1e-14);
    let other = *flow.advance_to(half).unwrap();
    assert!((other.q - Vector::<2>::new(first.q[1], first.q[0])).norm() < 1e-11, "{other:?}");
    assert!(other.p.norm() < 1e-11);
}

/// Rates are the derivatives of the energy, by differences of order 4, and the energy is constant.
#[test]
fn potentials_of_angles_push() {
    let state: [f64; 12] = std::array::from_fn(|k| 0.3 + (1.7 * k as f64 + 0.4).sin());
    let rates = Held3.lattice_equations(&[], &state);
    let energy = |k: usize, by: f64| {
        let mut moved = state;
        moved[k] += by;
        Held3.lattice_hamiltonian(&[], &moved)
    };
    for k in 0..6 {
        const H: f64 = 1e-3;
        let near = energy(k, H) - energy(k, -H);
        let slope = (8.0 * near - energy(k, 2.0 * H) + energy(k, -2.0 * H)) / (12.0 * H);
        let rate = if k < 3 { -rates[k + 3] } else { rates[k - 3] };
        assert!((rate - slope).abs() < 1e-8 * (1.0 + slope.abs()), "{k}: {rate} {slope}");
    }
    let first = start::<3>();
    let mut flow = CircleFlow::new(&Held3, 0.0, first).tolerance(1e-14);
    let last = *flow.advance_to(0.5).unwrap();
    let of = |lattice: &Lattice<3>| {
        let pairs = [(0, 1), (0, 2), (1, 2)];
        let mut state = [0.0; 12];
        for k in 0..3 {
            (state[k], state[3 + k]) = (lattice.q[k], lattice.p[k]);
            (state[6 + k], state[9 + k]) = (lattice.m[pairs[k]], lattice.n[pairs[k]]);
        }
        Held3.lattice_hamiltonian(&[], &state)
    };
    assert!((of(&last) - of(&first)).abs() < 1e-11 * of(&first).abs(), "{} {}", of(&last), of(&first));
}

#[test]
fn degenerate_values_are_refused() {
    assert!(Unitary3 { a: 0.0 }.prepare().is_err());
    assert!(Unitary3 { a: -0.9 }.prepare().is_err(), "A + nB = 0");
}

/// With a coupling that is next to nothing angles come nearer than the coordinates reach.
#[test]
fn coincidence_is_an_outcome() {
    let mut lattice = start::<2>();
    lattice.m *= 1e-9;
    lattice.n.fill(0.0);
    lattice.p = Vector::<2>::new(-1.0, 1.0);
    let stop = CircleFlow::new(&Unitary2, 0.0, lattice).advance_to(10.0).unwrap_err();
    assert!(matches!(stop.reason, StopReason::Coincidence { .. }), "{stop}");
    // q_1 - q_2 = 0.8 - 2 t/A
    assert!(stop.t < 0.8 * A / 2.0, "{stop}");
    // So is one at the start.
    lattice.q.fill(0.3);
    let stop = CircleFlow::new(&Unitary2, 0.0, lattice).advance_to(10.0).unwrap_err();
    assert_eq!((stop.t, stop.reason), (0.0, StopReason::Coincidence { distance: 0.0 }));
}
