//! What the components of a state are.

/// A text that stands in a program, or that was read into it.
pub(crate) type Word = &'static str;

/// A quantity that stands in a state as a whole.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Quantity {
    /// The place of the centre of mass, `x`.
    Position,
    /// The placement `phi`.
    Placement,
    /// The isochoric part of the placement, `Psi = phi/D`.
    IsochoricPlacement,
    /// The linear momentum `p`.
    LinearMomentum,
    /// The co-moving linear momentum `p_hat = phi^T p`.
    ComovingLinearMomentum,
    /// The canonical affine momentum `Pi`.
    CanonicalMomentum,
    /// The affine spin `Sigma = phi Pi`.
    AffineSpin,
    /// The co-moving affine spin `Sigma_hat = Pi phi`.
    ComovingAffineSpin,
    /// The total affine momentum `I(O) = x p^T + Sigma`.
    TotalAffineMomentum,
    /// The isochoric affine velocity `O`, in the frame of the energy.
    IsochoricVelocity,
    /// `1/D`, integrated beside the placement.
    InverseDilatation,
    /// `q = ln D`, likewise.
    MeanLogStretch,
    /// The integral of [`Model::power`](crate::Model::power) since the start, where there are forces that no potential has.
    Work,
    /// The change of a reduced state, in the variational equations.
    TangentVector,
    /// The places `q_a` of a lattice: logarithms of stretches, or angles.
    LogStretches,
    /// Their momenta `p_a`.
    LogStretchMomenta,
    /// The stretches `Q_a` as places of a lattice.
    Stretches,
    /// Their momenta `P_a`.
    StretchMomenta,
    /// The couplings `M_ab = -rho_hat_ab - tau_hat_ab` of a lattice.
    SumCouplings,
    /// The couplings `N_ab = rho_hat_ab - tau_hat_ab` of a lattice.
    DifferenceCouplings,
    /// Momenta and couplings of a lattice together.
    LatticeMomenta,
    /// `L` in `phi = L D R^T`.
    LeftRotation,
    /// `R` in it.
    RightRotation,
    /// Something else, by its name: a state of equations of one's own.
    Other(#[cfg_attr(feature = "serde", serde(deserialize_with = "crate::interned::word"))] Word),
}

impl Quantity {
    /// Its symbol.
    #[must_use]
    pub const fn symbol(self) -> &'static str {
        match self {
            Self::Position => "x",
            Self::Placement => "phi",
            Self::IsochoricPlacement => "Psi",
            Self::LinearMomentum | Self::LogStretchMomenta => "p",
            Self::ComovingLinearMomentum => "p_hat",
            Self::CanonicalMomentum => "Pi",
            Self::AffineSpin => "Sigma",
            Self::ComovingAffineSpin => "Sigma_hat",
            Self::TotalAffineMomentum => "I(O)",
            Self::IsochoricVelocity => "O",
            Self::InverseDilatation => "1/D",
            Self::MeanLogStretch | Self::LogStretches => "q",
            Self::Work => "work",
            Self::TangentVector => "tangent",
            Self::Stretches => "Q",
            Self::StretchMomenta => "P",
            Self::SumCouplings => "M",
            Self::DifferenceCouplings => "N",
            Self::LatticeMomenta => "momenta",
            Self::LeftRotation => "L",
            Self::RightRotation => "R",
            Self::Other(name) => name,
        }
    }

    /// The placement, or its isochoric part: what momenta move, and what keeps its orientation.
    #[doc(hidden)]
    #[must_use]
    pub const fn is_placement(self) -> bool {
        matches!(self, Self::Placement | Self::IsochoricPlacement)
    }
}

/// A run of components of a state vector that form one geometric object.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Group {
    /// What it is.
    pub quantity: Quantity,
    /// Number of components, row-major.
    pub len: usize,
}

impl Group {
    /// So many components of a quantity.
    #[must_use]
    pub const fn new(quantity: Quantity, len: usize) -> Self {
        Self { quantity, len }
    }

    /// The symbol of the quantity: `x`, `phi`, `Sigma_hat`, ...
    #[must_use]
    pub const fn name(&self) -> &'static str {
        self.quantity.symbol()
    }
}
