//! The lattice in ratios of stretches (P4 without exponentials): against the equations of `(q, p, M, N)`, and against
//! its closed form.

use affine_integrators::RungeKutta8;
use affine_runtime::decompose::LinearMap;
use affine_runtime::frames::Matrix;
use affine_runtime::lattice::{Lattice, LatticeFlow, LatticeForm, RatioForm, TwoPolarForm};
use affine_runtime::model::{Group, Quantity};
use affine_runtime::prelude::*;

use crate::reduced_flow::{distance, start};

/// Rates, relative to the larger of 1 and themselves.
const RATES: f64 = 1e-14;
/// `q, p, M, N`.
const CLOSED_FORM: f64 = 1e-12;

macro_rules! models {
    ($($name:ident $n:literal ($($kinetic:tt)*);)*) => { $(
        #[affine_model(dim = $n, kinetic($($kinetic)*), emit(two_polar, ratios))]
        struct $name;
    )* };
}

models! {
    Plane 2 (casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1);
    Affine 3 (casimir2 = 1.2, casimir1_squared = 0.1);
    Body 3 (casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1);
    Mirrored 3 (casimir2 = 0.2, casimir1_squared = -0.3, space_inertia = 1);
}

#[affine_model(dim = 3, kinetic(casimir2 = a, space_inertia = i), emit(two_polar, ratios))]
struct Family {
    a: f64,
    i: f64,
}

/// The rates of `t_ab`, `p/alpha`, `U` and `W` from those of `q, p, M, N`.
fn assert_same_rates<const N: usize, M: RatioForm<N>>(model: &M, lattice: &Lattice<N>) {
    let (couplings, state) = model.in_ratios(lattice);
    let found = model.ratio_equations(&couplings, &state);
    let (plain_couplings, places) = lattice.places::<M>();
    let rates = model.lattice_equations(&plain_couplings, &places);
    let (rates, scale) = (rates.as_ref(), model.isotropic().unwrap().inverse_alpha);
    let ratios = (1..N).map(|b| (lattice.q[b] - lattice.q[b - 1]).exp() * (rates[b] - rates[b - 1]));
    let momenta = rates[N..2 * N].iter().map(|rate| rate * scale);
    let skew = &rates[2 * N..];
    let (m, n) = skew.split_at(skew.len() / 2);
    let half = |sign: f64| m.iter().zip(n).map(move |(m, n)| 0.5 * scale * (m + sign * n));
    let expected: Vec<f64> = ratios.chain(momenta).chain(half(1.0)).chain(half(-1.0)).collect();
    assert_eq!(found.as_ref().len(), expected.len());
    for (found, expected) in found.as_ref().iter().zip(&expected) {
        assert!((found - expected).abs() < RATES * expected.abs().max(1.0), "{found} is not {expected}");
    }
    let mean = (0..N).map(|a| rates[a]).sum::<f64>() / N as f64;
    assert!((model.mean_rate(lattice) - mean).abs() < RATES);
}

#[test]
fn equations_are_those_of_the_lattice() {
    for shift in [0.0, 0.3, -0.25] {
        let moved = |lattice: &mut Lattice<3>| lattice.q[1] += shift;
        let mut lattice = start();
        moved(&mut lattice);
        assert_same_rates(&Affine, &lattice);
        assert_same_rates(&Body, &lattice);
        assert_same_rates(&Mirrored, &lattice);
        assert_same_rates(&Family { a: 0.3, i: 1.1 }.prepare().unwrap(), &lattice);
        assert_same_rates(&Plane, &start());
    }
}

#[test]
fn conversions_go_both_ways() {
    fn assert_back<const N: usize, M: RatioForm<N>>(model: &M) {
        let lattice = Lattice { left: Matrix::identity(), right: Matrix::identity(), ..start::<N>() };
        let (couplings, state) = model.in_ratios(&lattice);
        let back = model.of_ratios(&couplings, &state, lattice.q.sum() / N as f64);
        assert!(distance(&back, &lattice) < 1e-15);
    }
    assert_back(&Plane);
    assert_back(&Mirrored);
}

/// `phi(t) = exp(t (Y/alpha + (tr Y/beta) 1)) diag(exp(q))` with the conserved `Sigma = Y`, `Y_ab = exp(x_ab) Z_ab`, for
/// `L = R = 1`.
fn closed_form(lattice: &Lattice<3>, t: f64) -> Lattice<3> {
    let isotropic = Affine.isotropic().unwrap();
    let z = lattice.z();
    let y = Matrix::<3>::from_fn(|a, b| (0.5 * (lattice.q[a] - lattice.q[b])).exp() * z[(a, b)]);
    let rate =
        y * isotropic.inverse_alpha + Matrix::<3>::from_diagonal_element(isotropic.inverse_beta * y.trace());
    let phi = (rate * t).exponential() * Matrix::from_diagonal(&lattice.q.map(f64::exp));
    let here = Affine.at_lattice(lattice).unwrap();
    Affine.lattice(&here.moved(Vector::zeros(), phi, |_| phi.try_inverse().unwrap() * y * phi)).unwrap()
}

/// The distance from an equal labelling; the frames are no part of this form, and signs of the axes are free.
fn up_to_signs(found: &Lattice<3>, sorted: &Lattice<3>) -> f64 {
    let signs = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];
    let turned = signs.map(|signs| sorted.relabelled(&Matrix::from_diagonal(&Vector::<3>::from(signs))));
    let equal = turned.map(|other| Lattice { left: found.left, right: found.right, ..other });
    equal.iter().map(|expected| distance(found, expected)).fold(f64::INFINITY, f64::min)
}

/// Problem P4 against its closed form to t = 5, and to t = 10 against the lattice with exponentials: there the closed form
/// loses `M` and `N` to the condition of `phi`.
#[test]
fn the_motion_has_its_closed_form() {
    let lattice = Lattice { left: Matrix::identity(), right: Matrix::identity(), ..start::<3>() };
    let (couplings, mut state) = Affine.in_ratios(&lattice);
    let rates =
        |_: f64, state: &<Affine as RatioForm<3>>::Ratios<f64>| Affine.ratio_equations(&couplings, state);
    const GROUPS: &[Group] = &[
        Group::new(Quantity::Other("t"), 1),
        Group::new(Quantity::Other("t"), 1),
        Group::new(Quantity::LatticeMomenta, 9),
    ];
    for k in 1..=20 {
        let t = 0.5 * f64::from(k);
        let mut steps = RungeKutta8::new(rates, GROUPS, (t - 0.5, state), t, 1e-15).unwrap();
        while !steps.is_finished() {
            steps.advance().unwrap();
        }
        state = *steps.y();
        let q = lattice.q.sum() / 3.0 + t * Affine.mean_rate(&lattice);
        let found = Affine.of_ratios(&couplings, &state, q);
        let expected = match k <= 10 {
            true => closed_form(&lattice, t),
            false => *LatticeFlow::new(&Affine, 0.0, lattice).tolerance(1e-15).advance_to(t).unwrap(),
        };
        let error = up_to_signs(&found, &expected);
        println!("t = {t}: {error:.1e}, {:?}", steps.statistics());
        assert!(error < CLOSED_FORM, "t = {t}: {error:e}");
    }
}

/// One program for all models: nothing depends on their coefficients.
#[test]
fn there_are_no_coefficients_and_no_exponentials() {
    let operations = [Affine::RATIO_OPERATIONS, Body::RATIO_OPERATIONS, Mirrored::RATIO_OPERATIONS];
    assert!(operations.iter().all(|o| *o == operations[0] && o.exp == 0 && o.div == 3));
    let plane = Plane::RATIO_OPERATIONS;
    assert_eq!((plane.exp, plane.div), (0, 1));
    let lattice = Affine::LATTICE.operations;
    assert_ne!(lattice.exp, 0);
}
