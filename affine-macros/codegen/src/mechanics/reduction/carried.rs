//! Functions of `det phi` as variables of their own, `r = 1/D = (det phi)^(-1/n)` and `q = ln(det phi)/n`: their rates are
//! polynomials, and with them the equations are. What overflows, `det phi`, is not formed.

mod isochoric;

use crate::algebra::passage::{MatrixFunction, Statement, Tensor};
use crate::algebra::{Arena, Expr, Matrix, Polynomial, Rational};
use crate::mechanics::body::Body;
use crate::mechanics::charts::{Chart, Coordinate, Momentum};
use crate::mechanics::equations::System;
use crate::symbol::Quantity;

use super::left_out::{LeftOut, Scope};
use isochoric::{inverts_the_placement, without_the_determinant};

/// A function of `det phi` that is integrated beside `phi`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Carried {
    /// `r = 1/D`, in place of a root.
    InverseDilatation,
    /// `q`, in place of a logarithm.
    MeanLogStretch,
}

impl Carried {
    /// The quantity that its symbol stands for.
    pub fn quantity(self) -> Quantity {
        match self {
            Self::InverseDilatation => Quantity::InverseDilatation,
            Self::MeanLogStretch => Quantity::MeanLogStretch,
        }
    }

    /// What it is at a placement.
    pub(super) fn at(self, placement: Tensor) -> Statement {
        let function = match self {
            Self::InverseDilatation => MatrixFunction::InverseDilatation,
            Self::MeanLogStretch => MatrixFunction::MeanLogStretch,
        };
        Statement::Symbol(self.quantity().into(), placement.under(function))
    }

    pub(super) fn left_out(self) -> LeftOut {
        Scope::Carried.without(match self {
            Self::InverseDilatation => "the root of det phi: 1/D = (det phi)^(-1/n) is integrated beside phi",
            Self::MeanLogStretch => "the logarithm of det phi: q = ln(det phi)/n is integrated beside phi",
        })
    }
}

/// A system without roots and logarithms of `det phi`, and as it is where that may be shorter.
pub(super) fn systems(
    arena: &mut Arena,
    body: &Body,
    chart: &Chart,
    system: System,
) -> Vec<(Vec<Carried>, System)> {
    // On a group det phi is 1, or stands for itself. A factorised mass matrix takes phi^-1 in any case.
    let as_it_is = body.motion.constraint().is_some() || body.motion.hamiltonian().is_none();
    let carrying = if as_it_is { None } else { carrying_the_dilatation(arena, chart, &system) };
    let Some((rootless, inverts)) = carrying else { return vec![(Vec::new(), system)] };
    let is_state = |carried: &Carried| {
        rootless.rates.iter().any(|(_, symbol, _)| arena.quantity(*symbol) == Some(carried.quantity()))
    };
    let carried = [Carried::InverseDilatation, Carried::MeanLogStretch].into_iter().filter(is_state);
    let rootless = (carried.collect(), rootless);
    // Forces with phi^-1 must not form det phi, however short their equations were with it. On a flat body its powers alone stand
    // beside cofactors, and whether that reaches as far is seen where it runs.
    if inverts && chart.momentum != Momentum::Canonical {
        return vec![rootless];
    }
    vec![rootless, (Vec::new(), system)]
}

/// The system with `r' = -(r/n) tr(phi^-1 phi')` in place of the root, `q' = tr(phi^-1 phi')/n` in place of the
/// logarithm, and whether forces take `phi^-1`: then `r` is carried in any case. `None` where nothing takes any of them.
fn carrying_the_dilatation(arena: &mut Arena, chart: &Chart, system: &System) -> Option<(System, bool)> {
    let tidied = system.clone().tidied(arena);
    let symbols = arena.symbols([Quantity::InverseDilatation, Quantity::MeanLogStretch]);
    let [takes_r, takes_q] = symbols.map(|symbol| tidied.shared.iter().any(|(known, _)| *known == symbol));
    let inverts = inverts_the_placement(arena, chart, &tidied);
    let inverse_det = arena.symbol(Quantity::InverseDeterminant);
    let takes_r = takes_r || tidied.shared.iter().any(|(known, _)| *known == inverse_det);
    if !(takes_r || takes_q || inverts) {
        return None;
    }
    let [r, q] = symbols;
    // On a flat body the force of q is a multiple of phi^-T.
    let carries_r = takes_r || inverts;
    let mut system = match carries_r {
        true => without_the_determinant(arena, (chart, inverts), system, r),
        false => system.clone(),
    };
    let is_state = |symbol: Expr| carries_r && symbol == r || takes_q && symbol == q;
    system.shared.retain(|(symbol, _)| !is_state(*symbol));
    let expansion = match chart.momentum {
        Momentum::Body | Momentum::Space | Momentum::Total => trace_of_velocity(arena, chart),
        Momentum::Canonical => flat_expansion(arena, chart, &system, r),
    };
    let mut expansion = expansion.scaled(&Rational::one_over(chart.dim));
    if carries_r && takes_q {
        // r' = -r q'
        let shared = arena.symbol(Quantity::Expansion);
        system.shared.push((shared, expansion));
        expansion = Polynomial::atom(shared);
    }
    if carries_r {
        let rate = Polynomial::atom(r).mul(&expansion).neg();
        system.rates.push((Coordinate::Carried(r), r, rate));
    }
    if takes_q {
        system.rates.push((Coordinate::Carried(q), q, expansion));
    }
    Some((system, inverts))
}

/// `tr(phi^-1 phi') = tr O`.
fn trace_of_velocity(arena: &mut Arena, chart: &Chart) -> Polynomial {
    let velocity = chart.momentum.velocity();
    (1..=chart.dim).map(|a| Polynomial::atom(arena.symbol(velocity.at([a, a])))).sum()
}

/// `tr(phi^-1 phi') = r sum_iA cof_iA phi'_iA` with the cofactors of `Psi = r phi`.
fn flat_expansion(arena: &mut Arena, chart: &Chart, system: &System, r: Expr) -> Polynomial {
    let cofactors = Matrix::symbols(arena, Quantity::Cofactor, chart.dim);
    let products = system.rates.iter().filter_map(|(z, _, rate)| match *z {
        Coordinate::Phi(i, a) => Some(Polynomial::atom(cofactors.0[i][a]).mul(rate)),
        _ => None,
    });
    products.sum::<Polynomial>().mul(&Polynomial::atom(r))
}
