//! The functions of placement and position that potentials are written in.

use crate::algebra::ring::{pairs, upper};
use crate::algebra::{Arena, Expr, Rational};
use crate::symbol::{Quantity, Symbol};

/// Functions of the placement and the position that potentials are written in, indices from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Base {
    /// `q = ln(det phi)/n`
    MeanLogStretch,
    /// `q_a = ln Q_a`, `Q_a` a singular value of `phi`; only together in symmetric functions
    LogStretch(usize),
    /// `tr G^k = tr Ct^k`, `k` from 1 to 3
    Trace(usize),
    /// `G_AB`, `A <= B`
    Green(usize, usize),
    /// `Ct_ij`, `i <= j`
    Finger(usize, usize),
    /// `phi_iA`
    Placement(usize, usize),
    /// `x_i`
    Position(usize),
}

/// A higher multiple of a logarithm stays in its function: a product of so many factors takes longer to write down than an
/// exponential to compute, and leaves the range of numbers sooner.
pub(super) const HIGHEST_MULTIPLE: u32 = 32;

/// The symbols `q_1, ..., q_n`.
pub(super) fn log_stretches(arena: &mut Arena, n: usize) -> Vec<Expr> {
    arena.components(Quantity::LogStretches, n)
}

impl Base {
    /// The traces of `G`, of its square and of its cube.
    pub(super) const TRACES: [Self; 3] = [Self::Trace(1), Self::Trace(2), Self::Trace(3)];

    /// All base functions in dimension `n`.
    pub fn all(n: usize) -> Vec<Self> {
        let mut list = vec![Self::MeanLogStretch];
        list.extend(Self::TRACES);
        list.extend((0..n).map(Self::LogStretch));
        list.extend(upper(n).map(|(a, b)| Self::Green(a, b)));
        list.extend(upper(n).map(|(i, j)| Self::Finger(i, j)));
        list.extend(pairs(n).map(|(i, a)| Self::Placement(i, a)));
        list.extend((0..n).map(Self::Position));
        list
    }

    /// Its symbol in expressions.
    pub fn symbol(self, arena: &mut Arena) -> Expr {
        arena.symbol(self.quantity())
    }

    /// What that symbol stands for.
    pub(super) fn quantity(self) -> Symbol {
        match self {
            Self::MeanLogStretch => Quantity::MeanLogStretch.into(),
            Self::LogStretch(a) => Quantity::LogStretches.at([a + 1]),
            Self::Trace(k) => Quantity::Trace.at([k]),
            Self::Green(a, b) => Quantity::Green.at([a.min(b) + 1, a.max(b) + 1]),
            Self::Finger(i, j) => Quantity::Finger.at([i.min(j) + 1, i.max(j) + 1]),
            Self::Placement(i, a) => Quantity::Placement.at([i + 1, a + 1]),
            Self::Position(i) => Quantity::Position.at([i + 1]),
        }
    }

    /// The power of `D` in it.
    pub(super) fn degree(self) -> usize {
        match self {
            Self::MeanLogStretch | Self::LogStretch(_) | Self::Position(_) => 0,
            Self::Placement(..) => 1,
            Self::Green(..) | Self::Finger(..) => 2,
            Self::Trace(k) => 2 * k,
        }
    }

    /// The symbol of the same function of `Psi`, `phi = D Psi`.
    pub(super) fn unit(self, arena: &mut Arena) -> Expr {
        let unit = match self {
            Self::Placement(..) => Quantity::UnitPlacement,
            Self::Green(..) => Quantity::UnitGreen,
            Self::Finger(..) => Quantity::UnitFinger,
            Self::Trace(_) => Quantity::UnitTrace,
            Self::MeanLogStretch | Self::LogStretch(_) | Self::Position(_) => return self.symbol(arena),
        };
        arena.symbol(self.quantity().of(unit))
    }

    /// The number that its slope is multiplied by in a force, taken into the slope.
    pub(super) fn weight(self, n: usize) -> Rational {
        match self {
            Self::MeanLogStretch => -&Rational::one_over(n),
            Self::Trace(k) => -&Rational::whole(2 * k),
            _ => Rational::MINUS_ONE,
        }
    }

    /// The symbol of the weighted slope.
    pub(super) fn slope(self) -> Symbol {
        self.quantity().of(match self {
            Self::MeanLogStretch => Quantity::Pressure,
            Self::LogStretch(_) => Quantity::Tension,
            Self::Trace(_) => Quantity::Stress,
            Self::Green(..) => Quantity::SlopeByGreen,
            Self::Finger(..) => Quantity::SlopeByFinger,
            Self::Placement(..) => Quantity::SlopeByPlacement,
            Self::Position(_) => Quantity::SlopeByPosition,
        })
    }
}
