//! What a reduction takes out of the state.

use super::context::Context;
use crate::mechanics::carried::Carried;
use crate::mechanics::charts::Linear;
use crate::mechanics::kinetic::Frame;
use crate::mechanics::reduce::{Commuting, Layout};

/// What one trajectory needs besides its reduced state.
pub(super) struct Eliminated {
    /// A time origin: something moves in closed form.
    pub(super) origin: bool,
    /// Space is turned.
    pub(super) turn: bool,
    /// `p` is a constant.
    pub(super) linear: bool,
    /// `p` or `p_hat` is state.
    pub(super) pushed: bool,
    /// It is `p_hat`.
    pub(super) comoving: bool,
    /// `x0` and `p/m` of a free centre of mass.
    pub(super) drift: bool,
    /// The affine momentum is a constant.
    pub(super) momentum: bool,
    /// Components of the affine momentum that are constants while others are state.
    pub(super) fixed: Vec<String>,
    /// Generator of the rotation that commutes.
    pub(super) whirl: Option<Frame>,
    /// The dilatation moves in closed form.
    pub(super) dilatation: bool,
    /// `1/D` is state.
    pub(super) carried: Vec<Carried>,
    /// Coefficients of the reduced equations.
    pub(super) coefficients: usize,
}

impl Eliminated {
    pub(super) fn of(context: &Context) -> Self {
        let reduction = &context.model.reduction;
        let whirl = reduction.commuting.iter().find_map(|piece| match piece {
            Commuting::Vorticity(_) => Some(Frame::Body),
            Commuting::Spin(_) => Some(Frame::Space),
            Commuting::Drift(_) => None,
        });
        let has = |group: &str| context.model.reduced.groups.iter().any(|(name, _)| *name == group);
        let linear = reduction.chart.linear;
        let pushed = linear.is_some_and(|linear| has(linear.name()));
        let comoving = pushed && linear == Some(Linear::Body);
        let drift = reduction.commuting.iter().any(|piece| matches!(piece, Commuting::Drift(_)));
        Self {
            origin: whirl.is_some() || drift,
            turn: reduction.turned,
            linear: context.model.translation.is_some() && !pushed,
            pushed,
            comoving,
            drift,
            momentum: reduction.layout == Layout::Constant,
            fixed: context.model.fixed.clone(),
            whirl,
            dilatation: reduction.separation.is_some(),
            carried: reduction.carried.clone(),
            coefficients: context.model.trajectory.outputs.len(),
        }
    }
}
