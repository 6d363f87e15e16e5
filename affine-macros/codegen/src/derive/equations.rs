//! A first-order system, ready to be written down.

use crate::ir::{Program, Value};
use crate::symbol::{Quantity, Symbol};

/// A first-order system as a program over a plain array.
#[derive(PartialEq, Eq)]
pub struct Equations {
    /// Groups of the array, with the symbols of their components.
    pub groups: Vec<(Quantity, Vec<Symbol>)>,
    /// Entries of the affine momentum that are linear in components of the array.
    pub dependent: Program,
    /// Array -> its rate.
    pub program: Program,
}

impl Equations {
    /// Is a quantity a group of the array?
    pub fn has(&self, quantity: Quantity) -> bool {
        self.groups.iter().any(|(group, _)| *group == quantity)
    }

    /// The components of the groups, without what these are.
    pub fn components(&self) -> Vec<Vec<Symbol>> {
        self.groups.iter().map(|(_, names)| names.clone()).collect()
    }

    /// The components of the array.
    pub fn symbols(&self) -> Vec<Symbol> {
        self.groups.iter().flat_map(|(_, symbols)| symbols.clone()).collect()
    }

    /// Are they `q' = V(p)`, `p' = F(t, q)`, that is `q'' = f(t, q)`? A force that has no potential makes a work besides, which
    /// depends on velocities even where the force does not.
    pub fn is_second_order(&self) -> bool {
        let (positions, momenta) = (
            self.of(&[Quantity::Position, Quantity::Placement]),
            self.of(&[Quantity::LinearMomentum, Quantity::CanonicalMomentum]),
        );
        let work = self.of(&[Quantity::Work]);
        let read_by = |group: &[(Symbol, Value)]| -> Vec<Symbol> {
            let program = Program { outputs: group.to_vec(), ..self.program.clone() };
            program.without_dead_steps().symbols().cloned().collect()
        };
        let (by_velocities, by_forces) = (read_by(&positions.1), read_by(&[momenta.1, work.1].concat()));
        self.has(Quantity::CanonicalMomentum)
            && by_velocities.iter().all(|read| !self.symbols().contains(read) || momenta.0.contains(read))
            && by_forces.iter().all(|read| !momenta.0.contains(read))
    }

    /// Are they operations alone, one by one, of which `emit(taylor)` takes the series? What is called is not known so.
    pub fn has_series(&self) -> bool {
        self.program.calls.is_empty()
    }

    /// The components of some groups, and their rates.
    fn of(&self, quantities: &[Quantity]) -> (Vec<Symbol>, Vec<(Symbol, Value)>) {
        let groups =
            self.groups.iter().flat_map(|(quantity, names)| names.iter().map(move |name| (quantity, name)));
        let rates = groups.zip(&self.program.outputs);
        let chosen = rates.filter(|((quantity, _), _)| quantities.contains(quantity));
        chosen.map(|((_, name), rate)| (name.clone(), rate.clone())).unzip()
    }
}
