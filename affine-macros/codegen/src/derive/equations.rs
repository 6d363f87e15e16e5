//! A first-order system, ready to be written down.

use crate::ir::Program;
use crate::mechanics::quantity::Quantity;

/// A first-order system as a program over a plain array.
pub struct Equations {
    /// Groups of the array, with the symbols of their components.
    pub groups: Vec<(Quantity, Vec<String>)>,
    /// Entries of the affine momentum that are linear in components of the array.
    pub dependent: Program,
    /// Array -> its rate.
    pub program: Program,
}

impl Equations {
    /// Is a quantity a group of the array?
    #[must_use]
    pub fn has(&self, quantity: Quantity) -> bool {
        self.groups.iter().any(|(group, _)| *group == quantity)
    }

    /// The components of the groups, without what these are.
    #[must_use]
    pub fn components(&self) -> Vec<Vec<String>> {
        self.groups.iter().map(|(_, names)| names.clone()).collect()
    }

    /// Names of the components of the array.
    #[must_use]
    pub fn names(&self) -> Vec<String> {
        self.groups.iter().flat_map(|(_, names)| names.clone()).collect()
    }
}
