//! What is known of a placement, of all of GL(n) or of a group that the motion is confined to.

use crate::algebra::ring::{Square, adjugate, scalar, table, transpose, upper};
use crate::algebra::{Arena, Expr, Matrix, Polynomial, Rational};
use crate::mechanics::constraint::Constraint;
use crate::mechanics::kinetics::named;
use crate::mechanics::metric::Definitions;
use crate::mechanics::potential::Base;
use crate::mechanics::shared::inverse_placement;
use crate::mechanics::weight::Weight;
use crate::symbol::{Quantity, Symbol};

/// A placement.
pub(super) struct Placed {
    pub(super) phi: Square<Polynomial>,
    /// `phi^-1`.
    pub(super) inverse: Square<Polynomial>,
    /// `phi^T phi`.
    pub(super) green: Square<Polynomial>,
    /// `D^-2` on R+ SO(n), where `phi^-1 = D^-2 phi^T`; 1 on SO(n).
    pub(super) inverse_square: Option<Polynomial>,
    /// What these share.
    pub(super) shared: Definitions,
}

impl Placed {
    pub(super) fn new(arena: &mut Arena, n: usize, group: Option<Constraint>) -> Self {
        let phi = Matrix::symbols(arena, Quantity::Placement, n).atoms();
        let one = Polynomial::constant(Rational::ONE);
        match group {
            None => {
                let (inverse, shared) = inverse_placement(arena, &phi);
                let green = green(arena, n);
                Self { inverse, green, inverse_square: None, shared, phi }
            }
            Some(Constraint::Rigid) => Self {
                inverse: transpose(&phi),
                green: scalar(n, &one),
                inverse_square: Some(one),
                shared: Vec::new(),
                phi,
            },
            Some(Constraint::Conformal) => {
                let Weight { square, inverse, definitions } = Weight::squares(arena, n);
                let (square, inverse_square) = (Polynomial::atom(square), Polynomial::atom(inverse));
                let mut shared = definitions;
                let inverse = table(n, |a, i| phi[i][a].mul(&inverse_square));
                let inverse = matrix(arena, &mut shared, Quantity::InversePlacement, &inverse);
                Self { inverse, green: scalar(n, &square), inverse_square: Some(inverse_square), shared, phi }
            }
            Some(Constraint::Isochoric) => {
                let mut shared = Vec::new();
                // det phi = 1
                let inverse = match n {
                    2 => adjugate(&phi),
                    _ => matrix(arena, &mut shared, Quantity::InversePlacement, &adjugate(&phi)),
                };
                shared.extend(green_definitions(arena, n));
                Self { inverse, green: green(arena, n), inverse_square: None, shared, phi }
            }
        }
    }

    /// The entries of `phi^-1` and `G` with what they are here.
    pub(super) fn values(&self, arena: &mut Arena) -> Definitions {
        let n = self.phi.len();
        let inverse = Matrix::symbols(arena, Quantity::InversePlacement, n).0.concat();
        let mut list: Definitions = inverse.into_iter().zip(self.inverse.concat()).collect();
        for (a, b) in upper(n) {
            list.push((Base::Green(a, b).symbol(arena), self.green[a][b].clone()));
        }
        list.retain(|(symbol, value)| *value != Polynomial::atom(*symbol));
        list
    }
}

/// `G` as symbols.
pub(super) fn green(arena: &mut Arena, n: usize) -> Square<Polynomial> {
    let entry = |a: usize, b: usize| Polynomial::atom(Base::Green(a, b).symbol(arena));
    table(n, entry)
}

/// `G = phi^T phi`.
pub(super) fn green_definitions(arena: &mut Arena, n: usize) -> Definitions {
    let phi = Matrix::symbols(arena, Quantity::Placement, n);
    let mut list = Definitions::new();
    for (a, b) in upper(n) {
        let value: Polynomial = phi.0.iter().map(|row| Polynomial::monomial([row[a], row[b]])).sum();
        list.push((Base::Green(a, b).symbol(arena), value));
    }
    list
}

/// A matrix by symbols for its entries; one whose entries are symbols already stays as it is.
pub(super) fn matrix(
    arena: &mut Arena,
    shared: &mut Definitions,
    of: impl Into<Symbol>,
    values: &Square<Polynomial>,
) -> Square<Polynomial> {
    let symbols: Vec<Expr> = Matrix::symbols(arena, of, values.len()).0.concat();
    let values = named(&symbols, values.concat(), shared);
    values.chunks(symbols.len().isqrt().max(1)).map(<[Polynomial]>::to_vec).collect()
}
