//! The stored doubles against nodes computed anew: roots of `P_s(2x - 1) - P_(s-1)(2x - 1)`, `P` those of Legendre, enclosed in
//! exact rationals, with the matrix as exact integrals. Butcher's simplifying assumptions `B(2s-1)`, `C(s)` and `D(s-1)`,
//! which give the order `2s - 1`, hold up to the enclosures.

use num_rational::BigRational;
use num_traits::{One, Zero};

use super::Tableau;
use crate::gauss::exact::{Collocation, close, is_small, legendre, number, power};

const STORED: [&Tableau; 3] = [&Tableau::THREE, &Tableau::FIVE, &Tableau::SEVEN];

/// The polynomial whose roots are the nodes, without the last, `x = 1`.
fn radau(s: usize) -> Collocation {
    let mut difference = legendre(s);
    for (c, lower) in difference.iter_mut().zip(legendre(s - 1)) {
        *c -= lower;
    }
    // Divided by `x - 1`, from the highest power down; nothing is left.
    let mut quotient = vec![BigRational::zero(); s];
    let mut carried = BigRational::zero();
    for k in (0..s).rev() {
        carried += &difference[k + 1];
        quotient[k] = carried.clone();
    }
    assert_eq!(carried + &difference[0], BigRational::zero(), "x = 1 is a root");
    Collocation::with_nodes(&quotient, Some(BigRational::one()))
}

#[test]
fn simplifying_assumptions_give_the_order() {
    for s in STORED.map(Tableau::stages) {
        let Collocation { c, b, a } = radau(s);
        assert_eq!(c.len(), s, "the nodes are in (0, 1]");
        let moment =
            |k: usize| (0..s).map(|i| &b[i] * power(&c[i], k - 1)).sum::<BigRational>() - number(1, k as i64);
        assert!((1..2 * s).all(|k| is_small(&moment(k))), "B({})", 2 * s - 1);
        assert!(!is_small(&moment(2 * s)), "no more than that");
        for (k, i) in (1..=s).flat_map(|k| (0..s).map(move |i| (k, i))) {
            let kth = number(1, k as i64);
            let row: BigRational = (0..s).map(|j| &a[i][j] * power(&c[j], k - 1)).sum();
            assert!(is_small(&(row - power(&c[i], k) * &kth)), "C({k}), row {i}");
            let column: BigRational = (0..s).map(|m| &b[m] * power(&c[m], k - 1) * &a[m][i]).sum();
            let defect = column - &b[i] * (number(1, 1) - power(&c[i], k)) * &kth;
            assert!(k == s || is_small(&defect), "D({k}), column {i}");
        }
        let stiffly_accurate = |j: usize| is_small(&(&a[s - 1][j] - &b[j]));
        assert!((0..s).all(stiffly_accurate), "the last stage is the end of the step");
    }
}

#[test]
fn stored_doubles_are_these_numbers() {
    for stored in STORED {
        let Collocation { c, a, .. } = radau(stored.stages());
        for i in 0..stored.stages() {
            assert!(close(stored.nodes[i], &c[i]), "node {i}");
            for j in 0..stored.stages() {
                assert!(close(stored.matrix[i][j], &a[i][j]), "a_{i}{j}");
            }
        }
    }
}

/// The matrix is the sum of its modes, and the embedded solution that the error is held against is of order `s`.
#[test]
fn modes_and_embedded_solutions_are_those_of_the_matrix() {
    for stored in STORED {
        let s = stored.stages();
        let gamma = stored.modes[0].eigenvalue.0;
        assert_eq!(stored.modes[0].eigenvalue.1, 0.0, "the first mode is real");
        for (i, j) in (0..s).flat_map(|i| (0..s).map(move |j| (i, j))) {
            let (mut entry, mut unit) = (0.0, 0.0);
            for mode in stored.modes {
                let ((a, b), (c, d), (x, y)) = (mode.right[i], mode.left[j], mode.eigenvalue);
                let product = (a * c - b * d, a * d + b * c);
                entry += product.0 * x - product.1 * y;
                unit += product.0;
            }
            let identity = if i == j { 1.0 } else { 0.0 };
            // Vectors of the largest method have entries of some thousands.
            assert!(
                (entry - stored.matrix[i][j]).abs() < 1e-12 && (unit - identity).abs() < 1e-11,
                "{i} {j}"
            );
        }
        // `sum_i e_i Z_i` for `f = k t^(k-1)`, `Z_i = c_i^k`: what the embedded weights take off the exact integral 1.
        for k in 1..=s {
            let embedded =
                |power: i32| (0..s).map(|i| stored.errors[i] * stored.nodes[i].powi(power)).sum::<f64>();
            let expected = if k == 1 { -gamma } else { 0.0 };
            assert!((embedded(k as i32) - expected).abs() < 1e-13, "{s} stages, order {k}");
        }
    }
}
