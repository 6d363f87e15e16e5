//! Co-moving, spatial and two-point components.

use crate::mechanics::term::Frame;

/// The components that a velocity or a momentum is given by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Components {
    /// Those along the body: `Oh`, `Sigma_hat`, `p_hat`.
    Comoving,
    /// Those along space: `Om`, `Sigma`, `p`.
    Spatial,
    /// Those of a two-point tensor: `phi_dot`, `Pi`.
    TwoPoint,
}

impl From<Frame> for Components {
    fn from(frame: Frame) -> Self {
        match frame {
            Frame::Body => Self::Comoving,
            Frame::Space => Self::Spatial,
            Frame::Flat => Self::TwoPoint,
        }
    }
}
