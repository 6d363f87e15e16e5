//! Flow matrices, exponents, periodic orbits and sensitivities.

use affine_runtime::analysis::{FlowMatrix, Sensitivities, lyapunov_spectrum};
use affine_runtime::model::Model;
use affine_runtime::nalgebra::{Complex, DMatrix};
use affine_runtime::prelude::*;

use super::{Row, assert_near};
use crate::models::{Disc, Flat, Left, Vibrating};

/// Invariant from both sides.
#[affine_model(dim = 2, kinetic(casimir2 = 1.2, casimir1_squared = 0.1))]
struct Invariant;
#[affine_model(dim = 3, kinetic(casimir2 = 1.2, casimir1_squared = 0.1))]
struct InvariantInSpace;

/// Rows that repel, and rows that attract.
#[affine_model(
    dim = 2,
    kinetic(dalembert = j),
    potential = k1/2*(phi[1,1]^2 + phi[1,2]^2) + k2/2*(phi[2,1]^2 + phi[2,2]^2)
)]
struct Saddle {
    j: f64,
    k1: f64,
    k2: f64,
}

pub(super) fn assert_row(row: &Row) {
    match row.text("kind") {
        "flow matrix" => assert_flow(row),
        "Lyapunov spectrum" if row.has("exponents") => assert_exponents(row),
        "Lyapunov spectrum" if row.numbers("parameters/X").len() == 2 => {
            let x = Matrix::<2>::from_diagonal(&row.array("parameters/X").into());
            let start = Invariant.at_velocity(Matrix::<2>::identity(), x).unwrap();
            assert_expansion(&Invariant, &start, row);
        }
        "Lyapunov spectrum" => {
            let x = Matrix::<3>::from_diagonal(&row.array("parameters/X").into());
            let start = InvariantInSpace.at_velocity(Matrix::<3>::identity(), x).unwrap();
            assert_expansion(&InvariantInSpace, &start, row);
        }
        "periodic orbit" if row.count("n") == 2 => {
            let start = Matrix::<2>::identity() * row.parameter("q0").exp();
            assert_orbit(&Flat, &Flat.at_velocity(start, Matrix::<2>::zeros()).unwrap(), row);
        }
        "periodic orbit" => {
            let start = Matrix::<3>::identity() * row.parameter("q0").exp();
            assert_orbit(&Vibrating, &Vibrating.at_velocity(start, Matrix::<3>::zeros()).unwrap(), row);
        }
        "periodic orbit, Hill" => assert_bar_mode(row),
        "sensitivity" => assert_sensitivity(row),
        other => panic!("no kind {other}"),
    }
}

/// The left-invariant geodesic of a row.
fn left(row: &Row) -> Left {
    let [i, a, b] = ["I", "A", "B"].map(|name| row.parameter(name));
    Left { i, a, b }
}

/// `d(phi, Pi)/d(phi, Sigma_hat)` at a point, row by row: `Pi = Sigma_hat phi^-1`.
fn canonical<const N: usize>(phi: &Matrix<N>, sigma_hat: &Matrix<N>) -> DMatrix<f64> {
    let (half, inverse) = (N * N, phi.try_inverse().unwrap());
    let mut slopes = DMatrix::identity(2 * half, 2 * half);
    for k in 0..half {
        let unit = Matrix::<N>::from_fn(|i, a| f64::from(u8::from(i * N + a == k)));
        let (by_spin, by_phi) = (unit * inverse, -(sigma_hat * inverse * unit * inverse));
        for row in 0..half {
            slopes[(half + row, half + k)] = by_spin[(row / N, row % N)];
            slopes[(half + row, k)] = by_phi[(row / N, row % N)];
        }
    }
    slopes
}

fn row_of(matrix: &DMatrix<f64>, k: usize) -> Vec<f64> {
    matrix.row(k).iter().copied().collect()
}

fn assert_flow(row: &Row) {
    let model = left(row).prepare().unwrap();
    let (phi, spin) = (row.matrix::<3>("parameters/phi0"), row.matrix::<3>("parameters/Sigma_hat0"));
    let start = model.at_momentum(phi, Comoving(spin)).unwrap();
    let mut flow = FlowMatrix::new(&model, (0.0, &start), 1e-13);
    flow.advance_to(row.parameter("t")).unwrap();
    let matrix = flow.matrix();
    let of = |layout: &str, name: &str| row.number(&format!("{layout}/{name}"));
    let own = "layout_phi_Sigma_hat";
    let found = [matrix.trace(), matrix.norm(), matrix.determinant()];
    assert_near(&found, &["trace", "frobenius", "determinant"].map(|name| of(own, name)), 1e-11);
    assert_near(&row_of(&matrix, 0), &row.numbers("layout_phi_Sigma_hat/first_row"), 1e-11);
    assert_near(&row_of(&matrix, 17), &row.numbers("layout_phi_Sigma_hat/last_row"), 1e-11);
    assert!(flow.defect() < 1e-12, "{}", flow.defect());
    let end = flow.point();
    let after = canonical(end.phi(), &end.sigma_hat().0.0);
    let matrix = after * matrix * canonical(&phi, &spin).try_inverse().unwrap();
    assert_near(
        &[matrix.trace(), matrix.norm()],
        &["trace", "frobenius"].map(|one| of("canonical", one)),
        1e-11,
    );
    assert_near(&row_of(&matrix, 0), &row.numbers("canonical/first_row"), 1e-11);
    // And back.
    flow.advance_to(0.0).unwrap();
    assert!(flow.matrix().is_identity(1e-10));
}

/// `+-sqrt(-k_i/j)`, and zeros for the row that oscillates.
fn assert_exponents(row: &Row) {
    let [k1, k2] = row.array("parameters/k");
    let j = row.parameter("j");
    let model = Saddle { j, k1, k2 }.prepare().unwrap();
    // On the stable directions, so that the motion stays small.
    let falls = Matrix::<2>::new(-(-k1 / j).sqrt(), 0.0, 0.0, 0.0);
    let start = model.at_velocity(Matrix::<2>::identity(), falls).unwrap();
    let spectrum = lyapunov_spectrum(&model, &start, 24.0, 1e-9).unwrap();
    for (k, known) in row.numbers("exponents").into_iter().rev().enumerate() {
        let off = (spectrum.exponents[k] - known).abs();
        assert!(off <= spectrum.errors[k] && off < 0.1, "{spectrum:?}");
    }
}

/// `phi = exp(X t)`, `X = diag(x)`: exponents in three layouts, for the motion goes to infinity.
fn assert_expansion<const N: usize, M: Model<N>>(model: &M, start: &M::Point<f64>, row: &Row) {
    let x = row.numbers("parameters/X");
    let logarithms = |time: f64| {
        let mut flow = FlowMatrix::new(model, (0.0, start), 1e-13);
        flow.advance_to(time).unwrap();
        let (matrix, point) = (flow.matrix(), flow.point());
        let of = |matrix: DMatrix<f64>| {
            let mut values: Vec<f64> = matrix.singular_values().iter().map(|one| one.ln()).collect();
            values.sort_by(|a, b| b.total_cmp(a));
            // The others are their negatives, and below rounding.
            values.truncate(N * N);
            values
        };
        let after = canonical(point.phi(), &point.sigma_hat().0.0);
        let before = canonical(start.phi(), &start.sigma_hat().0.0).try_inverse().unwrap();
        let mut in_body = DMatrix::<f64>::identity(2 * N * N, 2 * N * N);
        let inverse = point.phi().try_inverse().unwrap();
        for (i, j, a) in (0..N * N * N).map(|k| (k / (N * N), k / N % N, k % N)) {
            in_body[(i * N + a, j * N + a)] = inverse[(i, j)];
        }
        [of(&after * &matrix * before), of(in_body * &matrix)]
    };
    let (first, second) = (logarithms(12.0), logarithms(24.0));
    for (k, name) in ["canonical", "left_trivialised"].into_iter().enumerate() {
        let slopes: Vec<f64> = second[k].iter().zip(&first[k]).map(|(b, a)| (b - a) / 12.0).collect();
        let known: Vec<f64> = row.numbers(name).into_iter().rev().take(N * N).collect();
        // Secular factors of such a time.
        assert_near(&slopes, &known, 2.0 * 2.0_f64.ln() / 12.0);
    }
    // By its plain array: `dphi_ab` grows like column `b` does, and follows `dSigma_hat_ab` like the longer of two.
    let mut known: Vec<f64> = (0..N * N)
        .flat_map(|k| {
            let top = x[k / N].max(x[k % N]).max(0.0);
            [top, x[k % N] - top]
        })
        .collect();
    known.sort_by(|a, b| b.total_cmp(a));
    let spectrum = lyapunov_spectrum(model, start, 60.0, 1e-9).unwrap();
    for (k, known) in known.into_iter().enumerate() {
        let off = (spectrum.exponents[k] - known).abs();
        assert!(off <= spectrum.errors[k] && off < 0.1, "{known} {spectrum:?}");
    }
}

/// Back at its start after a period, with the multipliers of all directions.
fn assert_orbit<const N: usize, M: Model<N>>(model: &M, start: &M::Point<f64>, row: &Row) {
    let mut flow = FlowMatrix::new(model, (0.0, start), 1e-13);
    flow.advance_to(row.number("period")).unwrap();
    assert!((flow.point().phi() - start.phi()).norm() < 1e-11);
    let matrix = flow.matrix();
    let multipliers = matrix.complex_eigenvalues();
    let near = |known: Complex<f64>, distance: f64| {
        multipliers.iter().filter(|one| (*one - known).norm() < distance).count()
    };
    for k in 0..2 {
        let [re, im] = ["re", "im"].map(|part| row.number(&format!("shear_multipliers/{k}/{part}")));
        assert_eq!(near(Complex::new(re, im), 1e-10), row.count("shear_multiplicity"), "{multipliers}");
    }
    // Pairs of Jordan's: the square root of a rounding.
    assert_eq!(near(Complex::new(1.0, 0.0), 1e-5), row.count("ones"), "{multipliers}");
    // What is larger by `dq0` is late by `dT`.
    let z = model.flatten(start);
    let half = N * N;
    let larger = DMatrix::from_fn(2 * half, 1, |k, _| if k < half { z.as_ref()[k] } else { 0.0 });
    let late = &larger - matrix * &larger;
    let rates = DMatrix::from_column_slice(2 * half, 1, model.hamilton_equations(0.0, &z).as_ref());
    let by_amplitude = late.dot(&rates) / rates.norm_squared();
    assert!((by_amplitude - row.number("dT_dq0")).abs() < 1e-10, "{by_amplitude}");
}

/// A disc that breathes drives its bar mode.
fn assert_bar_mode(row: &Row) {
    let [i, kappa, c1, g] = ["I", "kappa", "c1", "g"].map(|name| row.parameter(name));
    let disc = Disc { i, kappa, c1 }.prepare().unwrap();
    let start = disc.at_velocity(Matrix::<2>::identity() * (g / 2.0).exp(), Matrix::<2>::zeros()).unwrap();
    let mut flow = FlowMatrix::new(&disc, (0.0, &start), 1e-13);
    flow.advance_to(row.number("period")).unwrap();
    assert!((flow.point().phi() - start.phi()).norm() < 1e-11);
    let trace = row.number("bar_monodromy_trace");
    assert_eq!(trace.abs() < 2.0, row.text("stability") == "linearly stable");
    let root = Complex::new(trace * trace / 4.0 - 1.0, 0.0).sqrt();
    let multipliers = flow.matrix().complex_eigenvalues();
    for known in [root + trace / 2.0, -root + trace / 2.0] {
        let count = multipliers.iter().filter(|one| (*one - known).norm() < 1e-9).count();
        assert_eq!(count, 2, "{known} of {multipliers}");
    }
}

/// By the coefficients of a geodesic, with its momentum held, and with its velocity.
fn assert_sensitivity(row: &Row) {
    let fields = left(row);
    let model = fields.prepare().unwrap();
    let (phi, rate) = (row.matrix::<3>("parameters/phi0"), row.matrix::<3>("parameters/phi0^-1 phi_dot0"));
    let start = model.at_velocity(phi, phi * rate).unwrap();
    let moved = Sensitivities::of(&fields, &model, (0.0, &start), row.parameter("t"), 1e-13).unwrap();
    let run = Simulation::new(&model, start).until(row.parameter("t")).tolerance(1e-13).run().unwrap();
    assert!((run.end().1.phi() - row.matrix::<3>("phi")).norm() < 1e-11);
    for (k, by) in ["d_dI", "d_dA", "d_dB"].into_iter().enumerate() {
        for (held, found) in
            [("fixed_Sigma_hat0", &moved.by_fields), ("fixed_phi_dot0", &moved.by_fields_at_velocity)]
        {
            let known = row.matrix::<3>(&format!("{by}/{held}")).transpose();
            assert_near(&found.column(k).as_slice()[..9], known.as_slice(), 1e-11);
        }
    }
}
