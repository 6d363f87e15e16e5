//! Symbols of programs that stand for functions of time and placement.

use crate::ir::Program;
use crate::symbol::Quantity;

/// Does a program read the time?
pub fn reads_time(program: &Program) -> bool {
    program.symbols().any(|symbol| symbol.quantity() == Some(Quantity::Time))
}

/// A function of `det phi` that programs read by a symbol of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VolumeMeasure {
    /// `q = ln(det phi)/n`.
    MeanLogStretch,
    /// `D = exp(q)`.
    Dilatation,
}

impl VolumeMeasure {
    /// The quantity that its symbol stands for.
    pub fn quantity(self) -> Quantity {
        match self {
            Self::MeanLogStretch => Quantity::MeanLogStretch,
            Self::Dilatation => Quantity::Dilatation,
        }
    }
}
