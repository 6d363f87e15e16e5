//! Poisson brackets of phase-space coordinates and of the group generators, all index values.
//!
//! Everything dynamical is derived from this table and a Hamiltonian. Conventions: `{q, p} = 1`, `Pi[A][i]`
//! conjugate to `phi[i][A]`.

use crate::algebra::fault;
use crate::algebra::{Expr, Polynomial, Rational};

use super::charts::{Chart, Coordinate, Linear, Momentum};

/// `{a, b}` of two coordinates of a chart.
pub fn bracket(chart: &Chart, a: Coordinate, b: Coordinate) -> Polynomial {
    if a > b { ordered(chart, b, a).neg() } else { ordered(chart, a, b) }
}

/// `{a, b}` for `a` not after `b` in the order `x, phi, p, M`.
fn ordered(chart: &Chart, a: Coordinate, b: Coordinate) -> Polynomial {
    use Coordinate::{Carried, M, P, Phi, X};
    let mut sum = Polynomial::zero();
    match (a, b) {
        (X(i), P(j)) => match chart.linear {
            // {x_i, p_hat_A} = phi_iA
            Some(Linear::Body) => add(&mut sum, true, chart, Phi(i, j), 1),
            _ if i == j => sum = Polynomial::constant(Rational::ONE),
            _ => {}
        },
        // {x_k, I_ij} = d_kj x_i
        (X(k), M(i, j)) => add(&mut sum, chart.momentum == Momentum::Total && k == j, chart, X(i), 1),
        (Phi(k, c), M(i, j)) => match chart.momentum {
            // {phi_kC, Sigma_hat_AB} = d_CA phi_kB
            Momentum::Body => add(&mut sum, c == i, chart, Phi(k, j), 1),
            // {phi_kC, Sigma_ij} = d_kj phi_iC, and the same for I(O)
            Momentum::Space | Momentum::Total => add(&mut sum, k == j, chart, Phi(i, c), 1),
            // {phi_iA, Pi_Bj} = d_ij d_AB
            Momentum::Canonical if k == j && c == i => sum = Polynomial::constant(Rational::ONE),
            Momentum::Canonical => {}
        },
        (P(k), M(i, j)) => match (chart.linear, chart.momentum) {
            // {p_hat_C, Sigma_hat_AB} = d_AC p_hat_B
            (Some(Linear::Body), Momentum::Body) => add(&mut sum, i == k, chart, P(j), 1),
            // {p_k, I_ij} = -d_ik p_j
            (Some(Linear::Space) | None, Momentum::Total) => add(&mut sum, i == k, chart, P(j), -1),
            (Some(Linear::Space) | None, _) => {}
            (Some(Linear::Body), _) => fault::record("p_hat stands beside Sigma_hat alone"),
        },
        (M(i, j), M(k, l)) => match chart.momentum {
            // {Sigma_hat_AB, Sigma_hat_CD} = d_CB Sigma_hat_AD - d_AD Sigma_hat_CB
            Momentum::Body => {
                add(&mut sum, k == j, chart, M(i, l), 1);
                add(&mut sum, i == l, chart, M(k, j), -1);
            }
            // {Sigma_ij, Sigma_kl} = d_il Sigma_kj - d_kj Sigma_il, and the same for I(O)
            Momentum::Space | Momentum::Total => {
                add(&mut sum, i == l, chart, M(k, j), 1);
                add(&mut sum, k == j, chart, M(i, l), -1);
            }
            Momentum::Canonical => {}
        },
        (Carried(_), _) | (_, Carried(_)) => {
            fault::record("what is carried moves by its own rate, no bracket")
        }
        _ => {}
    }
    sum
}

/// Adds `sign * coordinate` where the Kronecker symbol `delta` holds.
fn add(sum: &mut Polynomial, delta: bool, chart: &Chart, coordinate: Coordinate, sign: i64) {
    if delta {
        sum.add_term(vec![chart.symbol(coordinate)], &Rational::from(sign));
    }
}

/// `{F, G}` of polynomials in the coordinates of a chart.
pub fn poisson(chart: &Chart, f: &Polynomial, g: &Polynomial) -> Polynomial {
    let (df, dg) = (gradient(chart, f), gradient(chart, g));
    let mut sum = Polynomial::zero();
    for (a, fa) in &df {
        for (b, gb) in &dg {
            let ab = bracket(chart, *a, *b);
            if !ab.is_zero() {
                sum.add_product(&fa.mul(&ab), gb, &Rational::ONE);
            }
        }
    }
    sum
}

/// The derivatives of `H` that do not vanish.
pub fn gradient(chart: &Chart, h: &Polynomial) -> Vec<(Coordinate, Polynomial)> {
    let coordinates = chart.coordinates();
    let symbols: Vec<Expr> = coordinates.iter().map(|z| chart.symbol(*z)).collect();
    coordinates.into_iter().zip(h.gradient(&symbols)).filter(|(_, slope)| !slope.is_zero()).collect()
}
