//! Eigenvalues with their errors, and the signs of the energies of their motions.

use nalgebra::{Complex, DMatrix, Schur};

use super::error::AnalysisError;
use super::linear::{Dense, MOST_SWEEPS, decomposed};

/// Iterations from which eigenvalues are found, and by which part of the size of the matrix the next moves them.
const ATTEMPTS: u32 = 8;
const STEP_ASIDE: f64 = 0.137;

/// An error bound is so many times the first-order estimate.
const SAFETY: f64 = 10.0;
/// Parts of the largest eigenvalue of a form below which one is zero.
const ZERO: f64 = 1e-11;

/// An eigenvalue of the linearised motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Eigenvalue {
    /// Its value: `exp(value t)`.
    pub value: Complex<f64>,
    /// A bound of its error by rounding.
    pub error: f64,
    /// The sign of the energy of its motions, 1 or -1, where it is imaginary and the motion is Hamiltonian; 0 elsewhere.
    pub sign: i8,
    /// Equal eigenvalues, of which this is one, have energies of both signs.
    pub(super) is_mixed: bool,
}

impl Eigenvalue {
    /// Its real part, which is zero below its error.
    pub(super) fn rate(self) -> f64 {
        if self.value.re.abs() <= self.error { 0.0 } else { self.value.re }
    }
}

/// The eigenvalues of a motion, by imaginary part.
pub(super) fn spectrum(motion: &Dense, energy: Option<&Dense>) -> Result<Vec<Eigenvalue>, AnalysisError> {
    if motion.is_empty() {
        return Ok(Vec::new());
    }
    // Eigenvalues of one size, as of vibrations, may keep iterations from their end, and others, by which all are moved, do not.
    let moved = |attempt: u32| {
        let by = f64::from(attempt) * STEP_ASIDE * motion.norm();
        let matrix = motion + Dense::from_diagonal_element(motion.nrows(), motion.ncols(), by);
        let schur = Schur::try_new(matrix, f64::EPSILON, MOST_SWEEPS)?;
        let values = schur.complex_eigenvalues().iter().map(|value| value - by).collect();
        Some((values, motion.norm() + by))
    };
    let found: Option<(Vec<Complex<f64>>, f64)> = (0..ATTEMPTS).find_map(moved);
    let (values, size) = found.ok_or(AnalysisError::NoDecomposition)?;
    let errors: Vec<f64> = values.iter().map(|value| error(motion, *value, size)).collect();
    let mut all: Vec<Eigenvalue> = (0..values.len())
        .map(|k| {
            let (value, error) = (values[k], errors[k]);
            let alike =
                (0..values.len()).filter(|j| (values[*j] - value).norm() <= 2.0 * (error + errors[*j]));
            let (sign, is_mixed) = match energy {
                Some(energy) if value.re.abs() <= error => signed(motion, energy, value, alike.count()),
                _ => (0, false),
            };
            Eigenvalue { value, error, sign, is_mixed }
        })
        .collect();
    all.sort_by(|a, b| a.value.im.total_cmp(&b.value.im).then(a.value.re.total_cmp(&b.value.re)));
    Ok(all)
}

fn shifted(motion: &Dense, value: Complex<f64>) -> DMatrix<Complex<f64>> {
    let complex = motion.map(|entry| Complex::new(entry, 0.0));
    complex - DMatrix::from_diagonal_element(motion.nrows(), motion.nrows(), value)
}

/// `eps |A|/|y^* x|` of the unit eigenvectors, of a cluster the cosine between what it is mapped from and to.
fn error(motion: &Dense, value: Complex<f64>, size: f64) -> f64 {
    let Some(svd) = decomposed(shifted(motion, value)) else { return f64::INFINITY };
    let (Some(u), Some(v_t)) = (&svd.u, &svd.v_t) else { return f64::INFINITY };
    let null: Vec<usize> =
        (0..svd.singular_values.len()).filter(|k| svd.singular_values[*k] <= 1e-9 * size).collect();
    if null.is_empty() {
        return SAFETY * svd.singular_values.min();
    }
    let overlap =
        DMatrix::from_fn(null.len(), null.len(), |a, b| u.column(null[a]).dotc(&v_t.row(null[b]).adjoint()));
    let cosine = overlap.svd(false, false).singular_values.min();
    // A Jordan block: the square root of a rounding.
    SAFETY * size * (f64::EPSILON / cosine).min(f64::EPSILON.sqrt())
}

/// The sign of `v^* E v` of an eigenspace, and whether it has both.
fn signed(motion: &Dense, energy: &Dense, value: Complex<f64>, multiplicity: usize) -> (i8, bool) {
    let Some(svd) = decomposed(shifted(motion, Complex::new(0.0, value.im))) else { return (0, true) };
    let Some(v_t) = &svd.v_t else { return (0, true) };
    let rows = v_t.nrows();
    let mut order: Vec<usize> = (0..rows).collect();
    order.sort_by(|a, b| svd.singular_values[*a].total_cmp(&svd.singular_values[*b]));
    let chosen: Vec<_> = order.iter().take(multiplicity).map(|k| v_t.row(*k).adjoint()).collect();
    let vectors = DMatrix::from_columns(&chosen);
    let complex = energy.map(|entry| Complex::new(entry, 0.0));
    let form = vectors.adjoint() * complex * &vectors;
    let values = form.symmetric_eigenvalues();
    let threshold = ZERO * energy.norm();
    match (values.iter().any(|one| *one > threshold), values.iter().any(|one| *one < -threshold)) {
        (true, false) => (1, false),
        (false, true) => (-1, false),
        _ => (0, true),
    }
}

/// The eigenvalues of a form, from the least.
pub(super) fn principal(form: &Dense) -> Vec<f64> {
    if form.is_empty() {
        return Vec::new();
    }
    let mut values: Vec<f64> = form.symmetric_eigenvalues().iter().copied().collect();
    values.sort_by(f64::total_cmp);
    values
}

/// Numbers of positive, negative and zero eigenvalues of a form.
pub(super) fn signs(form: &Dense) -> (usize, usize, usize) {
    let values = principal(form);
    let threshold = ZERO * values.iter().fold(0.0, |largest: f64, value| largest.max(value.abs()));
    let positive = values.iter().filter(|value| **value > threshold).count();
    let negative = values.iter().filter(|value| **value < -threshold).count();
    (positive, negative, values.len() - positive - negative)
}
