//! Calogero-Moser and Sutherland systems where they really are invariant families: two bodies, or one coupling among three,
//! with `N = 0`, or special places of three; against the projection of Olshanetsky and Perelomov (Phys. Rep. 71 (1981) 313). Elsewhere they are
//! not: the paper's family of equal constant couplings moves.

use affine_runtime::frames::Matrix;
use affine_runtime::lattice::{CircleFlow, Lattice, LatticeFlow, LatticeForm};
use affine_runtime::prelude::*;

use crate::models::{AffineAffine3, Dalembert2};
use crate::reduced_flow::start;

/// Places of the bodies.
const PLACES: f64 = 1e-12;

/// `1/alpha` = 0.8, `1/beta` = 0: `alpha H = (p_1^2 + p_2^2)/2 + (M^2/16)/sh^2((q_1 - q_2)/2)`.
#[affine_model(dim = 2, kinetic(casimir2 = 1.25), emit(two_polar))]
struct Pair;

#[affine_model(dim = 3, kinetic(casimir2 = 1.25), emit(two_polar))]
struct Triple;

#[affine_model(dim = 2, kinetic(casimir2 = 1.25), group = unitary)]
struct CircularPair;

const ALPHA: f64 = 1.25;

/// Two bodies with a coupling `m`.
fn pair(q: [f64; 2], p: [f64; 2], m: f64) -> Lattice<2> {
    Lattice {
        q: Vector::from(q),
        p: Vector::from(p),
        m: Matrix::<2>::new(0.0, m, -m, 0.0),
        n: Matrix::zeros(),
        left: Matrix::identity(),
        right: Matrix::identity(),
    }
}

/// Differences of places `a (q_1 - q_2)` at the time `t` in `H = (p_1^2 + p_2^2)/2 + g^2 a^2 / sinh^2(a (q_1 - q_2))`, `a` = 1/2:
/// `exp(2 a q)` are the eigenvalues of `b exp(2 a t L) b`, `b = diag(exp(a q(0)))`, `L = [[p_1, i k], [-i k, p_2]]`,
/// `k = g a/sinh(a (q_1 - q_2))`. For a Hermitian `2 a t L = m 1 + h`, `tr h = 0`, `h^2 = w^2 1`:
/// `exp = e^m (cosh w 1 + (sinh w/w) h)`. Products and traces of `2x2` matrices are enough for two eigenvalues.
fn projected(q: [f64; 2], p: [f64; 2], g: f64, t: f64) -> [f64; 2] {
    let a = 0.5;
    let k = g * a / (a * (q[0] - q[1])).sinh();
    let (mean, half, off) = (a * t * (p[0] + p[1]), a * t * (p[0] - p[1]), 2.0 * a * t * k);
    let w = half.hypot(off);
    let (c, s) = (w.cosh(), w.sinh() / w);
    // Diagonal of b exp b, and the determinant.
    let trace =
        mean.exp() * ((2.0 * a * q[0]).exp() * (c + s * half) + (2.0 * a * q[1]).exp() * (c - s * half));
    let determinant = (2.0 * mean + 2.0 * a * (q[0] + q[1])).exp();
    let larger = 0.5 * (trace + (trace * trace - 4.0 * determinant).sqrt());
    [larger.ln() / (2.0 * a), (determinant / larger).ln() / (2.0 * a)]
}

#[test]
fn two_bodies_are_a_hyperbolic_sutherland_system() {
    for (p, m) in [([-0.9, 0.8], 0.7), ([0.2, -0.1], 0.05), ([-2.0, 1.5], 2.5)] {
        let q = [0.8, -0.5];
        let mut flow = LatticeFlow::new(&Pair, 0.0, pair(q, p, m)).tolerance(1e-14);
        for k in 1..=12 {
            let t = 0.5 * f64::from(k);
            let found = *flow.advance_to(t).unwrap();
            let expected = projected(q, p, m / 2.0, t / ALPHA);
            for a in 0..2 {
                let error = (found.q[a] - expected[a]).abs() / (1.0 + expected[a].abs());
                assert!(error < PLACES, "{m}, t = {t}: {error:e}");
            }
            assert_eq!(found.n, Matrix::<2>::zeros());
        }
    }
}

/// One coupling among three: a pair and a free body.
#[test]
fn one_coupling_among_three_is_a_pair_and_a_spectator() {
    let mut lattice = Lattice { left: Matrix::identity(), right: Matrix::identity(), ..start::<3>() };
    lattice.n.fill(0.0);
    lattice.m.fill(0.0);
    (lattice.m[(0, 1)], lattice.m[(1, 0)]) = (0.7, -0.7);
    lattice.q = Vector::<3>::new(0.8, -0.5, -2.0);
    lattice.p = Vector::<3>::new(-0.3, 0.2, -0.4);
    let mut flow = LatticeFlow::new(&Triple, 0.0, lattice).tolerance(1e-14);
    for k in 1..=10 {
        let t = 0.5 * f64::from(k);
        let found = *flow.advance_to(t).unwrap();
        let [first, second] = projected([0.8, -0.5], [-0.3, 0.2], 0.35, t / ALPHA);
        let expected = Vector::<3>::new(first, second, -2.0 - 0.4 * t / ALPHA);
        assert!((found.q - expected).amax() < PLACES, "t = {t}: {}", found.q - expected);
        assert!((found.m - lattice.m).amax() < PLACES && found.n.amax() < PLACES);
    }
}

/// d'Alembert's two stretches are a rational Calogero-Moser system: `r^2 = (r_0 + r_0' t)^2 + (2 g t/r_0)^2` with
/// `r = Q_1 - Q_2` and `g = M/2`, time in units of the inertia.
#[test]
fn two_stretches_are_a_calogero_moser_system() {
    let lattice = pair([1.1, 0.4], [2.0, 1.5], 0.6);
    let mut flow = LatticeFlow::new(&Dalembert2, 0.0, lattice).tolerance(1e-14);
    let (places, momenta) = (lattice.q.map(f64::exp), lattice.p.component_div(&lattice.q.map(f64::exp)));
    for k in 1..=10 {
        let t = 0.4 * f64::from(k);
        let found = flow.advance_to(t).unwrap().q.map(f64::exp);
        let time = t / 1.5;
        let (r, rate) = (places[0] - places[1], momenta[0] - momenta[1]);
        let expected = (r + rate * time).hypot(0.6 * time / r);
        assert!((found[0] - found[1] - expected).abs() < PLACES * (1.0 + expected), "t = {t}");
        let sum = places.sum() + momenta.sum() * time;
        assert!((found.sum() - sum).abs() < PLACES * sum, "t = {t}");
    }
}

/// The same in `H = (p_1^2 + p_2^2)/2 + g^2 a^2/sin^2(a (q_1 - q_2))`: `exp(2 i a q)` are the eigenvalues of
/// `b exp(2 i a t L) b`, `b = diag(exp(i a q(0)))`, `k = g a/sin(a (q_1 - q_2))`. With `exp(i (m 1 + h)) = e^(im) (cos w 1 + i (sin w/w) h)`
/// the determinant is `exp(i (2m + q_1 + q_2))`, and half the trace `exp(i (m + (q_1 + q_2)/2))` times the cosine of half
/// the difference. Sum and that cosine.
fn projected_on_the_circle(q: [f64; 2], p: [f64; 2], g: f64, t: f64) -> [f64; 2] {
    let a = 0.5;
    let (mean, half, off) =
        (a * t * (p[0] + p[1]), a * t * (p[0] - p[1]), 2.0 * a * t * g * a / (a * (q[0] - q[1])).sin());
    let w = half.hypot(off);
    // Diagonal of b exp b without its common phase, real parts.
    let diagonal = |q: f64, half: f64| (a * q).cos() * w.cos() - (a * q).sin() * half * w.sin() / w;
    let difference = q[0] - q[1];
    [q[0] + q[1] + 2.0 * mean, 0.5 * (diagonal(difference, half) + diagonal(-difference, -half))]
}

#[test]
fn the_circle_is_projected_too() {
    for (p, m) in [([-0.4, 0.3], 0.7), ([0.9, -0.2], -0.3), ([0.1, 0.2], 1.5)] {
        let q = [0.8, -0.5];
        let mut flow = CircleFlow::new(&CircularPair, 0.0, pair(q, p, m)).tolerance(1e-14);
        for k in 1..=20 {
            let t = 0.5 * f64::from(k);
            let found = flow.advance_to(t).unwrap().q;
            let [sum, cosine] = projected_on_the_circle(q, p, m / 2.0, t / ALPHA);
            assert!((found.sum() - sum).abs() < PLACES * (1.0 + sum.abs()), "t = {t}: {}", found.sum());
            let error = ((0.5 * (found[0] - found[1])).cos() - cosine).abs();
            assert!(error < PLACES, "t = {t}: {error:e}");
        }
    }
}

/// The compact form: `sin` for `sinh`, `cos(r/2)` swings between the turning points of the effective potential.
#[test]
fn two_bodies_on_the_circle_are_a_trigonometric_sutherland_system() {
    let (q, p, m) = ([0.8, -0.5], [-0.4, 0.3], 0.7);
    let mut flow = CircleFlow::new(&CircularPair, 0.0, pair(q, p, m)).tolerance(1e-14);
    // c = cos x, x = (q_1 - q_2)/2: with E = x'^2 + (M/4)^2/sin^2 x, c'' = -E c, time in units of alpha.
    let (x, rate) = (0.5 * (q[0] - q[1]), 0.5 * (p[0] - p[1]));
    let energy = rate * rate + (m * m / 16.0) / (x.sin() * x.sin());
    let w = energy.sqrt();
    for k in 1..=20 {
        let t = 0.5 * f64::from(k);
        let found = *flow.advance_to(t).unwrap();
        let time = t / ALPHA;
        let expected = x.cos() * (w * time).cos() - x.sin() * rate / w * (w * time).sin();
        let error = ((0.5 * (found.q[0] - found.q[1])).cos() - expected).abs();
        assert!(error < PLACES, "t = {t}: {error:e}");
    }
}

/// Three bodies with `M_13 = 0`, `M_12 = M_23`, the second one midway: the couplings are constant, and with `x` a quarter of the
/// distance of the outer ones, `x'^2 + k/sh^2 x = E`, `k = M_12^2/(32 alpha^2)`, so `ch x` obeys `c'' = E c`.
#[test]
fn a_body_midway_between_two_stays_there() {
    let skew = Matrix::<3>::new(0.0, 0.9, 0.0, -0.9, 0.0, 0.9, 0.0, -0.9, 0.0);
    for sign in [1.0, -1.0] {
        let mut m = skew;
        (m[(1, 2)], m[(2, 1)]) = (sign * 0.9, -sign * 0.9);
        let lattice = Lattice {
            q: Vector::<3>::new(0.9, 0.1, -0.7),
            p: Vector::<3>::new(-0.5, 0.2, 0.9),
            m,
            n: Matrix::zeros(),
            left: Matrix::identity(),
            right: Matrix::identity(),
        };
        let (x, rate, k) = (0.4_f64, -0.35 / ALPHA, 0.81 / (32.0 * ALPHA * ALPHA));
        let w = (rate * rate + k / x.sinh().powi(2)).sqrt();
        let mut flow = LatticeFlow::new(&Triple, 0.0, lattice).tolerance(1e-14);
        for k in 1..=10 {
            let t = 0.5 * f64::from(k);
            let found = *flow.advance_to(t).unwrap();
            let c = x.cosh() * (w * t).cosh() + x.sinh() * rate / w * (w * t).sinh();
            let middle = 0.1 + 0.2 * t / ALPHA;
            let expected = Vector::<3>::new(middle + 2.0 * c.acosh(), middle, middle - 2.0 * c.acosh());
            assert!((found.q - expected).amax() < PLACES, "t = {t}: {}", found.q - expected);
            assert!((found.m - m).amax() < PLACES && found.n.amax() == 0.0, "t = {t}");
        }
    }
}

/// Three equal couplings at equal distances on the circle: an equilibrium that turns as a whole.
#[test]
fn equal_distances_on_the_circle_stay_equal() {
    #[affine_model(dim = 3, kinetic(casimir2 = 1.25), group = unitary)]
    struct Circular;
    let third = std::f64::consts::TAU / 3.0;
    let lattice = Lattice {
        q: Vector::<3>::new(third, 0.0, -third),
        p: Vector::<3>::from_element(0.3),
        m: Matrix::<3>::new(0.0, 1.0, 1.0, -1.0, 0.0, 1.0, -1.0, -1.0, 0.0),
        n: Matrix::zeros(),
        left: Matrix::identity(),
        right: Matrix::identity(),
    };
    let found = *CircleFlow::new(&Circular, 0.0, lattice).tolerance(1e-14).advance_to(2.0).unwrap();
    let turned = lattice.q.map(|q| q + 0.3 * 2.0 / ALPHA);
    assert!(
        (found.q - turned).amax() < PLACES && (found.m - lattice.m).amax() < PLACES,
        "{}",
        found.q - turned
    );
}

/// `N = 0` is invariant; equal constant `M_ab` are not: `dM_12/dt = M_13 M_32 (w_32 - w_13)`.
#[test]
fn equal_couplings_of_three_bodies_move() {
    let mut lattice = start::<3>();
    lattice.n.fill(0.0);
    for (a, b) in [(0, 1), (0, 2), (1, 2)] {
        (lattice.m[(a, b)], lattice.m[(b, a)]) = (1.0, -1.0);
    }
    let (couplings, places) = lattice.places::<AffineAffine3>();
    let rates = AffineAffine3.lattice_equations(&couplings, &places);
    let alpha = 1.2;
    let w = |a: usize, b: usize| 1.0 / (8.0 * alpha * (0.5 * (lattice.q[a] - lattice.q[b])).sinh().powi(2));
    assert!((rates[6] - -(w(2, 1) - w(0, 2))).abs() < 1e-14, "{rates:?}");
    assert!(rates[6].abs() > 1e-2, "not invariant");
    assert_eq!(rates[9..], [0.0; 3], "N stays zero");
    let moved = *LatticeFlow::new(&AffineAffine3, 0.0, lattice).advance_to(2.0).unwrap();
    assert!((moved.m[(0, 1)] - 1.0).abs() > 1e-2 && moved.n.amax() == 0.0);
    assert!((moved.m.norm_squared() - 6.0).abs() < 1e-12, "the sum of their squares is conserved");
}
