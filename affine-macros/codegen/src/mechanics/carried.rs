//! Functions of `det phi` as variables of their own, `r = 1/D = (det phi)^(-1/n)` and `q = ln(det phi)/n`: their rates are
//! polynomials, and with them the equations are. What overflows, `det phi`, is not formed.

use crate::algebra::{Arena, Expr, Matrix, Polynomial, Rational};

use super::charts::{Chart, Coordinate, Momentum};
use super::equations::System;

/// A function of `det phi` that is integrated beside `phi`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Carried {
    /// `r = 1/D`, in place of a root.
    InverseDilatation,
    /// `q`, in place of a logarithm.
    MeanLogStretch,
}

impl Carried {
    const ALL: [Self; 2] = [Self::InverseDilatation, Self::MeanLogStretch];

    /// Name of its symbol.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::InverseDilatation => "inverse_dilatation",
            Self::MeanLogStretch => "q",
        }
    }

    /// Name of its group in the state.
    #[must_use]
    pub fn group(self) -> &'static str {
        match self {
            Self::InverseDilatation => "1/D",
            Self::MeanLogStretch => "q",
        }
    }

    /// Its symbol.
    pub(super) fn symbol(self, arena: &mut Arena) -> Expr {
        arena.symbol(self.name())
    }

    /// Those that a system carries.
    pub(super) fn of(arena: &Arena, system: &System) -> Vec<Self> {
        let is_state = |carried: &Self| {
            system.rates.iter().any(|(z, symbol, _)| {
                matches!(z, Coordinate::Carried(_)) && arena.name(*symbol) == Some(carried.name())
            })
        };
        Self::ALL.into_iter().filter(is_state).collect()
    }
}

/// The system with `r' = -(r/n) tr(phi^-1 phi')` in place of the root, `q' = tr(phi^-1 phi')/n` in place of the
/// logarithm; `None` where nothing takes either.
pub(super) fn carrying_the_dilatation(arena: &mut Arena, chart: &Chart, system: &System) -> Option<System> {
    let tidied = system.clone().tidied(arena);
    let [r, q] = Carried::ALL.map(|carried| {
        let symbol = carried.symbol(arena);
        tidied.shared.iter().any(|(known, _)| *known == symbol).then_some(symbol)
    });
    let mut system = system.clone();
    system.shared.retain(|(symbol, _)| Some(*symbol) != r && Some(*symbol) != q);
    let expansion = match (chart.momentum, r) {
        (Momentum::Body | Momentum::Space | Momentum::Total, _) => trace_of_velocity(arena, chart),
        (Momentum::Canonical, Some(r)) => {
            flat_expansion(arena, chart, &system, &Polynomial::term(vec![r; chart.dim], Rational::ONE))
        }
        (Momentum::Canonical, None) => {
            let inverse_det = Polynomial::atom(arena.symbol("inverse_det"));
            flat_expansion(arena, chart, &system, &inverse_det)
        }
    };
    let order = i64::try_from(chart.dim).ok()?;
    if let Some(r) = r {
        let rate = Polynomial::atom(r).mul(&expansion).scaled(&Rational::ratio(-1, order)?);
        system.rates.push((Coordinate::Carried(r), r, rate));
    }
    if let Some(q) = q {
        let rate = expansion.scaled(&Rational::ratio(1, order)?);
        system.rates.push((Coordinate::Carried(q), q, rate));
    }
    (r.is_some() || q.is_some()).then_some(system)
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
