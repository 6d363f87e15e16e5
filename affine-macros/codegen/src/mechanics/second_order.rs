//! The equations as `q' = V(p)`, `p' = F(t, q)`: what Nystrom methods integrate.

use crate::algebra::{Arena, Expr};

use super::body::Body;
use super::charts::Coordinate;
use super::equations::System;
use super::hamiltonian::Hamiltonian;
use super::reduction::Reduction;
use super::splitting::{Flow, Piece, splitting};
use crate::symbol::Quantity;

/// A reduced system in halves.
#[derive(Clone, Debug)]
pub struct SecondOrder {
    /// Positions, with their rates over the momenta.
    pub positions: System,
    /// Momenta, with their rates over positions and time.
    pub momenta: System,
}

/// The halves of a reduced system whose state is positions, as many momenta, and what follows from the positions;
/// `None` where the velocity of a momentum depends on more than momenta, or its rate on more than positions.
///
/// Both are decided by the pieces of the Hamiltonian: flows that leave alone what their rates read.
pub fn second_order(
    arena: &mut Arena,
    (h, body): (&Hamiltonian, &Body),
    reduction: &Reduction,
) -> Option<SecondOrder> {
    let split = splitting(arena, (h, body), reduction)?;
    let [kinetic, kick] = split.pieces.as_slice() else { return None };
    let half = |quantities: [Quantity; 2]| -> Vec<Expr> {
        let groups = reduction.states.iter().filter(|(quantity, _)| quantities.contains(quantity));
        groups.flat_map(|(_, symbols)| symbols.clone()).collect()
    };
    let (positions, momenta) = (
        half([Quantity::Position, Quantity::Placement]),
        half([Quantity::LinearMomentum, Quantity::CanonicalMomentum]),
    );
    let in_order = positions.len() == momenta.len()
        && reduction.symbols().iter().take(2 * positions.len()).eq(positions.iter().chain(&momenta));
    (split.nystrom && in_order).then_some(())?;
    let chart = &reduction.chart;
    let coordinate = |symbol: Expr| chart.coordinates().into_iter().find(|z| chart.symbol(*z) == symbol);
    Some(SecondOrder {
        positions: rates_of(kinetic, &positions, coordinate)?,
        momenta: rates_of(kick, &momenta, coordinate)?,
    })
}

/// The rates that a piece gives to components, zero where it gives none; `None` where it moves anything else.
fn rates_of(
    piece: &Piece,
    components: &[Expr],
    coordinate: impl Fn(Expr) -> Option<Coordinate>,
) -> Option<System> {
    let mut all = System::default();
    for flow in &piece.flows {
        let Flow::Shift(system) = flow else { return None };
        all.join(system);
    }
    if all.rates.iter().any(|(_, symbol, _)| !components.contains(symbol)) {
        return None;
    }
    let rate = |symbol: Expr| {
        let z = coordinate(symbol)?;
        Some((z, symbol, all.rate(z)))
    };
    let rates = components.iter().map(|symbol| rate(*symbol)).collect::<Option<Vec<_>>>()?;
    Some(System { rates, ..all })
}
