//! The motion of the dilatation by itself.

use crate::mechanics::separation::Slope;

/// A closed form of `q'' = -U_dil'(q)/m`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DilatationalMotion {
    /// Without a force: `q` is linear in time.
    Free,
    /// Under a force that is linear in `q`.
    Harmonic,
    /// Under a force that is a hyperbolic sine of `q`.
    Hyperbolic,
}

impl From<&Slope> for DilatationalMotion {
    fn from(slope: &Slope) -> Self {
        match slope {
            Slope::Zero => Self::Free,
            Slope::Linear(_) => Self::Harmonic,
            Slope::Hyperbolic { .. } => Self::Hyperbolic,
        }
    }
}
