//! The drunk missile (problem P1) against a reference solution in 45 digits.

use affine_runtime::model::StateVector;
use affine_runtime::prelude::*;

use crate::integrate::extrapolated;
use affine_tests::reference::{assert_close, entries, norm};
use affine_tests::tolerances::{CONSERVED, REFERENCE_SOLUTION};

/// Affine in space, metrical in the body.
#[affine_model(
    dim = 3,
    symmetry(space = affine, body = metric),
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, body_translation = 1)
)]
struct DrunkMissile;

type Point = <DrunkMissile as Model<3>>::Point<f64>;

/// Steps per unit of time.
const STEPS: f64 = 32.0;

fn start() -> Point {
    DrunkMissile
        .at_momentum(
            Vector::<3>::zeros(),
            Matrix::<3>::new(1.1, 0.2, -0.1, 0.05, 0.9, 0.15, -0.2, 0.1, 1.05),
            Vector::<3>::new(0.3, -0.2, 0.5),
            Comoving(Matrix::<3>::new(0.1, 0.4, -0.3, -0.2, -0.15, 0.25, 0.35, -0.1, 0.05)),
        )
        .unwrap()
}

/// `t` and `x, phi, p_hat, sigma_hat` of every row.
fn reference_solution() -> Vec<(f64, [Vec<f64>; 4])> {
    let rows = include_str!("../data/p1.csv").lines().filter(|line| !line.starts_with('#')).skip(1);
    let rows: Vec<_> = rows
        .map(|line| {
            let mut numbers = line.split(',').map(|number| number.parse::<f64>().unwrap());
            let mut take = |count| numbers.by_ref().take(count).collect::<Vec<_>>();
            let time = take(1)[0];
            let parts = [take(3), take(9), take(3), take(9)];
            assert_eq!((parts[3].len(), numbers.next()), (9, None), "columns");
            (time, parts)
        })
        .collect();
    assert_eq!(rows.iter().map(|(time, _)| *time).collect::<Vec<_>>(), [1.0, 2.0, 5.0, 10.0]);
    rows
}

/// Holds the motion `point(t)`, wanted at increasing times, against the reference solution.
fn assert_is_the_motion(mut point: impl FnMut(f64) -> Point) {
    for (t, [x, phi, p_hat, sigma_hat]) in reference_solution() {
        let found = point(t);
        let close = |what: &str, found: &[f64], expected: &[f64]| {
            assert_close(&format!("{what}({t})"), found, expected, norm(expected), REFERENCE_SOLUTION);
        };
        close("x", found.x().as_slice(), &x);
        close("phi", &entries(found.phi()), &phi);
        close("p_hat", found.p_hat().0.0.as_slice(), &p_hat);
        close("Sigma_hat", &entries(&found.sigma_hat().0.0), &sigma_hat);
        assert_conserved(&found);
    }
}

/// (4.9), (4.10): `p`, `I(O) = x p^T + Sigma`; the vorticity, since the body is isotropic; the energy.
fn assert_conserved(point: &Point) {
    let close = |what, found: &[f64], expected: &[f64]| {
        assert_close(what, found, expected, norm(expected), CONSERVED);
    };
    let total = |point: &Point| entries(&point.total_affine_momentum().0.0);
    let vorticity = |point: &Point| entries(&point.vorticity().0.0);
    let start = start();
    close("p", point.p().as_slice(), start.p().as_slice());
    close("I(O)", &total(point), &total(&start));
    close("Vort", &vorticity(point), &vorticity(&start));
    close("H", &[DrunkMissile.hamiltonian(0.0, point)], &[DrunkMissile.hamiltonian(0.0, &start)]);
}

/// Integrates from row to row.
fn stepping<Y: StateVector<f64>>(equations: impl Fn(&Y) -> Y, start: Y) -> impl FnMut(f64) -> Y {
    let (mut now, mut state) = (0.0, start);
    move |t| {
        state = extrapolated(&equations, state, t - now, (STEPS * (t - now)) as u32);
        now = t;
        state
    }
}

#[test]
fn reduced_equations_reach_the_reference() {
    let (reduced, constants) = DrunkMissile.reduce(0.0, &start());
    let mut state = stepping(|y| DrunkMissile.reduced_equations(0.0, &constants, y), reduced);
    assert_is_the_motion(|t| DrunkMissile.expand(t, &constants, &state(t)));
}

#[test]
fn full_equations_reach_the_reference() {
    let full = DrunkMissile.flatten(&start());
    let mut state = stepping(|y| DrunkMissile.hamilton_equations(0.0, y), full);
    assert_is_the_motion(|t| DrunkMissile.unflatten(&state(t)));
}

/// `p` and `I(O)` are constants of the trajectory: `x` and `phi` are left to integrate.
#[test]
fn reduced_state_is_x_and_phi() {
    let groups: Vec<_> =
        DrunkMissile::DESCRIPTION.reduced.iter().map(|group| (group.name(), group.len)).collect();
    assert_eq!(groups, [("x", 3), ("phi", 9)]);
}
