//! Placements and momenta on a constraint group, and what is compared there.

use affine_oracle::{Constraint, Differential, Matrix as Exact, Motion, Observable, Place, Random, rational};
use affine_runtime::model::Conserved;
use affine_runtime::prelude::*;
use affine_runtime::state::Euclidean;

use crate::charts::{exists, listed_as_a_whole};
use crate::reference::{Reference, assert_close};
use crate::tolerances::{BRACKET_VISIBLE, BRACKET_ZERO};

/// Points per model.
const SAMPLES: u64 = 4;

/// A placement on the group, a matrix `spin` of its algebra, position and momentum of the centre.
#[derive(Clone, Copy)]
pub struct Start<const N: usize> {
    /// `x`
    pub x: Vector<N>,
    /// `phi`
    pub phi: Matrix<N>,
    /// `p`
    pub p: Vector<N>,
    /// A matrix of the algebra.
    pub spin: Matrix<N>,
}

/// Random starts.
pub fn starts<const N: usize>(constraint: Constraint) -> impl Iterator<Item = Start<N>> {
    (0..SAMPLES).map(move |seed| {
        let mut random = Random::new(77 + seed);
        let mut square = || Matrix::<N>::from_row_slice(&random.matrix(N, N).to_f64());
        let (a, b, spin) = (square() * 0.5, square() * 0.5, square());
        let one = Matrix::<N>::identity();
        let rotation = || {
            let w = a - a.transpose();
            (one - w).try_inverse().unwrap() * (one + w)
        };
        let phi = match constraint {
            // Exact: products of triangular matrices of short binary fractions.
            Constraint::Isochoric => {
                (a.lower_triangle() - Matrix::<N>::from_diagonal(&a.diagonal()) + one)
                    * (b.upper_triangle() - Matrix::<N>::from_diagonal(&b.diagonal()) + one)
            }
            Constraint::Rigid => rotation(),
            Constraint::Conformal => rotation() * (1.25 + 0.5 * b[(0, 0)]),
        };
        let skew = (spin - spin.transpose()) * 0.5;
        let mean = one * (spin.trace() / N as f64);
        let spin = match constraint {
            Constraint::Isochoric => spin - mean,
            Constraint::Rigid => skew,
            Constraint::Conformal => skew + mean,
        };
        let mut vector = || Vector::<N>::from_column_slice(&random.matrix(N, 1).to_f64());
        let (x, p) = (vector(), vector());
        Start { x, phi, p: if seed % 2 == 0 { p } else { Vector::<N>::zeros() }, spin }
    })
}

/// The components of a group of the plain array: of a projected momentum those that determine the others.
pub fn assert_components(reference: &Reference, n: usize, name: &str, rate: &[f64], rounding: f64) {
    let (expected, size) = reference.rate(name);
    let independent: Vec<f64> = match (expected.len() == n * n, rate.len()) {
        (true, len) if len == n * n - 1 => expected[..len].to_vec(),
        (true, len) if len < n * n => {
            let mut places: Vec<usize> = (0..n * n).filter(|k| k % n > k / n).collect();
            if len > places.len() {
                places.insert(0, 0);
            }
            places.into_iter().map(|k| expected[k]).collect()
        }
        _ => expected.to_vec(),
    };
    assert_close(name, rate, &independent, size, rounding * reference.condition);
}

/// The listed quantities are those that exist under the constraint, and do not change along the motions.
pub fn assert_listed(
    n: usize,
    constraint: Constraint,
    listed: &[Conserved],
    motions: &[Motion],
    translation: bool,
) {
    let named = |observable| exists(observable, n, translation) && !has_another_name(constraint, observable);
    let brackets = |observable| motions.iter().map(|motion| motion.bracket(observable).unwrap()).collect();
    let listed = listed_as_a_whole(listed, &named, BRACKET_ZERO, &brackets);
    for &observable in Observable::ALL {
        if observable == Observable::Energy {
            assert!(listed.contains(&observable));
            continue;
        }
        let rates = motions.iter().flat_map(|motion| motion.bracket(observable).unwrap().to_f64());
        let largest = rates.fold(0.0, |largest: f64, rate| largest.max(rate.abs()));
        assert!(
            largest <= BRACKET_ZERO || largest > BRACKET_VISIBLE,
            "{observable:?} undecided: {largest:e}"
        );
        assert_eq!(
            listed.contains(&observable),
            named(observable) && largest <= BRACKET_ZERO,
            "{observable:?} listed"
        );
    }
}

/// Is the observable, at the projected momentum, a number or another observable?
pub fn has_another_name(constraint: Constraint, observable: Observable) -> bool {
    use Observable as O;
    let deviators = [O::Deviator, O::ComovingDeviator, O::DeviatorCasimir2, O::DeviatorCasimir3];
    let more: &[Observable] = match constraint {
        Constraint::Isochoric => &[O::Casimir1],
        Constraint::Rigid => {
            &[O::AffineSpin, O::ComovingAffineSpin, O::Casimir1, O::Casimir2, O::Casimir3, O::VorticityNorm]
        }
        Constraint::Conformal => &[O::VorticityNorm],
    };
    deviators.contains(&observable) || more.contains(&observable)
}

/// How far a placement is from the group.
pub fn off_the_group<const N: usize>(constraint: Constraint, point: &(impl Phase<N> + Euclidean)) -> f64 {
    let green = point.phi().tr_mul(point.phi());
    match constraint {
        // ln det phi = n q
        Constraint::Isochoric => point.mean_log_stretch().abs(),
        Constraint::Rigid => (green - Matrix::<N>::identity()).norm(),
        Constraint::Conformal => {
            (green - Matrix::<N>::identity() * (green.trace() / N as f64)).norm() / green.norm()
        }
    }
}

/// No potential.
pub fn none(_place: &Place) -> Differential {
    Differential::constant(0.0)
}

/// The diagonal matrix of halves of these numbers.
pub fn diagonal(entries: &[i64]) -> Exact {
    let n = entries.len();
    (0..n).fold(Exact::zeros(n, n), |sum, a| &sum + &Exact::unit(n, a, a).scaled(&rational(entries[a], 2)))
}
