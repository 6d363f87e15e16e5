//! The energy of lattices far from the undeformed state, where nothing counted from it has a digit left.

use affine_runtime::frames::Matrix;
use affine_runtime::lattice::{Lattice, TwoPolarForm};
use affine_runtime::prelude::*;

/// Relative error of the energy: 20 times `eps` in the exponents, and sums of some terms.
const RELATIVE: f64 = 1e-13;
/// What rounding leaves of an energy that vanishes in the undeformed state.
const ABSOLUTE: f64 = 1e-15;

macro_rules! models {
    ($dim:literal, kinetic $terms:tt: $($name:ident = $potential:expr;)*) => { $(
        #[affine_model(dim = $dim, kinetic $terms, potential = $potential, emit(two_polar))]
        struct $name;
    )* };
}

models! { 3, kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1):
    Exponential3 = exp(-3*q) + q^2;
    Gas3 = det^(-2/3);
    Inverse3 = 1/det;
    Square3 = (det - 1)^2;
    Shear3 = neo_hookean(1);
    Logarithm3 = ln(tr(G)) - 2*q;
    Places3 = exp(-1*q1) + exp(-1*q2) + exp(-1*q3);
    Quotient3 = tr(G^2)/tr(G)^2;
    Trace3 = tr(G);
    Square3OfTrace = tr(G)^2;
    Cubes3 = tr(G^3);
    Deviator3 = tr((G - tr(G)/n)^2);
}

models! { 2, kinetic(dalembert = 0.8):
    DalembertSquare2 = tr(G)^2;
    DalembertDeviator2 = tr((G - tr(G)/n)^2);
}

models! { 3, kinetic(dalembert = 0.8):
    DalembertGas3 = gas(0.5);
    DalembertShear3 = tr(G)*det^(-2/3);
}

models! { 2, kinetic(casimir2 = 0.2, casimir1_squared = 0.1, space_inertia = 1):
    Inverse2 = 1/det;
    Shear2 = neo_hookean(1);
}

/// The lattice at rest, its stretches apart by the factor `exp(1/2)` about their mean.
fn at_rest<const N: usize>(mean: f64) -> Lattice<N> {
    Lattice {
        q: Vector::<N>::from_fn(|a, _| mean + 0.5 * (0.5 * (N as f64 - 1.0) - a as f64)),
        p: Vector::zeros(),
        m: Matrix::zeros(),
        n: Matrix::zeros(),
        left: Matrix::identity(),
        right: Matrix::identity(),
    }
}

/// The energy is the potential's, whose value is known from the mean and the stretches.
fn assert_energy<const N: usize, M: TwoPolarForm<N>>(model: &M, exact: impl Fn(f64, &Vector<N>) -> f64) {
    for mean in [-20.0, -8.0, -3.0, -1.0, -0.3, 0.0, 0.2, 1.0, 3.0, 8.0, 20.0] {
        let lattice = at_rest::<N>(mean);
        let exact = exact(mean, &lattice.q);
        let (couplings, places) = lattice.places::<M>();
        let found = model.lattice_hamiltonian(&couplings, &places);
        let error = (found - exact).abs();
        assert!(
            error <= RELATIVE * exact.abs() + ABSOLUTE,
            "{} at {mean}: {found:e} is not {exact:e}",
            M::DESCRIPTION.name
        );
    }
}

/// `sum exp(2 (q_a - q))`, the trace of the isochoric part.
fn unit_trace<const N: usize>(mean: f64, q: &Vector<N>) -> f64 {
    q.iter().map(|q| (2.0 * (q - mean)).exp()).sum()
}

#[test]
fn energies_keep_their_digits_far_away() {
    assert_energy(&Exponential3, |mean, _| (-3.0 * mean).exp() + mean * mean);
    assert_energy(&Gas3, |mean, _| (-2.0 * mean).exp());
    assert_energy(&Inverse3, |mean, _| (-3.0 * mean).exp());
    assert_energy(&Square3, |mean, _| (3.0 * mean).exp_m1().powi(2));
    assert_energy(&Shear3, |mean, q| unit_trace(mean, q) - 3.0);
    assert_energy(&Logarithm3, |mean, q| unit_trace(mean, q).ln());
    assert_energy(&Places3, |_, q| q.iter().map(|q| (-q).exp()).sum());
    assert_energy(&Quotient3, |mean, q| unit_trace(2.0 * mean, &(q * 2.0)) / unit_trace(mean, q).powi(2));
    assert_energy(&DalembertGas3, |mean, _| 0.5 * (-2.0 * mean).exp());
    assert_energy(&DalembertShear3, unit_trace);
    assert_energy(&Inverse2, |mean, _| (-2.0 * mean).exp());
    assert_energy(&Shear2, |mean, q| unit_trace(mean, q) - 2.0);
}

/// Relative to the energy itself, which is a power of the size.
fn assert_small<const N: usize, M: TwoPolarForm<N>>(
    model: &M,
    degree: f64,
    exact: impl Fn(&Vector<N>) -> f64,
) {
    for mean in [-20.0, -8.0, -3.0, -1.0, -0.3, 0.0, 1.0, 8.0, 20.0] {
        let lattice = at_rest::<N>(mean);
        let exact = (degree * mean).exp() * exact(&(lattice.q.map(|q| (2.0 * (q - mean)).exp())));
        let (couplings, places) = lattice.places::<M>();
        let found = model.lattice_hamiltonian(&couplings, &places);
        let error = (found / exact - 1.0).abs();
        assert!(error <= RELATIVE, "{} at {mean}: {found:e} is not {exact:e}", M::DESCRIPTION.name);
    }
}

/// Polynomials in the squares of the stretches.
#[test]
fn polynomials_keep_their_digits_in_small_bodies() {
    assert_small(&Trace3, 2.0, |squares| squares.sum());
    assert_small(&Square3OfTrace, 4.0, |squares| squares.sum().powi(2));
    assert_small(&Cubes3, 6.0, |squares| squares.map(|square| square.powi(3)).sum());
    assert_small(&Deviator3, 4.0, |squares| squares.map(|square| (square - squares.mean()).powi(2)).sum());
    assert_small(&DalembertSquare2, 4.0, |squares| squares.sum().powi(2));
    assert_small(&DalembertDeviator2, 4.0, |squares| (squares[0] - squares[1]).powi(2) / 2.0);
}
