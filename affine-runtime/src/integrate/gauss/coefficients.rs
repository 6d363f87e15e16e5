//! Coefficients of the Gauss collocation methods (Kuntzmann-Butcher) of 2 and 3 stages.
//!
//! Source: E. Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration, 2nd edition, Springer 2006, section
//! II.1.3, table 1.1. What is stored is not `a_ij` but `mu_ij = a_ij/b_j`, whose condition of symplecticity
//! `mu_ij + mu_ji = 1` doubles fulfil exactly (M. Antonana, J. Makazaga, A. Murua, Numer. Algorithms 76 (2017)
//! 861-880): rounded `a_ij` would make quadratic invariants drift.

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod order_conditions;

/// The most stages there are.
pub(super) const MOST_STAGES: usize = 3;

/// A complex number, real part first.
pub(super) type Pair = (f64, f64);

/// A Gauss collocation method: [`Tableau::TWO`] or [`Tableau::THREE`].
///
/// ```text
/// L_i = h b_i f(t + c_i h, y + sum_j mu_ij L_j),    y_1 = y + sum_i L_i,    mu_ij = a_ij/b_j
/// ```
#[derive(Debug, PartialEq)]
pub struct Tableau {
    pub(super) nodes: &'static [f64],
    pub(super) weights: &'static [f64],
    pub(super) ratios: [[f64; MOST_STAGES]; MOST_STAGES],
    pub(super) modes: &'static [Mode],
}

/// An eigenvalue `lambda` of the matrix `b_i a_ij/b_j`, with eigenvectors such that the matrix is
/// `sum_modes Re(right_i lambda left_j)` and the identity `sum_modes Re(right_i left_j)`: of a conjugate pair one
/// stands for both.
#[derive(Debug, PartialEq)]
pub(super) struct Mode {
    pub(super) eigenvalue: Pair,
    pub(super) right: [Pair; MOST_STAGES],
    pub(super) left: [Pair; MOST_STAGES],
}

/// `mu_21` of two stages, `1/2 + sqrt(3)/3`.
const TWO_21: f64 = 1.077_350_269_189_625_8;
/// `mu_21 = mu_32` of three stages, `1/2 + 3 sqrt(15)/20`.
const THREE_21: f64 = 1.080_947_501_931_112_5;
/// `mu_31` of three stages, `1/2 + 3 sqrt(15)/25`.
const THREE_31: f64 = 0.964_758_001_544_890_1;

impl Tableau {
    /// Two stages, order 4.
    pub const TWO: Self = Self {
        nodes: &[0.211_324_865_405_187_1, 0.788_675_134_594_812_9],
        weights: &[0.5, 0.5],
        ratios: [[0.5, 1.0 - TWO_21, 0.0], [TWO_21, 0.5, 0.0], [0.0; 3]],
        modes: &[Mode {
            eigenvalue: (0.25, 0.144_337_567_297_406_44),
            right: [(1.0, 0.0), (0.0, -3.732_050_807_568_877), (0.0, 0.0)],
            left: [(1.0, 0.0), (0.0, 0.267_949_192_431_122_7), (0.0, 0.0)],
        }],
    };

    /// Three stages, order 6.
    pub const THREE: Self = Self {
        nodes: &[0.112_701_665_379_258_31, 0.5, 0.887_298_334_620_741_7],
        weights: &[5.0 / 18.0, 4.0 / 9.0, 5.0 / 18.0],
        ratios: [
            [0.5, 1.0 - THREE_21, 1.0 - THREE_31],
            [THREE_21, 0.5, 1.0 - THREE_21],
            [THREE_31, THREE_21, 0.5],
        ],
        modes: &[
            Mode {
                eigenvalue: (0.142_342_788_441_943_9, 0.135_799_925_708_153_8),
                right: [
                    (1.0, 0.0),
                    (-3.603_675_786_145_866, -3.517_365_070_857_906),
                    (-7.924_480_066_670_396, 5.793_026_094_808_575),
                ],
                left: [
                    (0.567_687_886_216_141_6, 0.257_735_201_273_432_5),
                    (-0.051_372_763_302_028_6, 0.193_182_518_931_155_73),
                    (-0.031_192_119_675_403_81, -0.055_326_275_139_417_87),
                ],
            },
            Mode {
                eigenvalue: (0.215_314_423_116_112_2, 0.0),
                right: [(1.0, 0.0), (2.635_166_257_971_907, 0.0), (13.859_658_089_371_63, 0.0)],
                left: [
                    (0.432_312_113_783_858_4, 0.0),
                    (0.051_372_763_302_028_6, 0.0),
                    (0.031_192_119_675_403_81, 0.0),
                ],
            },
        ],
    };

    /// The method of `stages` stages, 2 or 3.
    #[must_use]
    pub fn of_stages(stages: usize) -> Option<&'static Self> {
        match stages {
            2 => Some(&Self::TWO),
            3 => Some(&Self::THREE),
            _ => None,
        }
    }

    /// Number of stages.
    #[must_use]
    pub fn stages(&self) -> usize {
        self.nodes.len()
    }

    /// Order, twice the number of stages.
    #[must_use]
    pub fn order(&self) -> usize {
        2 * self.stages()
    }

    /// `w_j` with `L = sum_j w_j L_j` the increment that the polynomial of slopes through `L_j/(h b_j)` at the
    /// nodes gives at `theta`, for a stage of weight `weight` in a step `scale` times as long.
    pub(super) fn continuation(&self, theta: f64, weight: f64, scale: f64) -> [f64; MOST_STAGES] {
        let mut coefficients = [0.0; MOST_STAGES];
        for (j, coefficient) in coefficients.iter_mut().enumerate().take(self.stages()) {
            let others = self.nodes.iter().enumerate().filter(|(k, _)| *k != j);
            let basis: f64 = others.map(|(_, node)| (theta - node) / (self.nodes[j] - node)).product();
            *coefficient = scale * weight / self.weights[j] * basis;
        }
        coefficients
    }
}
