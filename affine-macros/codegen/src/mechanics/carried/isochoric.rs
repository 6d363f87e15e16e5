//! Equations without `det phi`, which leaves the range of numbers n times as early as `phi` does: the isochoric part
//! `Psi = r phi` has `det Psi = 1`, and `phi^-1 = r adj Psi`.

use crate::algebra::ring::{Square, adjugate, table};
use crate::algebra::{Arena, Expr, Matrix, Polynomial, Rational};
use crate::mechanics::charts::{Chart, Momentum};
use crate::mechanics::equations::System;
use crate::mechanics::weight::SQUARE;

/// Do the forces take the inverse of `phi`?
pub(super) fn inverts_the_placement(arena: &mut Arena, tidied: &System) -> bool {
    let inverse_det = arena.symbol("inverse_det");
    tidied.shared.iter().any(|(symbol, _)| *symbol == inverse_det)
}

/// The system without `det phi`, `r` being state.
pub(super) fn without_the_determinant(
    arena: &mut Arena,
    (chart, inverts): (&Chart, bool),
    system: &System,
    r: Expr,
) -> System {
    if inverts || chart.momentum == Momentum::Canonical {
        through_the_isochoric_part(arena, chart, system, r)
    } else if chart.dim == 3 {
        through_the_square(arena, chart, system, r)
    } else {
        system.clone()
    }
}

/// The system with `D = r D^2`, where `D^2` is the determinant with one row of `Psi` in place of that of `phi`: two
/// multiplications more than `r^2 det phi`. In the plane `D = r det phi` has the range of `D^2` as it stands.
fn through_the_square(arena: &mut Arena, chart: &Chart, system: &System, r: Expr) -> System {
    let [det, dilatation, square] = ["det", "dilatation", SQUARE].map(|name| arena.symbol(name));
    let psi = Matrix::symbols(arena, "psi", chart.dim).0;
    let adjugate = adjugate(&atoms(&chart.phi.0));
    let mut system = system.clone();
    system.shared.retain(|(symbol, _)| *symbol != det && *symbol != dilatation);
    let mut expanded = Polynomial::zero();
    for a in 0..chart.dim {
        system.shared.push((psi[0][a], Polynomial::term(vec![r, chart.phi.0[0][a]], Rational::ONE)));
        expanded.add_product(&Polynomial::atom(psi[0][a]), &adjugate[a][0], &Rational::ONE);
    }
    system.shared.push((square, expanded));
    system.shared.push((dilatation, Polynomial::term(vec![r, square], Rational::ONE)));
    system
}

/// The system with `cof Psi` for the cofactors and `r` for `1/det phi`: products of the two are what they were, since
/// `cof Psi = r^(n-1) cof phi`.
fn through_the_isochoric_part(arena: &mut Arena, chart: &Chart, system: &System, r: Expr) -> System {
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
