//! Where a reduction keeps what a trajectory needs: in the state, among the constants, or in closed forms.

use super::components::Components;
use super::dilatation::DilatationalMotion;
use super::model::Model;
use super::symbols::VolumeMeasure;
use crate::mechanics::charts::{Linear, Momentum};
use crate::mechanics::reduction::Commuting;
use crate::symbol::{Quantity, Symbol};

/// What a trajectory of the reduced equations has.
pub struct Trajectory {
    /// A time origin: something moves in closed form.
    pub origin: bool,
    /// Space is turned.
    pub turn: bool,
    /// `x` is state.
    pub placed: bool,
    /// `p` is a constant.
    pub linear: bool,
    /// `p` or `p_hat` is state.
    pub pushed: bool,
    /// It is `p_hat`.
    pub comoving: bool,
    /// `x0` and `p/m` of a free centre of mass.
    pub drift: bool,
    /// The affine momentum.
    pub momentum: AffineMomentum,
    /// The quantity that its entries are components of.
    pub momentum_entries: Quantity,
    /// All of it is a constant.
    pub conserved: bool,
    /// Components of it that are constants while others are state.
    pub fixed: Vec<Symbol>,
    /// Side of the rotation that commutes with the rest of the motion.
    pub rotation: Option<Components>,
    /// The motion of the dilatation, where it is known in closed form.
    pub dilatation: Option<DilatationalMotion>,
    /// Functions of `det phi` that are state.
    pub carried: Vec<VolumeMeasure>,
    /// Number of coefficients of the reduced equations.
    pub coefficients: usize,
}

/// An affine momentum.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AffineMomentum {
    /// The affine spin.
    Spin(Components),
    /// The total one, `I(O) = x p^T + Sigma`.
    Total,
}

impl From<Momentum> for AffineMomentum {
    fn from(momentum: Momentum) -> Self {
        match momentum {
            Momentum::Body => Self::Spin(Components::Comoving),
            Momentum::Space => Self::Spin(Components::Spatial),
            Momentum::Total => Self::Total,
            Momentum::Canonical => Self::Spin(Components::TwoPoint),
        }
    }
}

impl Trajectory {
    /// Those of a model.
    #[must_use]
    pub fn of(model: &Model) -> Self {
        let reduction = &model.dynamics.reduction;
        let Commuting { rotation, drift } = &reduction.commuting;
        let rotation = rotation.as_ref().map(|rotation| rotation.frame.into());
        let drift = drift.is_some();
        let linear = reduction.chart.linear;
        let pushed = linear.is_some_and(|linear| model.dynamics.reduced.has(linear.quantity()));
        Self {
            origin: rotation.is_some() || drift,
            turn: reduction.turn.is_some(),
            placed: linear.is_some(),
            linear: model.translation.is_some() && !pushed,
            pushed,
            comoving: pushed && linear == Some(Linear::Body),
            drift,
            momentum: reduction.chart.momentum.into(),
            momentum_entries: reduction.chart.momentum.quantity(),
            conserved: reduction.conserved.affine,
            fixed: model.dynamics.fixed.clone(),
            rotation,
            dilatation: reduction.dilatation.as_ref().map(|separation| (&separation.slope).into()),
            carried: reduction.carried.iter().copied().map(VolumeMeasure::from).collect(),
            coefficients: model.dynamics.trajectory.outputs.len(),
        }
    }
}
