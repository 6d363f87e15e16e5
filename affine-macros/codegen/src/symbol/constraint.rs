//! The groups that a motion may be confined to.

/// The subgroup `G` of GL+(n) that the motion is confined to, and its Lie algebra `g`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Constraint {
    /// SL(n): `det phi = 1`; `g` is traceless.
    Isochoric,
    /// SO(n): `phi^T phi = 1`; `g` is skew.
    Rigid,
    /// R+ SO(n): `phi^T phi` is a multiple of the identity; `g` is skew plus multiples of the identity.
    Conformal,
}
