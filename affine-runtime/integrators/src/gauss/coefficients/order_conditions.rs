//! The simplifying assumptions of Butcher in exact arithmetic on numbers `a + b sqrt(d)`, for the coefficients as
//! published, and the stored doubles against these.
//!
//! `B(p)`: `sum_i b_i c_i^(k-1) = 1/k`, `k <= p`. `C(q)`: `sum_j a_ij c_j^(k-1) = c_i^k/k`, `k <= q`. `D(r)`:
//! `sum_i b_i c_i^(k-1) a_ij = b_j (1 - c_j^k)/k`, `k <= r`. `B(2s)`, `C(s)`, `D(s)` give order `2s` (Hairer,
//! Norsett, Wanner, Solving Ordinary Differential Equations I, Theorem II.7.4).

use num_rational::Ratio;

use super::Tableau;

type Rational = Ratio<i64>;

/// `a + b sqrt(d)`.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Surd {
    a: Rational,
    b: Rational,
    d: i64,
}

impl Surd {
    fn rational(&self, a: Rational) -> Self {
        Self { a, b: Rational::from_integer(0), d: self.d }
    }
    fn plus(self, other: Self) -> Self {
        Self { a: self.a + other.a, b: self.b + other.b, d: self.d }
    }
    fn times(self, other: Self) -> Self {
        let d = Rational::from_integer(self.d);
        Self { a: self.a * other.a + self.b * other.b * d, b: self.a * other.b + self.b * other.a, d: self.d }
    }
    fn scaled(self, factor: Rational) -> Self {
        Self { a: self.a * factor, b: self.b * factor, d: self.d }
    }
    fn power(self, exponent: usize) -> Self {
        (0..exponent).fold(self.rational(Rational::from_integer(1)), |power, _| power.times(self))
    }
    fn to_f64(self) -> f64 {
        let number = |r: Rational| *r.numer() as f64 / *r.denom() as f64;
        number(self.a) + number(self.b) * (self.d as f64).sqrt()
    }
}

/// The published method: nodes, weights and matrix.
struct Published {
    c: Vec<Surd>,
    b: Vec<Surd>,
    a: Vec<Vec<Surd>>,
    stored: &'static Tableau,
}

/// From numerators and denominators of the rational parts and of the factors of the root.
fn published() -> [Published; 2] {
    let surds = |d: i64, parts: &[[i64; 4]]| -> Vec<Surd> {
        let surd = |p: &[i64; 4]| Surd { a: Ratio::new(p[0], p[1]), b: Ratio::new(p[2], p[3]), d };
        parts.iter().map(surd).collect()
    };
    [
        Published {
            c: surds(3, &[[1, 2, -1, 6], [1, 2, 1, 6]]),
            b: surds(3, &[[1, 2, 0, 1], [1, 2, 0, 1]]),
            a: vec![surds(3, &[[1, 4, 0, 1], [1, 4, -1, 6]]), surds(3, &[[1, 4, 1, 6], [1, 4, 0, 1]])],
            stored: &Tableau::TWO,
        },
        Published {
            c: surds(15, &[[1, 2, -1, 10], [1, 2, 0, 1], [1, 2, 1, 10]]),
            b: surds(15, &[[5, 18, 0, 1], [4, 9, 0, 1], [5, 18, 0, 1]]),
            a: vec![
                surds(15, &[[5, 36, 0, 1], [2, 9, -1, 15], [5, 36, -1, 30]]),
                surds(15, &[[5, 36, 1, 24], [2, 9, 0, 1], [5, 36, -1, 24]]),
                surds(15, &[[5, 36, 1, 30], [2, 9, 1, 15], [5, 36, 0, 1]]),
            ],
            stored: &Tableau::THREE,
        },
    ]
}

fn sum(terms: impl Iterator<Item = Surd>) -> Surd {
    terms.reduce(Surd::plus).unwrap()
}

#[test]
fn simplifying_assumptions_hold_exactly() {
    for Published { c, b, a, .. } in published() {
        let s = c.len();
        let unit = |k: usize| Ratio::new(1, k as i64);
        let b_condition =
            |k: usize| sum((0..s).map(|i| b[i].times(c[i].power(k - 1)))) == c[0].rational(unit(k));
        assert!((1..=2 * s).all(b_condition), "B({})", 2 * s);
        assert!(!b_condition(2 * s + 1), "no more than that");
        for k in 1..=s {
            for i in 0..s {
                let found = sum((0..s).map(|j| a[i][j].times(c[j].power(k - 1))));
                assert_eq!(found, c[i].power(k).scaled(unit(k)), "C({k}), row {i}");
                let found = sum((0..s).map(|m| b[m].times(c[m].power(k - 1)).times(a[m][i])));
                let one = c[0].rational(unit(1));
                let rest = one.plus(c[i].power(k).scaled(-unit(1)));
                assert_eq!(found, b[i].times(rest).scaled(unit(k)), "D({k}), column {i}");
            }
        }
    }
}

#[test]
fn published_matrices_are_symplectic() {
    for Published { b, a, .. } in published() {
        for i in 0..b.len() {
            for j in 0..b.len() {
                let found = b[i].times(a[i][j]).plus(b[j].times(a[j][i]));
                assert_eq!(found, b[i].times(b[j]), "b_i a_ij + b_j a_ji = b_i b_j, {i} {j}");
            }
        }
    }
}

#[test]
fn stored_doubles_are_the_published_numbers() {
    // Half a unit in the last place of numbers below 1, and as much for the rounding of the comparison.
    let rounding = 1.2e-16 + 1.2e-16;
    for Published { c, b, a, stored } in published() {
        for i in 0..stored.stages() {
            assert!((stored.nodes[i] - c[i].to_f64()).abs() < rounding);
            assert!((stored.weights[i] - b[i].to_f64()).abs() < rounding);
            for j in 0..stored.stages() {
                let found = stored.ratios[i][j] * b[j].to_f64();
                assert!((found - a[i][j].to_f64()).abs() < rounding, "a_{i}{j}");
            }
        }
    }
}

#[test]
fn stored_doubles_are_symplectic_exactly() {
    for stored in [&Tableau::TWO, &Tableau::THREE, &Tableau::FOUR, &Tableau::SIX] {
        for i in 0..stored.stages() {
            for j in 0..stored.stages() {
                assert_eq!(stored.ratios[i][j] + stored.ratios[j][i], 1.0);
                // The sum above rounds; the difference of neighbours does not.
                assert_eq!(1.0 - stored.ratios[i][j], stored.ratios[j][i]);
            }
        }
    }
}

#[test]
fn modes_diagonalise_the_matrix() {
    let real_part = |factors: &[(f64, f64)]| {
        factors.iter().fold((1.0, 0.0), |p: (f64, f64), q| (p.0 * q.0 - p.1 * q.1, p.0 * q.1 + p.1 * q.0)).0
    };
    for stored in [&Tableau::TWO, &Tableau::THREE, &Tableau::FOUR, &Tableau::SIX] {
        for i in 0..stored.stages() {
            for j in 0..stored.stages() {
                let (mut matrix, mut identity) = (0.0, 0.0);
                for mode in stored.modes {
                    let (right, left) = (mode.right[i], mode.left[j]);
                    matrix += real_part(&[right, mode.eigenvalue, left]);
                    identity += real_part(&[right, left]);
                }
                // Eigenvectors have components up to 14; up to 250 for six stages.
                assert!((matrix - stored.weights[i] * stored.ratios[i][j]).abs() < 1e-14, "{i} {j}");
                assert!((identity - f64::from(u8::from(i == j))).abs() < 1e-14, "{i} {j}");
            }
        }
    }
}
