//! Reference solutions of more digits than a double has.

use affine_runtime::prelude::*;

/// A row of a reference solution.
pub(super) struct Row {
    pub(super) t: f64,
    /// Zero without translation.
    pub(super) x: Vector<3>,
    pub(super) phi: Matrix<3>,
    /// Affine spin, in the frame of the model.
    pub(super) spin: Matrix<3>,
}

/// All rows, the start first: `t`, `x` with translation, `phi`, the affine spin. What is no number is NaN.
pub(super) fn rows(data: &str) -> Vec<Row> {
    data.lines().filter(|line| line.starts_with(|c: char| c.is_ascii_digit())).map(row).collect()
}

fn row(line: &str) -> Row {
    let numbers: Vec<f64> = line.split(',').map(|number| number.parse().unwrap_or(f64::NAN)).collect();
    let at = |index: usize| numbers.get(index).copied().unwrap_or(f64::NAN);
    let moving = numbers.len() > 19;
    let (phi, spin) = (if moving { 4 } else { 1 }, numbers.len().saturating_sub(9));
    let matrix = |from: usize| Matrix::<3>::from_fn(|i, j| at(from + 3 * i + j));
    let x = if moving { Vector::<3>::from_fn(|i, _| at(1 + i)) } else { Vector::<3>::zeros() };
    Row { t: at(0), x, phi: matrix(phi), spin: matrix(spin) }
}
