//! The groups to which motions are confined.

/// The group to which a motion is confined.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Constraint {
    /// SL(n): `det phi = 1`.
    Isochoric,
    /// SO(n): `phi^T phi = 1`.
    Rigid,
    /// R+ SO(n): `phi^T phi` is a multiple of 1.
    Conformal,
}

impl Constraint {
    /// What placements, velocities and momenta have to satisfy.
    pub(crate) fn asks(self) -> &'static str {
        match self {
            Constraint::Isochoric => {
                "det phi = 1, and the affine velocity and its momentum are traceless; divide phi by the n-th root of its \
                 determinant, and take the trace out of the others"
            }
            Constraint::Rigid => {
                "phi^T phi = 1, and the affine velocity and its momentum are skew; start from a rotation"
            }
            Constraint::Conformal => {
                "phi^T phi is a multiple of the identity, and the affine velocity and its momentum are skew up to \
                 another; start from a multiple of a rotation"
            }
        }
    }
}

impl core::fmt::Display for Constraint {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            Constraint::Isochoric => "isochoric",
            Constraint::Rigid => "rigid",
            Constraint::Conformal => "conformal",
        })
    }
}
