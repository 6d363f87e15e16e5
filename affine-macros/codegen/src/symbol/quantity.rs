//! Every quantity that has a symbol of its own, with the stem of its name. What those are that formulas write, in words, stands in
//! `mechanics/notation/symbols.rs`.

macro_rules! quantities {
    ($($quantity:ident $stem:literal)*) => {
        /// A quantity, whose components are symbols. The runtime lists those that a state has as a whole: the generator is built
        /// before it, and what it emits names each by the same word, so that one that is missing there does not compile.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum Quantity {
            $(#[doc = concat!("`", $stem, "`")] $quantity,)*
        }

        impl Quantity {
            /// What the names of its symbols begin with.
            pub fn stem(self) -> &'static str {
                match self {
                    $(Self::$quantity => $stem,)*
                }
            }
        }
    };
}

quantities! {
    Time "t" TimeOfFlow "h" Work "work" Coefficient "c" Constant "k"
    Position "x" CentreVelocity "x_dot" ComovingCentreVelocity "v_hat"
    Placement "phi" PlacementVelocity "phi_dot" FlatVelocity "velocity"
    InversePlacement "phi_inverse" AffineVelocity "omega" ComovingAffineVelocity "omega_hat"
    LinearMomentum "p" ComovingLinearMomentum "p_hat" CanonicalMomentum "pi"
    AffineSpin "sigma" ComovingAffineSpin "sigma_hat" TotalAffineMomentum "total"
    Vorticity "vorticity"
    // Mass matrices, and the basis of velocities that a constraint leaves.
    InverseBlock "inverse" InverseColumn "inverse" SpaceInertia "space_inertia" Cauchy "cauchy"
    Speed "speed" TurnedVelocity "turned"
    // Deformation.
    Green "green" Finger "finger" Trace "trace" GreenSquare "green_square" FingerSquare "finger_square"
    SecondInvariant "second_invariant" InverseTensor "inverse_tensor" Cofactor "cofactor"
    Determinant "det" InverseDeterminant "inverse_det" InverseDeterminantSquared "inverse_det_squared"
    Dilatation "dilatation" InverseDilatation "inverse_dilatation" MeanLogStretch "q"
    Expansion "expansion" DilatationSquared "square" InverseDilatationSquared "inverse_square"
    LogStretches "q" Difference "d" LogStretchMomenta "p" Stretches "stretch" StretchMomenta "p"
    InverseStretch "inverse_stretch" StretchSquared "square" Axis "axis" StretchedAxis "stretched"
    // Of `Psi = phi/D`.
    IsochoricPlacement "psi" IsochoricVelocity "isochoric" Shear "shear" Turn "turn"
    UnitPlacement "unit_phi" UnitGreen "unit_green" UnitFinger "unit_finger" UnitTrace "unit_trace"
    UnitGreenSquare "unit_green_square" UnitFingerSquare "unit_finger_square"
    IsochoricExcess "isochoric_excess" MeanSquare "mean_square"
    IsochoricDeviator "isochoric_deviator" IsochoricDeviatorSquared "isochoric_deviator_squared"
    // Counted from the undeformed state.
    Excess "excess" ExcessDeterminant "excess_det" ExcessDilatation "excess_dilatation"
    Strain "strain" StrainSquare "strain_square" StrainMinors "strain_minors" AxialStrain "strain_on_axis"
    SpatialAxialStrain "spatial_strain_on_axis" InverseStrain "inverse_strain"
    CofactorDifference "cofactor_difference" CofactorExcess "cofactor_excess"
    Deviator "deviator" AxialDeviator "deviator_on_axis" DeviatorSquared "deviator_squared" MeanSquareStretch "mean_square_stretch"
    PlacementSum "phi_sum" PlacementDifference "phi_difference" SquareDifference "square_difference"
    BesideGreen "beside_green" BesideFinger "beside_finger" BesideDeterminant "beside_det"
    LessOne "less" MoreOne "more"
    // Potentials.
    PolynomialTrace "polynomial_trace" Raised "raised" Pressure "pressure" Tension "tension" Stress "stress" MeanStress "mean_stress" Piola "piola"
    Swelling "swelling" Offset "offset" SlopeByGreen "slope_green" SlopeByFinger "slope_finger"
    SlopeByPlacement "slope_phi" SlopeByPosition "slope_x" SlopeByPulledBack "slope_pulled_back"
    PulledBack "pulled_back" PushedForward "pushed_forward" PulledBackSquare "pulled_back_square"
    Weighted "weighted"
    // Forces; the first index of a field's is its place among the fields that compute something.
    Drag "drag" ComovingDrag "drag_hat" FlatDrag "drag_flat" CentreDrag "drag_centre" Push "push"
    FieldForce "force" FieldPush "push" FieldPull "pull" FieldSlope "slope" FieldPotential "potential"
    // Balance laws.
    Load "load" KinematicalSpin "kinematical_spin" Moment "moment" ComovingMomentum "momentum"
    // Two-polar decomposition.
    SumCouplings "m" DifferenceCouplings "n" LeftRotation "left" RightRotation "right"
    LeftAngle "left_angle" RightAngle "right_angle" LeftAngular "chi" RightAngular "theta"
    Gap "gap" Decay "decay" Even "even" Repulsion "repulsion" Attraction "attraction" Coth "coth"
    Tanh "tanh" Reciprocal "recip" GapReciprocal "recip_gap" EvenReciprocal "recip_even"
    Ratio "ratio" RatioU "u" RatioW "w" RatioSquare "square" Twice "twice" SpaceRatio "space"
    BodyRatio "body"
    // Splittings.
    BlockValue "square" BlockAxis "axis" FlowRate "rate" Growth "growth" FlowDecay "decay" Sine "sine"
    Versine "versine" Faded "faded"
    // Results of programs.
    Energy "energy" Power "power" Mass "mass" InverseMass "inverse_mass" Acceleration "acceleration"
    InverseAlpha "inverse_alpha" InverseBeta "inverse_beta" InverseMu "inverse_mu" Casimir3 "casimir3"
    InverseDilatationalMass "inverse_dilatational_mass" Stiffness "stiffness" Scale "scale"
    MatrixEntry "entry" Generator "generator" Angular "angular" Guard "guard" Value "value"
    Spin "spin" Inertia "inertia" ComovingSpin "spin_hat" ComovingInertia "inertia_hat"
    ComovingMoment "moment_hat" MomentumOfCentre "momentum" ForceOnCentre "force"
    ComovingMomentumOfCentre "momentum_hat" ComovingForceOnCentre "force_hat"
    // Sums and products that are computed once.
    SharedSum "sum" SharedProduct "product" Scaled "scaled"
}

impl Quantity {
    /// How many of the first indices are numbers of something, apart from the others in a name.
    pub(super) fn numbers(self) -> usize {
        match self {
            Self::InverseBlock | Self::BlockAxis => 2,
            Self::InverseColumn
            | Self::BlockValue
            | Self::MatrixEntry
            | Self::TurnedVelocity
            | Self::FieldForce
            | Self::FieldPush
            | Self::FieldPull
            | Self::FieldSlope => 1,
            _ => 0,
        }
    }

    /// Is it a tensor of the placement, or a trace of one?
    pub fn is_tensor(self) -> bool {
        use Quantity::{
            Finger, FingerSquare, Green, GreenSquare, Placement, PlacementDifference, PlacementSum, Trace,
        };
        let tensors =
            [Trace, Green, GreenSquare, Finger, FingerSquare, Placement, PlacementSum, PlacementDifference];
        tensors.contains(&self)
    }

    /// The quantity that this is a power of, with the same indices, and the exponent.
    pub fn power(self) -> Option<(Self, i32)> {
        match self {
            Self::FlatVelocity => Some((Self::PlacementVelocity, 1)),
            Self::UnitPlacement => Some((Self::IsochoricPlacement, 1)),
            Self::InverseDilatation => Some((Self::Dilatation, -1)),
            Self::DilatationSquared => Some((Self::Dilatation, 2)),
            Self::InverseDilatationSquared => Some((Self::Dilatation, -2)),
            Self::InverseDeterminant => Some((Self::Determinant, -1)),
            Self::InverseStretch => Some((Self::Stretches, -1)),
            _ => None,
        }
    }
}
