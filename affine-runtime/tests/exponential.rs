//! The matrix exponential against 60-digit values, and the rotations against the exponential.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use affine_runtime::decompose::LinearMap;
use affine_runtime::frames::Matrix;
use affine_runtime::scalar::Real;

/// Tolerances, in units of `eps` of the scalar.
mod tolerance {
    /// Relative error of `exp(A)` over `1 + kappa`: the promise of `exponential`. One unit is half a rounding
    /// of every entry of `A`, twice over.
    pub(crate) const EXPONENTIAL: f64 = 4.0;
    /// The same for rotations: angle, sine, cosine and axis are each rounded once or twice.
    pub(crate) const ROTATION: f64 = 2.0;
    /// Largest entry of `R^T R - 1`: three products, each of entries with two or three roundings.
    pub(crate) const ORTHOGONALITY: f64 = 8.0;
    /// A product of two `n` by `n` matrices, relative to the product of their norms, over `n`.
    pub(crate) const PRODUCT: f64 = 1.0;
}

/// A row of the data file.
struct Case {
    kind: String,
    kappa: f64,
    kappa_of_minus: f64,
    matrix: Vec<f64>,
    high: Vec<f64>,
    low: Vec<f64>,
}

/// Numbers of rows of `n = 2` and `n = 3`.
const CASES: [usize; 2] = [146, 148];

fn cases(n: usize) -> Vec<Case> {
    let rows = include_str!("data/exponential.csv").lines().filter(|line| !line.starts_with('#'));
    let cases: Vec<Case> = rows
        .map(|row| row.split(',').collect::<Vec<_>>())
        .filter(|fields| fields[0] == n.to_string())
        .map(|fields| {
            let numbers: Vec<f64> = fields[2..].iter().map(|field| field.parse().unwrap()).collect();
            assert_eq!(numbers.len(), 2 + 3 * n * n);
            let matrix = |k: usize| numbers[2 + k * n * n..2 + (k + 1) * n * n].to_vec();
            Case {
                kind: fields[1].to_string(),
                kappa: numbers[0],
                kappa_of_minus: numbers[1],
                matrix: matrix(0),
                high: matrix(1),
                low: matrix(2),
            }
        })
        .collect();
    assert_eq!(cases.len(), CASES[n - 2], "the data file was cut");
    cases
}

fn matrix<const N: usize>(entries: &[f64]) -> Matrix<N> {
    Matrix::from_row_slice(entries)
}

/// Relative error in the Frobenius norm, without under- or overflow of the squares.
fn relative_error<const N: usize>(computed: &Matrix<N>, case: &Case) -> f64 {
    let (high, low) = (matrix::<N>(&case.high), matrix::<N>(&case.low));
    let size = high.amax();
    ((computed - high - low) / size).norm() / (high / size).norm()
}

fn assert_bound<const N: usize>() {
    let mut worst = (0.0, String::new());
    for case in cases(N) {
        let a = matrix::<N>(&case.matrix);
        let error = relative_error(&a.exponential(), &case);
        let ratio = error / (f64::EPSILON * (1.0 + case.kappa));
        assert!(ratio <= tolerance::EXPONENTIAL, "{}, norm {:e}: ratio {ratio}", case.kind, a.norm());
        if ratio > worst.0 {
            worst = (ratio, format!("{}, norm {:.1e}", case.kind, a.norm()));
        }
    }
    println!("n = {N}: worst error/(eps (1 + kappa)) = {:.3} ({})", worst.0, worst.1);
}

#[test]
fn meets_the_bound_on_every_plane_case() {
    assert_bound::<2>();
}

#[test]
fn meets_the_bound_on_every_spatial_case() {
    assert_bound::<3>();
}

/// `exp(A) exp(-A) = 1` within the bounds of both factors; where these exceed 1e-3 the product says nothing,
/// and the number of cases left is pinned.
fn assert_inverse<const N: usize>(expected: usize) {
    let mut checked = 0;
    for case in cases(N) {
        let a = matrix::<N>(&case.matrix);
        let (forth, back) = (a.exponential(), (-a).exponential());
        let relative =
            tolerance::EXPONENTIAL * (2.0 + case.kappa + case.kappa_of_minus) + tolerance::PRODUCT * N as f64;
        let bound = f64::EPSILON * relative * forth.norm() * back.norm();
        if bound < 1e-3 {
            let defect = (forth * back - Matrix::<N>::identity()).norm();
            assert!(defect <= bound, "{}, norm {:e}: {defect:e} > {bound:e}", case.kind, a.norm());
            checked += 1;
        }
    }
    assert_eq!(checked, expected);
}

#[test]
fn exponentials_of_a_matrix_and_its_negative_are_inverse() {
    assert_inverse::<2>(133);
    assert_inverse::<3>(128);
}

fn assert_orthogonal<const N: usize, T: Real>(rotation: &Matrix<N, T>) {
    let r: Matrix<N> = rotation.map(Real::to_f64);
    let defect = (r.tr_mul(&r) - Matrix::<N>::identity()).amax();
    assert!(defect <= tolerance::ORTHOGONALITY * T::EPSILON.to_f64(), "{r}: {defect:e}");
}

fn assert_rotations<const N: usize>() {
    let mut worst = 0.0_f64;
    for case in cases(N).iter().filter(|case| case.kind == "skew") {
        let w = matrix::<N>(&case.matrix);
        let rotation = w.skew_exponential();
        assert_orthogonal(&rotation);
        worst = worst.max(relative_error(&rotation, case) / (f64::EPSILON * (1.0 + case.kappa)));

        let single = w.map(|v| v as f32);
        let rotation = single.skew_exponential();
        assert_orthogonal(&rotation);
        let reference = single.map(f64::from).exponential();
        let error = (rotation.map(f64::from) - reference).norm() / reference.norm();
        let ratio = error / (f64::from(f32::EPSILON) * (1.0 + case.kappa));
        assert!(ratio <= tolerance::ROTATION, "single precision, angle {}: {ratio}", w.norm());
    }
    println!("n = {N}: worst error of a rotation/(eps (1 + kappa)) = {worst:.3}");
    assert!(worst > 0.0 && worst <= tolerance::ROTATION);
}

#[test]
fn rotations_agree_with_the_exponential() {
    assert_rotations::<2>();
    assert_rotations::<3>();
}

#[test]
fn rotations_are_orthogonal_at_every_angle() {
    let axes = [[1.0, 0.0, 0.0], [0.6, -0.48, 0.64], [1e-9, 1.0, -1e-5], [-0.1, 0.2, 0.3]];
    for exponent in (-320..=15).step_by(5) {
        let angle = 10.0_f64.powi(exponent);
        for [x, y, z] in axes.map(|axis| axis.map(|component| component * angle)) {
            let skew = Matrix::<3>::new(0.0, -z, y, z, 0.0, -x, -y, x, 0.0);
            let rotation = skew.skew_exponential();
            assert_orthogonal(&rotation);
            if angle < 1e-3 {
                // exp(W) = 1 + W + W^2/2 + O(w^3)
                let rest = rotation - Matrix::<3>::identity() - skew - skew * skew * 0.5;
                assert!(rest.amax() <= angle.powi(3) + f64::EPSILON, "angle {angle:e}: {rest}");
                // Odd part: W - O(w^3), to relative accuracy.
                let odd = (rotation - rotation.transpose()) * 0.5 - skew;
                assert!(odd.amax() <= angle.powi(3) + 4.0 * f64::EPSILON * angle, "angle {angle:e}: {odd}");
            }
        }
        assert_orthogonal(&Matrix::<2>::new(0.0, -angle, angle, 0.0).skew_exponential());
    }
    assert_eq!(Matrix::<3>::zeros().skew_exponential(), Matrix::<3>::identity());
    assert_eq!(Matrix::<2, f32>::zeros().skew_exponential(), Matrix::<2, f32>::identity());
}

#[test]
fn exact_values_are_exact() {
    assert_eq!(Matrix::<3>::zeros().exponential(), Matrix::<3>::identity());
    // Nilpotent: exp(A) = 1 + A, far beyond the norms of the data file as well.
    for size in [1e-300, 1.0, 700.0, 1e100] {
        let shear = Matrix::<2>::new(0.0, size, 0.0, 0.0);
        assert_eq!(shear.exponential(), Matrix::<2>::identity() + shear);
    }
}

#[test]
fn overflow_is_infinite_and_underflow_is_zero() {
    let inf = f64::INFINITY;
    assert_eq!(Matrix::<2>::new(800.0, 1.0, 0.0, 800.0).exponential(), Matrix::<2>::new(inf, inf, 0.0, inf));
    assert_eq!(Matrix::<2>::new(800.0, -1.0, 0.0, 700.0).exponential()[(0, 1)], -inf);
    assert_eq!(Matrix::<2>::from_diagonal_element(-1e4).exponential(), Matrix::<2>::zeros());
    // The mean underflows and the deviator overflows; their product does neither.
    let decay = Matrix::<2>::new(-4000.0, 0.0, 0.0, 0.0).exponential() - Matrix::<2>::new(0.0, 0.0, 0.0, 1.0);
    assert!(decay.amax() <= tolerance::EXPONENTIAL * f64::EPSILON * 4001.0, "{decay}");
    let wild = Matrix::<3>::new(1e3, 2e3, 5e2, -3e2, 4e3, 1e2, 7e2, -1e3, 2e3).exponential();
    assert!(wild.iter().all(|v| v.is_infinite()), "{wild}");
}

#[test]
fn what_is_not_finite_gives_nan() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for place in 0..9 {
            let mut matrix = Matrix::<3>::new(1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0);
            matrix[place] = bad;
            assert!(matrix.exponential().iter().all(|v| v.is_nan()));
        }
    }
}
