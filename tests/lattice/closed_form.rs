//! The geodesic lattice (problem P4) against its closed form, its invariants, and what it does where stretches meet.

use affine_runtime::Error;
use affine_runtime::decompose::LinearMap;
use affine_runtime::frames::Matrix;
use affine_runtime::lattice::{Lattice, LatticeFlow, LatticeForm, StopReason, TwoPolarForm, Variables};
use affine_runtime::prelude::*;

use crate::models::*;
use crate::reduced_flow::{distance, start};

/// Relative error of `q, p, M, N, L, R`.
const CLOSED_FORM: f64 = 1e-12;
/// Invariants along a motion, relative to the sizes they are made of.
const INVARIANT: f64 = 1e-13;
/// The Hamiltonian of the lattice against that of the phase point.
const ENERGY: f64 = 1e-14;

/// `phi(t) = exp(t (Y/alpha + (tr Y/beta) 1)) diag(exp(q))`, `Y_ab = exp(x_ab) Z_ab`, for `L = R = 1`: then `Y` is
/// `Sigma`, and conserved.
fn closed_form<const N: usize, M: TwoPolarForm<N>>(model: &M, start: &Lattice<N>, t: f64) -> M::Point<f64> {
    let isotropic = model.isotropic().unwrap();
    let z = start.z();
    let y = Matrix::<N>::from_fn(|a, b| (0.5 * (start.q[a] - start.q[b])).exp() * z[(a, b)]);
    let rate =
        y * isotropic.inverse_alpha + Matrix::<N>::from_diagonal_element(isotropic.inverse_beta * y.trace());
    let phi = (rate * t).exponential() * Matrix::from_diagonal(&start.q.map(f64::exp));
    let here = model.at_lattice(start).unwrap();
    here.moved(Vector::zeros(), phi, |_| phi.try_inverse().unwrap() * y * phi)
}

fn assert_closed_form<const N: usize, M: TwoPolarForm<N>>(model: &M) {
    let start = Lattice { left: Matrix::identity(), right: Matrix::identity(), ..start() };
    let mut flow = LatticeFlow::new(model, 0.0, start).tolerance(1e-15);
    for k in 1..=10 {
        let t = 0.5 * f64::from(k);
        let found = *flow.advance_to(t).unwrap();
        let expected = model.lattice_after(&closed_form(model, &start, t), &found).unwrap();
        let error = distance(&found, &expected);
        assert!(error < CLOSED_FORM, "t = {t}: {error:e}");
    }
    let back = *flow.advance_to(0.0).unwrap();
    assert!(distance(&back, &start) < CLOSED_FORM, "there and back");
}

/// The momentum of [`closed_form`] is `Sigma_hat`: models of the body's frame.
#[test]
fn geodesic_lattices_have_their_closed_form() {
    assert_closed_form(&AffineAffine2);
    assert_closed_form(&AffineAffine3);
}

/// `tr Z^k`, `|rho_hat|` and `|tau_hat|`.
fn invariants<const N: usize>(lattice: &Lattice<N>) -> [f64; 5] {
    let z = lattice.z();
    [
        z.trace(),
        (z * z).trace(),
        (z * z * z).trace(),
        lattice.spin().norm_squared(),
        lattice.minus_vorticity().norm_squared(),
    ]
}

fn assert_invariants<const N: usize, M: TwoPolarForm<N>>(model: &M, kept: std::ops::Range<usize>) {
    let first = start::<N>();
    let mut flow = LatticeFlow::new(model, 0.0, first).tolerance(1e-15);
    let size = first.z().norm().max(1.0);
    for k in 1..=20 {
        let now = *flow.advance_to(0.25 * f64::from(k)).unwrap();
        for k in kept.clone() {
            let drift = (invariants(&now)[k] - invariants(&first)[k]).abs() / size.powi(3);
            assert!(drift < INVARIANT, "{} {k}: {drift:e}", M::DESCRIPTION.name);
        }
    }
}

#[test]
fn casimirs_and_norms_are_invariant() {
    assert_invariants(&AffineAffine2, 0..5);
    assert_invariants(&SpatiallyAffine3, 0..5);
    assert_invariants(&MateriallyAffine3, 0..5);
    // A potential keeps spin and vorticity.
    assert_invariants(&AffineAffineSheared3, 3..5);
    assert_invariants(&DalembertSheared3, 3..5);
}

fn assert_energy<const N: usize, M: TwoPolarForm<N>>(model: &M) {
    let lattice = start::<N>();
    let (couplings, places) = lattice.places::<M>();
    let found = model.lattice_hamiltonian(&couplings, &places);
    let expected = model.hamiltonian(0.0, &model.at_lattice(&lattice).unwrap());
    let error = (found - expected).abs() / (1.0 + expected.abs());
    assert!(error < 10.0 * ENERGY, "{}: {found} is not {expected}", M::DESCRIPTION.name);
}

#[test]
fn the_lattice_has_the_energy_of_the_phase_point() {
    assert_energy(&AffineAffine2);
    assert_energy(&SpatiallyAffineSheared2);
    assert_energy(&MateriallyAffineSheared3);
    assert_energy(&SpatiallyAffineSheared3);
    assert_energy(&DalembertSheared2);
    assert_energy(&DalembertSheared3);
}

/// Two stretches with `M_12 = 0` cross: labels follow them through.
#[test]
fn stretches_cross_and_keep_their_labels() {
    let mut lattice = start::<2>();
    lattice.m.fill(0.0);
    lattice.n *= 0.1;
    lattice.p = Vector::<2>::new(-1.2, 1.0);
    let mut flow = LatticeFlow::new(&AffineAffine2, 0.0, lattice);
    let end = *flow.advance_to(3.0).unwrap();
    assert!(flow.steps().1 > 0, "through the placement");
    assert!(end.q[0] < -0.5 && end.q[1] > 1.0, "crossed: {}", end.q);
    assert!(end.m.amax() < 1e-12, "M stays zero: {:e}", end.m.amax());
    assert!((end.n - lattice.n).amax() < 1e-12, "N keeps its sign: {}", end.n);
    assert!((end.left - lattice.left).amax() < 0.5, "axes go on: {}", end.left);
}

/// With `M_12 != 0` they bounce, however near they come.
#[test]
fn stretches_bounce() {
    let mut lattice = start::<2>();
    lattice.m *= 0.01 / lattice.m.amax();
    lattice.p = Vector::<2>::new(-1.2, 1.0);
    let mut flow = LatticeFlow::new(&AffineAffine2, 0.0, lattice);
    let end = *flow.advance_to(3.0).unwrap();
    assert!(flow.steps().1 > 0, "through the placement");
    assert!(end.q[0] > 1.0 && end.q[1] < -0.5, "not crossed: {}", end.q);
    let sum = |lattice: &Lattice<2>| lattice.m[(0, 1)];
    assert!((sum(&end) - sum(&lattice)).abs() < 1e-12, "M is conserved");
}

/// A free d'Alembert body, `phi(t) = phi0 + t phi_dot0`, collapses where its determinant first vanishes.
#[test]
fn collapse_is_an_outcome_with_its_time() {
    let mut lattice = start::<3>();
    lattice.p = Vector::<3>::new(-2.0, -2.5, -2.0);
    let stop = LatticeFlow::new(&Dalembert3, 0.0, lattice).advance_to(10.0).unwrap_err();
    assert!(matches!(stop.reason, StopReason::Conversion(Error::Placement { .. })), "{stop}");
    let point = Dalembert3.at_lattice(&lattice).unwrap();
    let (phi, rate) = (*point.phi(), Dalembert3.velocity(&point).phi_dot);
    let determinant = |t: f64| (phi + rate * t).determinant();
    let (mut before, mut after) =
        (0.0, (1..).map(|k| 0.01 * f64::from(k)).find(|t| determinant(*t) < 0.0).unwrap());
    for _ in 0..60 {
        let middle = 0.5 * (before + after);
        *(if determinant(middle) > 0.0 { &mut before } else { &mut after }) = middle;
    }
    assert!((stop.t - before).abs() < 1e-10, "{} is not {before}", stop.t);
    assert!(stop.lattice.q.iter().all(|q| q.is_finite()), "{stop}");
}

#[test]
fn times_that_are_no_numbers_are_refused() {
    for t in [f64::NAN, f64::INFINITY] {
        let stop = LatticeFlow::new(&AffineAffine3, 0.0, start()).advance_to(t).unwrap_err();
        assert_eq!(stop.reason, StopReason::Conversion(Error::NotFinite { quantity: "t" }));
    }
    let mut lattice = start::<3>();
    lattice.q[1] = f64::NAN;
    assert!(LatticeFlow::new(&AffineAffine3, 0.0, lattice).advance_to(1.0).is_err());
}

#[test]
fn coincident_stretches_are_no_lattice() {
    let mut lattice = start::<3>();
    lattice.q[1] = lattice.q[0];
    assert_eq!(AffineAffine3.at_lattice(&lattice).unwrap_err(), Error::CoincidentStretches);
}

/// Stretches from `exp(-300)` to `exp(300)`: nothing overflows.
#[test]
fn far_apart_nothing_overflows() {
    let mut lattice = start::<3>();
    lattice.q = Vector::<3>::new(300.0, 1.0, -300.0);
    let (couplings, places) = lattice.places::<AffineAffine3>();
    let rates = AffineAffine3.lattice_equations(&couplings, &places);
    assert!(rates.iter().all(|rate| rate.is_finite()), "{rates:?}");
    // Only the sums of momenta are left: dq_a = p_a/alpha + p/beta, and M, N turn about what N keeps.
    let isotropic = AffineAffine3.isotropic().unwrap();
    let expected = lattice.p * isotropic.inverse_alpha
        + Vector::<3>::from_element(lattice.p.sum() * isotropic.inverse_beta);
    assert!((0..3).all(|a| (rates[a] - expected[a]).abs() < 1e-15), "{rates:?}");
    assert!(rates[3..].iter().all(|rate| rate.abs() < 1e-15), "free motion: {rates:?}");
    let moved = *LatticeFlow::new(&AffineAffine3, 0.0, lattice).advance_to(1.0).unwrap();
    assert!((moved.q - lattice.q - expected).amax() < 1e-12);
}

#[test]
fn variables_are_named() {
    assert_eq!(AffineAffine3::LATTICE.variables, Variables::LogStretches);
    assert_eq!(Dalembert3::LATTICE.variables, Variables::Stretches);
    let layout = |groups: &[affine_runtime::model::Group]| {
        groups.iter().map(|g| (g.name(), g.len)).collect::<Vec<_>>()
    };
    assert_eq!(layout(AffineAffine2::LATTICE.state), [("q", 2), ("p", 2)], "M and N are constants");
    assert_eq!(layout(Dalembert3::LATTICE.state), [("Q", 3), ("P", 3), ("M", 3), ("N", 3)]);
}
