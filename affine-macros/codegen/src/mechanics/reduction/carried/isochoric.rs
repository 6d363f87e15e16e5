//! Equations without `det phi`, which leaves the range of numbers n times as early as `phi` does: the isochoric part
//! `Psi = r phi` has `det Psi = 1`, and `phi^-1 = r adj Psi`.

use crate::algebra::rational::exponent;
use crate::algebra::ring::{adjugate, pairs};
use crate::algebra::substitute::listed;
use crate::algebra::{Arena, Expr, Matrix, Polynomial, Rational};
use crate::mechanics::charts::{Chart, Momentum};
use crate::mechanics::equations::System;
use crate::symbol::Quantity;

/// Do the forces take the inverse of `phi`?
pub(super) fn inverts_the_placement(arena: &mut Arena, chart: &Chart, tidied: &System) -> bool {
    let inverse = Matrix::symbols(arena, Quantity::InversePlacement, chart.dim).0.concat();
    let takes = |symbol: Expr| tidied.shared.iter().any(|(known, _)| *known == symbol);
    // On a flat body negative powers of the determinant stand beside cofactors.
    let powers = arena.symbols([Quantity::InverseDeterminant, Quantity::InverseDilatation]);
    let over_det = powers.into_iter().any(takes) && chart.momentum == Momentum::Canonical;
    over_det || inverse.into_iter().any(takes)
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

/// Powers of `D` in place of those of `det phi`, and `cof Psi = r^(n-1) cof phi` in place of `cof phi`.
struct Powers {
    n: usize,
    /// Symbols with the powers of `D` that they stand for; kept themselves where they are more than that.
    weights: Vec<(Expr, i32, bool)>,
    d: Expr,
    r: Expr,
}

impl Powers {
    fn new(arena: &mut Arena, chart: &Chart, r: Expr, isochoric: bool) -> Self {
        let n = exponent(chart.dim);
        let [det, inverse_det, d, swelling] = arena.symbols([
            Quantity::Determinant,
            Quantity::InverseDeterminant,
            Quantity::Dilatation,
            Quantity::Swelling,
        ]);
        let mut weights = vec![(det, n, false), (inverse_det, -n, false), (d, 1, false), (r, -1, false)];
        if isochoric {
            let cofactors = Matrix::symbols(arena, Quantity::Cofactor, chart.dim).0.concat();
            weights.extend(cofactors.into_iter().map(|cofactor| (cofactor, n - 1, true)));
            // The factor of the cofactors takes their powers of D over.
            weights.push((swelling, 1 - n, true));
        }
        Self { n: chart.dim, weights, d, r }
    }

    /// The polynomial with `weight` more powers of `D`.
    fn of(&self, arena: &mut Arena, form: &Polynomial, weight: i32) -> Polynomial {
        let mut result = Polynomial::zero();
        for (monomial, c) in form.terms() {
            let (mut power, mut kept) = (weight, Vec::with_capacity(monomial.len()));
            for atom in monomial {
                match self.weights.iter().find(|(symbol, ..)| symbol == atom) {
                    Some((_, weight, stays)) => {
                        power += weight;
                        kept.extend(stays.then_some(*atom));
                    }
                    None => kept.push(self.inside(arena, *atom)),
                }
            }
            let factor = if power > 0 { self.d } else { self.r };
            kept.extend(vec![factor; power.unsigned_abs() as usize]);
            result.add_term(kept, c);
        }
        result
    }

    /// The same for what a function or a reciprocal is of.
    fn inside(&self, arena: &mut Arena, atom: Expr) -> Expr {
        if arena.as_symbol(atom).is_some() {
            return atom;
        }
        let n = exponent(self.n);
        let powers = [(self.d, n), (self.r, n)].map(|(of, k)| arena.power(of, k));
        let values = [(self.weights[0].0, powers[0]), (self.weights[1].0, powers[1])];
        // Powers of D are not zero.
        arena.replaced(atom, &listed(&values))
    }

    fn of_system(&self, arena: &mut Arena, system: &System) -> System {
        let mut result = system.mapped(&mut |form| self.of(arena, form, 0));
        for ((symbol, form), (_, before)) in result.shared.iter_mut().zip(&system.shared) {
            let known = self.weights.iter().find(|(known, _, stays)| known == symbol && *stays);
            if let Some((_, weight, _)) = known {
                *form = self.of(arena, before, -weight);
            }
        }
        result
    }
}

/// The system with `D = r D^2`, where `D^2` is the determinant with one row of `Psi` in place of that of `phi`: two
/// multiplications more than `r^2 det phi`. In the plane `D = r det phi` has the range of `D^2` as it stands.
fn through_the_square(arena: &mut Arena, chart: &Chart, system: &System, r: Expr) -> System {
    let [det, dilatation, square] =
        arena.symbols([Quantity::Determinant, Quantity::Dilatation, Quantity::DilatationSquared]);
    let psi = Matrix::symbols(arena, Quantity::IsochoricPlacement, chart.dim).0;
    let adjugate = adjugate(&chart.placement());
    let mut system = Powers::new(arena, chart, r, false).of_system(arena, system);
    system.shared.retain(|(symbol, _)| *symbol != det && *symbol != dilatation);
    let mut expanded = Polynomial::zero();
    for a in 0..chart.dim {
        system.shared.push((psi[0][a], Polynomial::monomial([r, chart.phi.0[0][a]])));
        expanded.add_product(&Polynomial::atom(psi[0][a]), &adjugate[a][0], &Rational::ONE);
    }
    system.shared.push((square, expanded));
    system.shared.push((dilatation, Polynomial::monomial([r, square])));
    system
}

/// The system with `cof Psi` for the cofactors and powers of `D` and `r` for those of `det phi`.
fn through_the_isochoric_part(arena: &mut Arena, chart: &Chart, system: &System, r: Expr) -> System {
    let n = chart.dim;
    let psi = Matrix::symbols(arena, Quantity::IsochoricPlacement, n);
    let adjugate = adjugate(&psi.atoms());
    let psi = psi.0;
    let cofactors = Matrix::symbols(arena, Quantity::Cofactor, n).0;
    let inverse = Matrix::symbols(arena, Quantity::InversePlacement, n).0;
    let names = arena.symbols([Quantity::Determinant, Quantity::InverseDeterminant, Quantity::Dilatation]);
    let [det, inverse_det, dilatation] = names;
    let mut system = Powers::new(arena, chart, r, true).of_system(arena, system);
    let inverts = system.shared.iter().any(|(symbol, _)| *symbol == inverse[0][0]);
    let redefined = [cofactors.concat(), inverse.concat(), vec![det, inverse_det, dilatation]].concat();
    system.shared.retain(|(symbol, _)| !redefined.contains(symbol));
    for (i, a) in pairs(n) {
        system.shared.push((psi[i][a], Polynomial::monomial([r, chart.phi.0[i][a]])));
        system.shared.push((cofactors[i][a], adjugate[a][i].clone()));
        if inverts {
            system.shared.push((inverse[a][i], Polynomial::monomial([r, cofactors[i][a]])));
        }
    }
    // D = D det Psi, expanded along the first row.
    let expanded: Polynomial = chart.phi.0[0]
        .iter()
        .zip(&cofactors[0])
        .map(|(entry, cofactor)| Polynomial::monomial([*entry, *cofactor]))
        .sum();
    system.shared.push((dilatation, expanded));
    system
}
