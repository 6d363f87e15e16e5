//! `r = 1/D = (det phi)^(-1/n)` as a variable of its own: its rate is a polynomial, and with it the equations are.

use crate::algebra::{Arena, Matrix, Polynomial, Rational};

use super::charts::{Chart, Coordinate, Momentum};
use super::equations::System;

/// The system with `r' = -(r/n) tr(phi^-1 phi')` in place of the root; `None` where nothing takes the root.
pub(super) fn carrying_the_dilatation(arena: &mut Arena, chart: &Chart, system: &System) -> Option<System> {
    let r = arena.symbol("inverse_dilatation");
    let tidied = system.clone().tidied(arena);
    tidied.shared.iter().find(|(symbol, _)| *symbol == r)?;
    let mut system = system.clone();
    system.shared.retain(|(symbol, _)| *symbol != r);
    let expansion = match chart.momentum {
        Momentum::Body | Momentum::Space | Momentum::Total => trace_of_velocity(arena, chart),
        Momentum::Canonical => {
            flat_expansion(arena, chart, &system, &Polynomial::term(vec![r; chart.dim], Rational::ONE))
        }
    };
    let nth = Rational::ratio(-1, i64::try_from(chart.dim).ok()?)?;
    let rate = Polynomial::atom(r).mul(&expansion).scaled(&nth);
    system.rates.push((Coordinate::Carried(r), r, rate));
    Some(system)
}

/// `tr(phi^-1 phi') = tr O`.
fn trace_of_velocity(arena: &mut Arena, chart: &Chart) -> Polynomial {
    let stem = chart.momentum.velocity_name();
    let mut trace = Polynomial::zero();
    for a in 1..=chart.dim {
        trace.add_scaled(&Polynomial::atom(arena.symbol(&format!("{stem}_{a}{a}"))), &Rational::ONE);
    }
    trace
}

/// `tr(phi^-1 phi') = r^n sum_iA cof_iA phi'_iA`, `cof = d(det phi)/dphi`.
fn flat_expansion(arena: &mut Arena, chart: &Chart, system: &System, inverse_det: &Polynomial) -> Polynomial {
    let cofactors = Matrix::symbols(arena, "cofactor", chart.dim);
    let mut sum = Polynomial::zero();
    for (z, _, rate) in &system.rates {
        if let Coordinate::Phi(i, a) = *z {
            sum.add_product(&Polynomial::atom(cofactors.0[i][a]), rate, &Rational::ONE);
        }
    }
    sum.mul(inverse_det)
}
