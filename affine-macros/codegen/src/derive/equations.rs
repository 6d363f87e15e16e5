//! A first-order system, ready to be written down.

use crate::ir::Program;

/// A first-order system as a program over a plain array.
pub struct Equations {
    /// Groups of the array: name and component symbols.
    pub groups: Vec<(&'static str, Vec<String>)>,
    /// Entries of the affine momentum that are linear in components of the array.
    pub dependent: Program,
    /// Array -> its rate.
    pub program: Program,
}

impl Equations {
    /// Names of the components of the array.
    #[must_use]
    pub fn names(&self) -> Vec<String> {
        self.groups.iter().flat_map(|(_, names)| names.clone()).collect()
    }
}
