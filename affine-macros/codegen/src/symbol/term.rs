//! The quadratic forms of kinetic energies, and the frames that make their coefficients constant.

use super::Quantity;

/// The quadratic forms that a specification can name; `Oh = phi^-1 phi_dot`, `Om = phi_dot phi^-1`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TermKind {
    /// `A/2 tr O^2`, the same in both frames.
    Casimir2,
    /// `B/2 (tr O)^2`, the same in both frames.
    Casimir1Squared,
    /// `1/2 tr(Oh J Oh^T)`, (4.17); `J = I 1` is (4.14).
    BodyInertia,
    /// `1/2 tr(Om J Om^T)`, (4.17); `J = I 1` is (4.15).
    SpaceInertia,
    /// `1/2 K[nA+B][nC+D] Oh[A][B] Oh[C][D]`, (4.1).
    BodyTensor,
    /// `1/2 K[nA+B][nC+D] Om[A][B] Om[C][D]`, (4.2).
    SpaceTensor,
    /// `1/2 K[nA+B][nC+D] phi_dot[A][B] phi_dot[C][D]`, the flat form of section 4.
    FlatTensor,
    /// `1/2 tr(phi_dot J phi_dot^T)`, (2.1).
    Dalembert,
    /// `m/2 |phi^-1 x_dot|^2`, (4.4).
    BodyTranslation,
    /// `m/2 |x_dot|^2`, (4.5).
    SpaceTranslation,
}

/// The frame in which an energy has constant coefficients.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Frame {
    /// Co-moving: `Oh`, `Sigma_hat`, `p_hat`.
    Body,
    /// Spatial: `Om`, `Sigma`, `p`.
    Space,
    /// Neither: `phi_dot`, `Pi`.
    Flat,
}

impl Frame {
    /// The affine velocity of the frame.
    #[must_use]
    pub fn velocity(self) -> Quantity {
        match self {
            Frame::Body => Quantity::ComovingAffineVelocity,
            Frame::Space => Quantity::AffineVelocity,
            Frame::Flat => Quantity::PlacementVelocity,
        }
    }

    /// The affine spin of the frame.
    #[must_use]
    pub fn momentum(self) -> Quantity {
        match self {
            Frame::Body => Quantity::ComovingAffineSpin,
            Frame::Space => Quantity::AffineSpin,
            Frame::Flat => Quantity::CanonicalMomentum,
        }
    }
}

impl TermKind {
    /// The frame that makes the term's coefficients constant; `None` where any of body and space does.
    #[must_use]
    pub fn internal_frame(self) -> Option<Frame> {
        match self {
            TermKind::BodyInertia | TermKind::BodyTensor => Some(Frame::Body),
            TermKind::SpaceInertia | TermKind::SpaceTensor => Some(Frame::Space),
            TermKind::Dalembert | TermKind::FlatTensor => Some(Frame::Flat),
            _ => None,
        }
    }

    /// `1/2 K[(A,B),(C,D)] O[A,B] O[C,D]`, a form on pairs of indices?
    #[must_use]
    pub fn is_tensor(self) -> bool {
        matches!(self, TermKind::BodyTensor | TermKind::SpaceTensor | TermKind::FlatTensor)
    }

    /// The frame of a translational term.
    #[must_use]
    pub fn translation_frame(self) -> Option<Frame> {
        match self {
            TermKind::BodyTranslation => Some(Frame::Body),
            TermKind::SpaceTranslation => Some(Frame::Space),
            _ => None,
        }
    }

    /// A kinetic energy of the centre of mass, in x_dot?
    #[must_use]
    pub fn is_translation(self) -> bool {
        self.translation_frame().is_some()
    }

    /// `1/2 tr(O J O^T)` over `Oh`, `Om` or `phi_dot`, with `J` an n x n inertia or a multiple of the identity?
    #[must_use]
    pub fn is_inertia(self) -> bool {
        self.internal_frame().is_some() && !self.is_tensor()
    }
}
