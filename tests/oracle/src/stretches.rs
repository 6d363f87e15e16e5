//! Stretches with their derivatives, by perturbation of the eigenvalues of `G`.

use crate::differential::Differential;
use crate::potential::Place;

impl Place {
    /// The log-stretches `q_a = ln(l_a)/2`, `l_a` the eigenvalues of `G`, in no order: `dl_a = R_a . dG R_a` with
    /// orthonormal eigenvectors `R_a`. Where stretches coincide this is so only in sums that treat them alike.
    pub fn log_stretches(&self) -> Vec<Differential> {
        let n = self.n() as usize;
        let green = |a: usize, b: usize| self.green(a + 1, b + 1);
        let values: Vec<Vec<f64>> = (0..n).map(|a| (0..n).map(|b| green(a, b).value).collect()).collect();
        eigenvectors(values)
            .into_iter()
            .map(|axis| {
                let pairs = (0..n).flat_map(|a| (0..n).map(move |b| (a, b)));
                let along = pairs.map(|(a, b)| green(a, b) * (axis[a] * axis[b]));
                let eigenvalue = along.fold(Differential::constant(0.0), |sum, term| sum + term);
                eigenvalue.ln() * 0.5
            })
            .collect()
    }

    /// The stretches `Q_a = exp(q_a)`.
    pub fn stretches(&self) -> Vec<Differential> {
        self.log_stretches().into_iter().map(Differential::exp).collect()
    }

    /// `sum over a < b of f(q_a - q_b)`.
    pub fn pairs(&self, f: impl Fn(Differential) -> Differential) -> Differential {
        let q = self.log_stretches();
        let pairs = (0..q.len()).flat_map(|a| (a + 1..q.len()).map(move |b| (a, b)));
        pairs.map(|(a, b)| f(q[a] - q[b])).fold(Differential::constant(0.0), |sum, term| sum + term)
    }
}

/// Orthonormal eigenvectors of a symmetric matrix, by rotations through angles `atan2(2 m_ab, m_bb - m_aa)/2`.
fn eigenvectors(mut matrix: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
    let n = matrix.len();
    let mut axes: Vec<Vec<f64>> = (0..n).map(|a| (0..n).map(|b| f64::from(a == b)).collect()).collect();
    // Quadratic convergence: a dozen sweeps are more than plenty.
    for _ in 0..12 {
        for (a, b) in (0..n).flat_map(|a| (a + 1..n).map(move |b| (a, b))) {
            let (sine, cosine) =
                (0.5 * f64::atan2(2.0 * matrix[a][b], matrix[b][b] - matrix[a][a])).sin_cos();
            let turn = |rows: &mut Vec<Vec<f64>>| {
                for k in 0..n {
                    let (left, right) = (rows[a][k], rows[b][k]);
                    rows[a][k] = cosine * left - sine * right;
                    rows[b][k] = sine * left + cosine * right;
                }
            };
            turn(&mut matrix);
            matrix = (0..n).map(|i| (0..n).map(|j| matrix[j][i]).collect()).collect();
            turn(&mut matrix);
            turn(&mut axes);
        }
    }
    axes
}
