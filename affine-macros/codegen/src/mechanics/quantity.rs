//! What the components of a state are.

/// A quantity that stands in a state as a whole. The runtime has the same list: the generator is built before it, and what it
/// emits names each by the same word, so that one that is missing there does not compile.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// `x`
    Position,
    /// `phi`
    Placement,
    /// `Psi = phi/D`
    IsochoricPlacement,
    /// `p`
    LinearMomentum,
    /// `p_hat = phi^T p`
    ComovingLinearMomentum,
    /// `Pi`
    CanonicalMomentum,
    /// `Sigma = phi Pi`
    AffineSpin,
    /// `Sigma_hat = Pi phi`
    ComovingAffineSpin,
    /// `I(O) = x p^T + Sigma`
    TotalAffineMomentum,
    /// `O` in `dPsi/dt = Psi O` or `O Psi`
    IsochoricVelocity,
    /// `1/D`
    InverseDilatation,
    /// `q = ln D`
    MeanLogStretch,
    /// The work of the forces that no potential has, since the start.
    Work,
    /// `q_a` on the axes, stretches' logarithms or angles.
    LogStretches,
    /// `p_a`, conjugate to these.
    LogStretchMomenta,
    /// `Q_a`
    Stretches,
    /// `P_a`, conjugate to these.
    StretchMomenta,
    /// `M_ab = -rho_hat_ab - tau_hat_ab`
    SumCouplings,
    /// `N_ab = rho_hat_ab - tau_hat_ab`
    DifferenceCouplings,
    /// `L` in `phi = L D R^T`
    LeftRotation,
    /// `R` in it
    RightRotation,
}
