//! Matrices beside random metrics in numbers: forms are carried to bases that are irrational, and the velocities that
//! programs compute there are those of the exact mass matrix in the given ones.

use affine_codegen::algebra::Rational as Number;
use affine_codegen::derive::{ChangeOfBases, Model};
use affine_codegen::mechanics::metrics::{Axes, root_of_product};
use affine_codegen::symbol::{Quantity, Symbol};
use affine_oracle::{Kinetic, Matrix, Random, Term, rational};

use super::models::{derived, matrix_literal};

type Rows = Vec<Vec<Number>>;

/// Roots are correct to 159 bits, and a mass matrix of condition below 1e6 takes some of these.
const ROUNDING: f64 = 1e-38;

fn number(exact: &affine_oracle::Rational) -> Number {
    Number::quotient(exact.numer().clone(), exact.denom().clone()).unwrap()
}

fn rows(matrix: &Matrix) -> Rows {
    let (n, m) = matrix.shape();
    (0..n).map(|i| (0..m).map(|j| number(&matrix.entry(i, j))).collect()).collect()
}

fn product(a: &Rows, b: &Rows) -> Rows {
    let dot =
        |row: &Vec<Number>, j: usize| row.iter().zip(b).fold(Number::ZERO, |sum, (a, b)| &sum + &(a * &b[j]));
    a.iter().map(|row| (0..b[0].len()).map(|j| dot(row, j)).collect()).collect()
}

/// `K[(A,B),(C,D)] = left[A,C] right[B,D]`.
fn tensor_product(n: usize, left: &Matrix, right: &Matrix) -> Matrix {
    let pairs = || (0..n * n).map(|k| (k / n, k % n));
    let entries: Vec<_> = pairs()
        .flat_map(|(a, b)| pairs().map(move |(c, d)| (a, b, c, d)))
        .map(|(a, b, c, d)| left.entry(a, c) * right.entry(b, d))
        .collect();
    Matrix::from_rationals(n * n, n * n, &entries)
}

/// The velocity that the model's program gives for a momentum in orthonormal bases.
fn velocity(model: &Model, spin: Quantity, momentum: &Rows) -> Rows {
    let input = |symbol: &Symbol| match symbol {
        Symbol::Component(own, places) if *own == spin => {
            Some(momentum[places[0] - 1][places[1] - 1].clone())
        }
        _ => None,
    };
    let results = model.point.velocity.run(&input).unwrap();
    results.chunks(model.dim).map(<[Number]>::to_vec).collect()
}

#[test]
fn velocities_beside_random_metrics() {
    for (n, seeds) in [(2, 0..4), (3, 4..6)] {
        for seed in seeds {
            for kind in
                ["body_inertia", "space_inertia", "dalembert", "body_tensor", "space_tensor", "flat_tensor"]
            {
                let mut random = Random::new(6011 + seed);
                let (g, eta) = (random.inertia(n), random.inertia(n));
                let given = if kind.ends_with("tensor") { random.tensor(n) } else { random.inertia(n) };
                let flat = matches!(kind, "dalembert" | "flat_tensor");
                let casimir2 = if flat { "" } else { ", casimir2 = 1/8" };
                let model = derived(
                    &format!(
                        "dim = {n}, metrics(space = {}, body = {}), kinetic({kind} = {}{casimir2})",
                        matrix_literal(&g),
                        matrix_literal(&eta),
                        matrix_literal(&given)
                    ),
                    "struct Model;",
                );
                let mut terms = vec![match kind {
                    "body_inertia" => Term::BodyTensor(tensor_product(n, &eta, &given)),
                    "space_inertia" => Term::SpaceTensor(tensor_product(n, &g, &given)),
                    "dalembert" => Term::FlatTensor(tensor_product(n, &g, &given)),
                    "body_tensor" => Term::BodyTensor(given),
                    "space_tensor" => Term::SpaceTensor(given),
                    _ => Term::FlatTensor(given),
                }];
                if !flat {
                    terms.push(Term::Casimir2(rational(1, 8)));
                }
                let kinetic = Kinetic::new(n, terms).unwrap();
                let state = random.state(n).at_rest();
                let phi_dot = kinetic.velocity(&state).unwrap().1;
                let Some(ChangeOfBases::Known(bases)) = &model.metrics else { panic!("metrics are known") };
                let (a, b) = (&bases.space, &bases.body);
                let inverse = state.phi.inverse().unwrap();
                // Momentum and velocity in the frame of the energy, and the factors that carry each.
                let ((spin, momentum, outer), (velocity_of, factors)) = match kind {
                    "body_inertia" | "body_tensor" => (
                        (Quantity::ComovingAffineSpin, &state.pi * &state.phi, (&b.matrix, &b.inverse)),
                        (&inverse * &phi_dot, (&b.matrix, &b.inverse)),
                    ),
                    "space_inertia" | "space_tensor" => (
                        (Quantity::AffineSpin, &state.phi * &state.pi, (&a.matrix, &a.inverse)),
                        (&phi_dot * &inverse, (&a.matrix, &a.inverse)),
                    ),
                    _ => (
                        (Quantity::CanonicalMomentum, state.pi.clone(), (&b.matrix, &a.inverse)),
                        (phi_dot.clone(), (&a.matrix, &b.inverse)),
                    ),
                };
                let carried = |(left, right): (&Rows, &Rows), matrix: &Matrix| {
                    product(&product(left, &rows(matrix)), right)
                };
                let found = velocity(&model, spin, &carried(outer, &momentum));
                let expected = carried(factors, &velocity_of);
                let size = expected.concat().iter().fold(1.0_f64, |size, e| size.max(e.to_doubles().0.abs()));
                for (found, expected) in found.concat().iter().zip(expected.concat()) {
                    let error = (found - &expected).to_doubles().0.abs();
                    assert!(error <= ROUNDING * size, "{kind} in dimension {n}, seed {seed}: {error:e}");
                }
            }
        }
    }
}

/// `U^T diag(d) U` is the metric, exactly.
#[test]
fn rational_axes() {
    for seed in 0..16 {
        for n in [2, 3] {
            let metric = rows(&Random::new(823 + seed).inertia(n));
            let axes = Axes::of(&metric).unwrap();
            let transposed: Rows =
                (0..n).map(|i| (0..n).map(|j| axes.matrix[j][i].clone()).collect()).collect();
            let scaled: Rows = axes
                .matrix
                .iter()
                .zip(&axes.squares)
                .map(|(row, d)| row.iter().map(|e| e * d).collect())
                .collect();
            assert_eq!(product(&transposed, &scaled), metric);
            let unit = product(&axes.matrix, &axes.inverse);
            let identity: Rows = (0..n)
                .map(|i| (0..n).map(|j| if i == j { Number::ONE } else { Number::ZERO }).collect())
                .collect();
            assert_eq!(unit, identity);
        }
    }
    let negative = vec![vec![Number::ONE, Number::from(2)], vec![Number::from(2), Number::ONE]];
    assert!(Axes::of(&negative).is_none());
}

/// Rational roots are exact, and equal roots equal numbers: `sqrt(2) sqrt(8) = 4`, `sqrt(8) = 2 sqrt(2)`,
/// `sqrt(2/3)/sqrt(3) = sqrt(2)/3`.
#[test]
fn roots_of_products() {
    let [two, three, eight] = [2, 3, 8].map(Number::from);
    let root = |squares: &[&Number], exponents: &[i32]| root_of_product(squares, exponents).unwrap();
    assert_eq!(root(&[&two, &eight], &[1, 1]), Number::from(4));
    assert_eq!(root(&[&two, &eight], &[0, 1]), &Number::from(2) * &root(&[&two], &[1]));
    let third = Number::ratio(1, 3).unwrap();
    assert_eq!(root(&[&two, &three, &three], &[1, -1, -1]), &third * &root(&[&two], &[1]));
    let error = &(&root(&[&two], &[1]) * &root(&[&two], &[1])) - &two;
    assert!(!error.is_zero() && error.to_doubles().0.abs() < 1e-47);
}
