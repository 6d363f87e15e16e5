//! The elementary functions of one variable.

/// An elementary function.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Function {
    /// Exponential.
    Exp,
    /// `exp(x) - 1`; for right-hand sides that know where it matters, not for specifications.
    ExpM1,
    /// Natural logarithm.
    Ln,
    /// Square root.
    Sqrt,
    /// Cube root.
    Cbrt,
    /// Reciprocal of the cube root; for programs.
    InverseCbrt,
    /// Absolute value.
    Abs,
    /// 1 with the sign of the argument, the slope of the absolute value; for programs.
    Sign,
    /// Sine.
    Sin,
    /// Cosine.
    Cos,
    /// Tangent.
    Tan,
    /// Hyperbolic sine.
    Sinh,
    /// Hyperbolic cosine.
    Cosh,
    /// Hyperbolic tangent.
    Tanh,
    /// Inverse hyperbolic sine; for right-hand sides that know where it matters, not for specifications.
    Asinh,
}

impl Function {
    /// `f(-x) = f(x)`?
    pub fn is_even(self) -> bool {
        matches!(self, Self::Cos | Self::Cosh | Self::Abs)
    }

    /// `f(-x) = -f(x)`?
    pub fn is_odd(self) -> bool {
        let circular = matches!(self, Self::Sin | Self::Tan | Self::Sinh | Self::Tanh | Self::Asinh);
        circular || matches!(self, Self::Sign | Self::Cbrt | Self::InverseCbrt)
    }

    /// Its name, in specifications as in Rust.
    pub fn name(self) -> &'static str {
        match self {
            Self::Exp => "exp",
            Self::ExpM1 => "exp_m1",
            Self::Ln => "ln",
            Self::Sqrt => "sqrt",
            Self::Cbrt => "cbrt",
            Self::InverseCbrt => "inverse_cbrt",
            Self::Abs => "abs",
            Self::Sign => "signum",
            Self::Sin => "sin",
            Self::Cos => "cos",
            Self::Tan => "tan",
            Self::Sinh => "sinh",
            Self::Cosh => "cosh",
            Self::Tanh => "tanh",
            Self::Asinh => "asinh",
        }
    }
}
