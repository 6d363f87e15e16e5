//! The stored doubles of every number of stages against nodes computed anew: roots of the shifted Legendre polynomial,
//! enclosed by bisection in exact rationals, with weights and matrices as exact integrals of Lagrange polynomials
//! through the enclosures. Butcher's simplifying assumptions, and with them the orders, hold up to the enclosures.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, ToPrimitive, Zero, pow};

use super::Tableau;

const STORED: [&Tableau; 4] = [&Tableau::TWO, &Tableau::THREE, &Tableau::FOUR, &Tableau::SIX];
/// Binary digits of the enclosures.
const DIGITS: usize = 160;

pub(crate) fn number(numerator: i64, denominator: i64) -> BigRational {
    BigRational::new(BigInt::from(numerator), BigInt::from(denominator))
}

/// Coefficients, constant first.
pub(crate) type Polynomial = Vec<BigRational>;

fn value(polynomial: &Polynomial, x: &BigRational) -> BigRational {
    polynomial.iter().rev().fold(BigRational::zero(), |sum, c| sum * x + c)
}

fn times(a: &Polynomial, b: &Polynomial) -> Polynomial {
    let mut product = vec![BigRational::zero(); a.len() + b.len() - 1];
    for (i, a) in a.iter().enumerate() {
        for (j, b) in b.iter().enumerate() {
            product[i + j] += a * b;
        }
    }
    product
}

/// `int_0^x`.
fn integral(polynomial: &Polynomial, x: &BigRational) -> BigRational {
    let terms = polynomial.iter().zip(1..).map(|(c, k)| c * number(1, k) * pow(x.clone(), k as usize));
    terms.fold(BigRational::zero(), |sum, term| sum + term)
}

/// `P_s(2x - 1)` by Bonnet's recurrence `k P_k = (2k - 1) z P_(k-1) - (k - 1) P_(k-2)`.
pub(crate) fn legendre(s: usize) -> Polynomial {
    let z = vec![number(-1, 1), number(2, 1)];
    let (mut before, mut last) = (vec![number(1, 1)], z.clone());
    for k in 2..=s as i64 {
        let mut next: Polynomial = times(&z, &last).iter().map(|c| c * number(2 * k - 1, k)).collect();
        for (next, c) in next.iter_mut().zip(&before) {
            *next -= c * number(k - 1, k);
        }
        (before, last) = (last, next);
    }
    last
}

/// Middles of intervals of length `2^-DIGITS` in which the polynomial changes sign.
fn roots(polynomial: &Polynomial) -> Vec<BigRational> {
    // For at most six stages the roots are further apart than that.
    let pieces = 64;
    let is_negative = |x: &BigRational| value(polynomial, x).is_negative();
    let mut roots = Vec::new();
    for k in 0..pieces {
        // Off the middle, which is a root itself where the number of stages is odd.
        let [mut low, mut high] = [k, k + 1].map(|k| number(3 * k - 1, 3 * pieces));
        let sign = is_negative(&low);
        if is_negative(&high) == sign {
            continue;
        }
        for _ in 0..DIGITS {
            let middle = (&low + &high) * number(1, 2);
            if is_negative(&middle) == sign { low = middle } else { high = middle }
        }
        roots.push((low + high) * number(1, 2));
    }
    roots
}

/// Nodes, weights and matrix of collocation.
pub(crate) struct Collocation {
    pub(crate) c: Vec<BigRational>,
    pub(crate) b: Vec<BigRational>,
    pub(crate) a: Vec<Vec<BigRational>>,
}

impl Collocation {
    fn of(s: usize) -> Self {
        let gauss = Self::with_nodes(&legendre(s), None);
        assert_eq!(gauss.c.len(), s, "Legendre polynomials have simple roots in (0, 1)");
        gauss
    }

    /// At the roots of a polynomial in (0, 1), and at one more node.
    pub(crate) fn with_nodes(polynomial: &Polynomial, more: Option<BigRational>) -> Self {
        let c: Vec<_> = roots(polynomial).into_iter().chain(more).collect();
        let s = c.len();
        let basis: Vec<Polynomial> = (0..s)
            .map(|j| {
                let others = (0..s).filter(|k| *k != j);
                others.fold(vec![number(1, 1)], |product, k| {
                    let scale = (&c[j] - &c[k]).recip();
                    times(&product, &vec![-&c[k] * &scale, scale])
                })
            })
            .collect();
        let b = basis.iter().map(|l| integral(l, &BigRational::one())).collect();
        let a = c.iter().map(|c| basis.iter().map(|l| integral(l, c)).collect()).collect();
        Self { c, b, a }
    }
}

/// The enclosures, through polynomials with coefficients below `10^6`.
pub(crate) fn is_small(defect: &BigRational) -> bool {
    defect.abs() * pow(BigRational::from(BigInt::from(2)), DIGITS - 40) < BigRational::one()
}

#[test]
fn simplifying_assumptions_give_the_order() {
    for s in STORED.map(Tableau::stages) {
        let Collocation { c, b, a } = Collocation::of(s);
        let power = |j: usize, k: usize| power(&c[j], k);
        let moment =
            |k: usize| (0..s).map(|i| &b[i] * power(i, k - 1)).sum::<BigRational>() - number(1, k as i64);
        assert!((1..=2 * s).all(|k| is_small(&moment(k))), "B({})", 2 * s);
        assert!(!is_small(&moment(2 * s + 1)), "no more than that");
        for k in 1..=s {
            let kth = number(1, k as i64);
            for i in 0..s {
                let row: BigRational = (0..s).map(|j| &a[i][j] * power(j, k - 1)).sum();
                assert!(is_small(&(row - power(i, k) * &kth)), "C({k}), row {i}");
                let column: BigRational = (0..s).map(|m| &b[m] * power(m, k - 1) * &a[m][i]).sum();
                assert!(
                    is_small(&(column - &b[i] * (number(1, 1) - power(i, k)) * &kth)),
                    "D({k}), column {i}"
                );
            }
        }
        for (i, j) in (0..s).flat_map(|i| (0..s).map(move |j| (i, j))) {
            let defect = &b[i] * &a[i][j] + &b[j] * &a[j][i] - &b[i] * &b[j];
            assert!(is_small(&defect), "symplectic: {i} {j}");
        }
    }
}

/// `x^k`.
pub(crate) fn power(x: &BigRational, k: usize) -> BigRational {
    pow(x.clone(), k)
}

/// A stored number is the exact one, up to half a unit in the last place of numbers between 1/2 and 2.
pub(crate) fn close(stored: f64, exact: &BigRational) -> bool {
    let stored = BigRational::from_float(stored).unwrap_or_else(BigRational::zero);
    (stored - exact).to_f64().is_some_and(|error| error.abs() < 1.2e-16)
}

#[test]
fn stored_doubles_are_these_numbers() {
    for stored in STORED {
        let Collocation { c, b, a } = Collocation::of(stored.stages());
        for i in 0..stored.stages() {
            assert!(close(stored.nodes[i], &c[i]) && close(stored.weights[i], &b[i]), "node {i}");
            for j in 0..stored.stages() {
                // Those above the diagonal are what the rounded ones below leave.
                assert!(close(stored.ratios[i][j], &(&a[i][j] / &b[j])), "mu_{i}{j}");
            }
        }
    }
}
