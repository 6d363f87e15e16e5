//! d'Alembert's energy of a conformal motion: a constant form in the body, weighted by the square of the dilatation.
//!
//! On R+ SO(n) is `phi^T phi = D^2 1`, so that `phi_dot = phi Oh` makes (2.1) `T = D^2 T_1(Oh)` with the energy `T_1` of the
//! rigid motion extended to `Oh` skew plus a multiple of 1, and `H = D^-2 H_1(Sigma_hat)`. Beside the brackets of `H_1`
//! there is one with `D`: `-dH/dq = 2 H` acts on the trace of `Sigma_hat` as the slope of a potential in `q` does.

use crate::algebra::{Arena, Expr, Polynomial, Rational};
use crate::symbol::Quantity;

use super::charts::{Chart, Coordinate};
use super::equations::Load;
use super::kinetic::Kinetic;

/// The weight of an energy.
#[derive(Clone, Debug)]
pub struct Weight {
    /// `D^2`.
    pub square: Expr,
    /// `D^-2`.
    pub inverse: Expr,
    /// Both as functions of the placement: a column of `phi` has the length `D`.
    pub definitions: Vec<(Expr, Polynomial)>,
}

impl Weight {
    /// The weight `D^2` of the internal energy, where it has one.
    pub fn of(arena: &mut Arena, kinetic: &Kinetic) -> Option<Self> {
        kinetic.is_weighted().then(|| Self::squares(arena, kinetic.dim))
    }

    /// `D^2` and `D^-2` of a placement in R+ SO(n).
    pub(super) fn squares(arena: &mut Arena, dim: usize) -> Self {
        let [square, inverse] =
            arena.symbols([Quantity::DilatationSquared, Quantity::InverseDilatationSquared]);
        let mut length = Polynomial::zero();
        for i in 1..=dim {
            let entry = arena.symbol(Quantity::Placement.at([i, 1]));
            length.add_term(vec![entry, entry], &Rational::ONE);
        }
        // A symbol is not the number zero.
        let reciprocal = Polynomial::atom(arena.reciprocal(square));
        Self { square, inverse, definitions: vec![(square, length), (inverse, reciprocal)] }
    }

    /// The force `-dH_int/dq 1/n = 2 H_int/n 1` on `Sigma_hat` from the internal energy, and what defines the weight.
    pub fn load(&self, chart: &Chart, internal: &Polynomial) -> Load {
        let share = &Rational::from(2) * &Rational::one_over(chart.dim);
        let force = chart.reduced(internal).scaled(&share);
        let forces = (0..chart.dim).map(|a| (Coordinate::M(a, a), force.clone())).collect();
        Load { shared: self.definitions.clone(), forces, ..Load::default() }
    }
}
