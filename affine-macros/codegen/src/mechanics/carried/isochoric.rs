//! Flat bodies: `phi^-1 = r adj(Psi)` with the isochoric part `Psi = r phi`, `det Psi = 1`. Neither `det phi`, which leaves
//! the range of numbers n times as early as `phi`, nor cofactors of `phi` are formed.

use crate::algebra::ring::{Square, adjugate, table};
use crate::algebra::{Arena, Expr, Matrix, Polynomial, Rational};
use crate::mechanics::charts::{Chart, Momentum};
use crate::mechanics::equations::System;

/// Does a system over `phi` and `Pi` take the inverse of `phi`?
pub(super) fn inverts_the_placement(arena: &mut Arena, chart: &Chart, tidied: &System) -> bool {
    let inverse_det = arena.symbol("inverse_det");
    chart.momentum == Momentum::Canonical && tidied.shared.iter().any(|(symbol, _)| *symbol == inverse_det)
}

/// The system with `cof Psi` for the cofactors and `r` for `1/det phi`: products of the two are what they were, since
/// `cof Psi = r^(n-1) cof phi`.
pub(super) fn through_the_isochoric_part(arena: &mut Arena, chart: &Chart, system: &System, r: Expr) -> System {
    let n = chart.dim;
    let psi = Matrix::symbols(arena, "psi", n).0;
    let adjugate = adjugate(&atoms(&psi));
    let cofactors = Matrix::symbols(arena, "cofactor", n).0;
    let inverse = Matrix::symbols(arena, "phi_inverse", n).0;
    let names = ["det", "inverse_det", "dilatation"].map(|name| arena.symbol(name));
    let [det, inverse_det, dilatation] = names;
    let value = |atom: Expr| (atom == inverse_det).then(|| Polynomial::atom(r));
    let mut system = system.substitute(&value);
    let inverts = system.shared.iter().any(|(symbol, _)| *symbol == inverse[0][0]);
    let redefined = [cofactors.concat(), inverse.concat(), vec![det, inverse_det, dilatation]].concat();
    system.shared.retain(|(symbol, _)| !redefined.contains(symbol));
    for i in 0..n {
        for a in 0..n {
            system.shared.push((psi[i][a], Polynomial::term(vec![r, chart.phi.0[i][a]], Rational::ONE)));
            system.shared.push((cofactors[i][a], adjugate[a][i].clone()));
            if inverts {
                let entry = Polynomial::term(vec![r, cofactors[i][a]], Rational::ONE);
                system.shared.push((inverse[a][i], entry));
            }
        }
    }
    // D = D det Psi, expanded along the first row.
    let mut expanded = Polynomial::zero();
    for (entry, cofactor) in chart.phi.0[0].iter().zip(&cofactors[0]) {
        expanded.add_term(vec![*entry, *cofactor], &Rational::ONE);
    }
    system.shared.push((dilatation, expanded));
    system
}

fn atoms(symbols: &[Vec<Expr>]) -> Square<Polynomial> {
    table(symbols.len(), |i, a| Polynomial::atom(symbols[i][a]))
}
