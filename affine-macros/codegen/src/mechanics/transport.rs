//! Velocities and momenta of a frame as those of the placement, and back.

use crate::algebra::ring::{Ring, Square, product};

use super::term::Frame;

/// `phi_dot = phi Oh`, `Om phi`, of a velocity of the frame `by` the placement; the other way `by` its inverse.
pub(super) fn velocity<R: Ring>(frame: Frame, o: &Square<R>, by: &Square<R>) -> Square<R> {
    match frame {
        Frame::Body => product(by, o),
        Frame::Space => product(o, by),
        Frame::Flat => o.clone(),
    }
}

/// `Sigma_hat = Pi phi`, `Sigma = phi Pi`, the momentum of the frame from the canonical one `by` the placement, and likewise
/// of forces; the other way `by` its inverse.
pub(super) fn momentum<R: Ring>(frame: Frame, pi: &Square<R>, by: &Square<R>) -> Square<R> {
    match frame {
        Frame::Body => product(pi, by),
        Frame::Space => product(by, pi),
        Frame::Flat => pi.clone(),
    }
}
