//! The charts themselves: on the group, inverse under a change of sign, and their equations against differences.

use affine_integrators::lie::Chart;
use affine_runtime::frames::Matrix;
use affine_runtime::model::Constraint;

use crate::curve::{GROUPS, defect, project};

fn sample<const N: usize>(seed: usize, size: f64) -> Matrix<N> {
    Matrix::<N>::from_fn(|i, j| size * ((1 + i + N * j + 7 * seed) as f64 * 1.7).sin())
}

fn placement<const N: usize>(constraint: Constraint, xi: &Matrix<N>) -> Matrix<N> {
    Chart::<N>::new(constraint, 0).displacement(xi) + Matrix::<N>::identity()
}

fn on_the_group<const N: usize>(constraint: Constraint) {
    for seed in 0..40 {
        for size in [1e-9, 1e-3, 0.1, 0.5] {
            let xi = project(constraint, &sample::<N>(seed, size));
            let there = placement(constraint, &xi);
            let defect = defect(constraint, &there);
            // Roundings of the entries, and their products in the determinant and in the Gram matrix.
            assert!(defect < 1e-15 + 2e-14 * size, "{constraint:?} {size:e} {defect:e}");
            let back = placement(constraint, &-xi);
            let error = (there * back - Matrix::<N>::identity()).norm();
            assert!(error < 1e-15 + 2e-14 * size, "c(-xi) = c(xi)^-1: {constraint:?} {size:e} {error:e}");
        }
    }
}

#[test]
fn charts_are_on_their_groups_and_symmetric() {
    for constraint in GROUPS {
        on_the_group::<2>(constraint);
        on_the_group::<3>(constraint);
    }
}

/// `c^-1 dc` along `xi + s xi'` is `Oh`, where `xi'` belongs to `Oh`: by differences of order 4.
fn equations<const N: usize>(constraint: Constraint) {
    let chart = Chart::<N>::new(constraint, 0);
    for seed in 0..40 {
        let xi = project(constraint, &sample::<N>(seed, 0.5));
        let oh = project(constraint, &sample::<N>(seed + 100, 1.0));
        let rate = chart.rate(&xi, &oh);
        assert!((project(constraint, &rate) - rate).norm() < 1e-14, "xi' is in the algebra");
        let at = |s: f64| placement(constraint, &(xi + rate * s));
        let d = 1e-3;
        let derivative = ((at(d) - at(-d)) * 8.0 - (at(2.0 * d) - at(-2.0 * d))) / (12.0 * d);
        let found = placement(constraint, &-xi) * derivative;
        let error = (found - oh).norm();
        assert!(error < 3e-10, "{constraint:?} N = {N}: {error:e}");
    }
}

#[test]
fn equations_of_the_charts_are_exact() {
    for constraint in GROUPS {
        equations::<2>(constraint);
        equations::<3>(constraint);
    }
}

#[test]
fn velocities_come_from_placement_and_rate() {
    for constraint in GROUPS {
        let chart = Chart::<3>::new(constraint, 0);
        let phi = placement(constraint, &project(constraint, &sample::<3>(3, 0.8)));
        let oh = project(constraint, &sample::<3>(5, 2.0));
        let error = (chart.comoving(&phi, &(phi * oh)) - oh).norm();
        assert!(error < 1e-14, "{constraint:?} {error:e}");
    }
}
