//! The functions of placement and position that potentials are written in.

use crate::algebra::{Arena, Expr, Rational};

use super::tensors::Along;

/// Functions of the placement and the position that potentials are written in, indices from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Base {
    /// `q = ln(det phi)/n`
    MeanLogStretch,
    /// `q_a = ln Q_a`, `Q_a` a singular value of `phi`; only together in symmetric functions
    LogStretch(usize),
    /// `tr G = tr Ct`
    Trace,
    /// `tr G^2 = tr Ct^2`
    TraceOfSquare,
    /// `tr G^3 = tr Ct^3`
    TraceOfCube,
    /// `G_AB`, `A <= B`
    Green(usize, usize),
    /// `Ct_ij`, `i <= j`
    Finger(usize, usize),
    /// `phi_iA`
    Placement(usize, usize),
    /// `x_i`
    Position(usize),
}

impl Base {
    /// All base functions in dimension `n`.
    pub(super) fn all(n: usize) -> Vec<Self> {
        let pairs = || (0..n).flat_map(move |a| (0..n).map(move |b| (a, b)));
        let upper = || pairs().filter(|(a, b)| a <= b);
        let mut list = vec![Self::MeanLogStretch, Self::Trace, Self::TraceOfSquare, Self::TraceOfCube];
        list.extend((0..n).map(Self::LogStretch));
        list.extend(upper().map(|(a, b)| Self::Green(a, b)));
        list.extend(upper().map(|(i, j)| Self::Finger(i, j)));
        list.extend(pairs().map(|(i, a)| Self::Placement(i, a)));
        list.extend((0..n).map(Self::Position));
        list
    }

    /// Its symbol in expressions.
    pub fn symbol(self, arena: &mut Arena) -> Expr {
        arena.symbol(&self.name())
    }

    /// The name of that symbol.
    pub(super) fn name(self) -> String {
        match self {
            Self::MeanLogStretch => "q".to_owned(),
            Self::LogStretch(a) => format!("q_{}", a + 1),
            Self::Trace => "trace_1".to_owned(),
            Self::TraceOfSquare => "trace_2".to_owned(),
            Self::TraceOfCube => "trace_3".to_owned(),
            Self::Green(a, b) => format!("green_{}{}", a.min(b) + 1, a.max(b) + 1),
            Self::Finger(i, j) => format!("finger_{}{}", i.min(j) + 1, i.max(j) + 1),
            Self::Placement(i, a) => format!("phi_{}{}", i + 1, a + 1),
            Self::Position(i) => format!("x_{}", i + 1),
        }
    }

    /// The number that its slope is multiplied by in a force, taken into the slope.
    pub(super) fn weight(self, n: usize) -> Rational {
        let number = match self {
            Self::MeanLogStretch => i64::try_from(n).ok().and_then(|n| Rational::ratio(-1, n)),
            Self::Trace => Some(Rational::from(-2)),
            Self::TraceOfSquare => Some(Rational::from(-4)),
            Self::TraceOfCube => Some(Rational::from(-6)),
            _ => Some(Rational::MINUS_ONE),
        };
        number.unwrap_or(Rational::MINUS_ONE)
    }

    /// Does its derivative along a direction lose one power of `D`, as along the placement itself?
    pub(super) fn is_moved(self, along: Along) -> bool {
        along == Along::Placement && self.degree() != 0
    }

    /// Name of the weighted slope.
    pub(super) fn slope_name(self) -> String {
        match self {
            Self::MeanLogStretch => "pressure".to_owned(),
            Self::LogStretch(a) => format!("tension_{}", a + 1),
            Self::Trace => "stress_1".to_owned(),
            Self::TraceOfSquare => "stress_2".to_owned(),
            Self::TraceOfCube => "stress_3".to_owned(),
            Self::Green(a, b) => format!("slope_green_{}{}", a + 1, b + 1),
            Self::Finger(i, j) => format!("slope_finger_{}{}", i + 1, j + 1),
            Self::Placement(i, a) => format!("slope_phi_{}{}", i + 1, a + 1),
            Self::Position(i) => format!("slope_x_{}", i + 1),
        }
    }
}
