//! Deformation tensors in a chart, and the derivatives of the base functions along the group.

use std::collections::HashMap;

use crate::algebra::ring::{Ring, Square, adjugate, dot, pairs, table, upper};
use crate::algebra::{Arena, Expr, Matrix, Polynomial, Rational};
use crate::mechanics::charts::{Chart, Momentum};
use crate::symbol::{Quantity, Symbol};

use super::base::{Along, Base};
use super::principal::Principal;

/// Deformation tensors as symbols or as numbers, whichever the purpose asks for.
pub(super) struct Tensors<R> {
    pub(super) phi: Square<R>,
    pub(super) green: Square<R>,
    pub(super) finger: Square<R>,
    /// `G^2` and `Ct^2`; only `tr G^3` needs them.
    pub(super) squares: [Square<R>; 2],
    /// `d(det phi)/dphi`; only the canonical chart needs it.
    pub(super) cofactors: Square<R>,
    /// Stretches and principal axes; only single stretches need them.
    pub(super) principal: Principal<R>,
}

impl<R: Ring> Tensors<R> {
    /// The values of tensors and traces by their symbols.
    pub(super) fn values(&self) -> HashMap<Symbol, R> {
        let n = self.phi.len();
        let mut values = HashMap::new();
        for (a, b) in pairs(n) {
            values.insert(Base::Green(a, b).quantity(), self.green[a][b].clone());
            values.insert(Base::Finger(a, b).quantity(), self.finger[a][b].clone());
        }
        values
            .extend(Base::TRACES.map(Base::quantity).into_iter().zip(traces(&self.green, &self.squares[0])));
        values
    }
}

/// Definitions of deformation tensors and traces in a chart; what is not used goes later.
pub(super) fn definitions(arena: &mut Arena, n: usize, chart: &Chart) -> Vec<(Expr, Polynomial)> {
    let phi = chart.placement();
    let mut list = Vec::new();
    for (a, b) in upper(n) {
        list.push((Base::Green(a, b).symbol(arena), green(&phi, a, b)));
        list.push((Base::Finger(a, b).symbol(arena), finger(&phi, a, b)));
    }
    let spatial = matches!(chart.momentum, Momentum::Space | Momentum::Total);
    let squares = squares(arena, n, SQUARES);
    let tensors = [Base::Green, Base::Finger].map(|base: fn(usize, usize) -> Base| -> Square<Polynomial> {
        table(n, |a, b| Polynomial::atom(base(a, b).symbol(arena)))
    });
    for (tensor, square) in tensors.iter().zip(&squares) {
        list.extend(definitions_of_square(tensor, square));
    }
    let own = usize::from(spatial);
    let symbols = Base::TRACES.map(|base| base.symbol(arena));
    list.extend(symbols.into_iter().zip(traces(&tensors[own], &squares[own])));
    list
}

/// `tr G`, `tr G^2` and `tr G^3` of a symmetric matrix, with its square.
pub(super) fn traces<R: Ring>(tensor: &Square<R>, square: &Square<R>) -> [R; 3] {
    let one = R::number(&Rational::ONE);
    let places = || pairs(tensor.len());
    [
        dot(tensor.iter().enumerate().map(|(a, row)| (&row[a], &one))),
        dot(places().map(|(a, b)| (&tensor[a][b], &tensor[a][b]))),
        dot(places().map(|(a, b)| (&tensor[a][b], &square[a][b]))),
    ]
}

/// `G^2` and `Ct^2`.
pub(super) const SQUARES: [Quantity; 2] = [Quantity::GreenSquare, Quantity::FingerSquare];

/// Those of `Psi`.
pub(super) const UNIT_SQUARES: [Quantity; 2] = [Quantity::UnitGreenSquare, Quantity::UnitFingerSquare];

/// The entries of symmetric matrices as symbols.
pub(super) fn squares(arena: &mut Arena, n: usize, of: [Quantity; 2]) -> [Square<Polynomial>; 2] {
    of.map(|square| {
        let mut entry = |a: usize, b: usize| arena.symbol(square.at([a.min(b) + 1, a.max(b) + 1]));
        table(n, |a, b| Polynomial::atom(entry(a, b)))
    })
}

/// What these symbols stand for.
pub(super) fn definitions_of_square(
    tensor: &Square<Polynomial>,
    square: &Square<Polynomial>,
) -> Vec<(Expr, Polynomial)> {
    let n = tensor.len();
    let pairs = upper(n);
    let defined = pairs.filter_map(|(a, b)| {
        let symbol = square[a][b].atoms().next().copied()?;
        Some((symbol, entry_of_product(tensor, tensor, a, b)))
    });
    defined.collect()
}

/// The derivative of a base function, divided by the number that its slope carries.
pub(super) fn direction<R: Ring>(base: Base, along: Along, tensors: &Tensors<R>, a: usize, b: usize) -> R {
    let one = |holds: bool| R::number(if holds { &Rational::ONE } else { &Rational::ZERO });
    let Tensors { phi, green, finger, squares: [green_square, finger_square], cofactors, principal } =
        tensors;
    let mut sum = R::zero();
    let mut add = |holds: bool, value: &R| {
        if holds {
            sum.plus(value, &Rational::ONE);
        }
    };
    let times = |a, b| dot([(a, b)]);
    match (base, along) {
        (Base::Position(_), _) => {}
        (Base::LogStretch(k), _) => return principal.direction(k, along, a, b),
        (Base::MeanLogStretch, Along::Body | Along::Space) => return one(a == b),
        (Base::MeanLogStretch, Along::Placement) => return cofactors[a][b].clone(),
        (Base::Trace, Along::Body) => return green[a][b].clone(),
        (Base::Trace, Along::Space) => return finger[a][b].clone(),
        (Base::Trace, Along::Placement) => return phi[a][b].clone(),
        (Base::TraceOfSquare, Along::Body) => return entry_of_product(green, green, a, b),
        (Base::TraceOfSquare, Along::Space) => return entry_of_product(finger, finger, a, b),
        (Base::TraceOfSquare, Along::Placement) => return entry_of_product(phi, green, a, b),
        (Base::TraceOfCube, Along::Body) => return entry_of_product(green, green_square, a, b),
        (Base::TraceOfCube, Along::Space) => return entry_of_product(finger, finger_square, a, b),
        (Base::TraceOfCube, Along::Placement) => return entry_of_product(phi, green_square, a, b),
        (Base::Green(c, d), Along::Body) => {
            add(a == c, &green[b][d]);
            add(a == d, &green[b][c]);
        }
        // d(phi_kC phi_kD)/dphi_jA phi_iA = phi_iC phi_jD + phi_jC phi_iD
        (Base::Green(c, d), Along::Space) => {
            add(true, &times(&phi[a][c], &phi[b][d]));
            add(true, &times(&phi[b][c], &phi[a][d]));
        }
        (Base::Green(c, d), Along::Placement) => {
            add(b == c, &phi[a][d]);
            add(b == d, &phi[a][c]);
        }
        (Base::Finger(i, j), Along::Body) => {
            add(true, &times(&phi[i][b], &phi[j][a]));
            add(true, &times(&phi[i][a], &phi[j][b]));
        }
        (Base::Finger(k, l), Along::Space) => {
            add(b == k, &finger[a][l]);
            add(b == l, &finger[a][k]);
        }
        (Base::Finger(k, l), Along::Placement) => {
            add(a == k, &phi[l][b]);
            add(a == l, &phi[k][b]);
        }
        (Base::Placement(i, c), Along::Body) => add(a == c, &phi[i][b]),
        (Base::Placement(k, c), Along::Space) => add(b == k, &phi[a][c]),
        (Base::Placement(i, c), Along::Placement) => return one(a == i && b == c),
    }
    sum
}

fn entry_of_product<R: Ring>(left: &Square<R>, right: &Square<R>, a: usize, b: usize) -> R {
    dot(left[a].iter().zip(right.iter().map(|row| &row[b])))
}

/// The cofactors `d(det phi)/dphi_iA`.
pub(super) fn cofactors(arena: &mut Arena, chart: &Chart) -> Vec<(Expr, Polynomial)> {
    let symbols = Matrix::symbols(arena, Quantity::Cofactor, chart.dim).transpose();
    symbols.0.concat().into_iter().zip(adjugate(&chart.placement()).concat()).collect()
}

pub(super) fn green<R: Ring>(phi: &Square<R>, a: usize, b: usize) -> R {
    dot(phi.iter().map(|row| (&row[a], &row[b])))
}

pub(super) fn finger<R: Ring>(phi: &Square<R>, i: usize, j: usize) -> R {
    dot(phi[i].iter().zip(&phi[j]))
}
