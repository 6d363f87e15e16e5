//! Charts of phase space: which momenta stand beside `x` and `phi`.

use crate::algebra::ring::{Square, pairs};
use crate::algebra::substitute::listed;
use crate::algebra::{Arena, Expr, Matrix, Polynomial};

use super::constraint::Constraint;
use super::term::Frame;
use crate::symbol::Quantity;

/// The affine momentum of a chart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Momentum {
    /// Co-moving affine spin `Sigma_hat = Pi phi`.
    Body,
    /// Spatial affine spin `Sigma = phi Pi`.
    Space,
    /// Total affine momentum `I(O) = x p^T + Sigma`.
    Total,
    /// Canonical momentum `Pi`.
    Canonical,
}

/// The linear momentum of a chart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Linear {
    /// `p`.
    Space,
    /// `p_hat = phi^T p`.
    Body,
}

impl Linear {
    /// What it is in a state.
    pub fn quantity(self) -> Quantity {
        match self {
            Self::Space => Quantity::LinearMomentum,
            Self::Body => Quantity::ComovingLinearMomentum,
        }
    }
}

/// Coordinates of phase space and their symbols.
#[derive(Clone, Debug)]
#[must_use]
pub struct Chart {
    /// Dimension of space.
    pub dim: usize,
    /// The group that the motion is confined to, for which the affine momentum is projected.
    pub confined: Option<Constraint>,
    /// Which affine momentum.
    pub momentum: Momentum,
    /// Which linear momentum; `None` without translation.
    pub linear: Option<Linear>,
    /// `x_i`; empty without translation.
    pub x: Vec<Expr>,
    /// `phi_iA`.
    pub phi: Matrix,
    /// `p_i` or `p_hat_A`; empty without translation.
    pub p: Vec<Expr>,
    /// The affine momentum.
    pub m: Matrix,
}

/// One coordinate of a chart, indices from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Coordinate {
    /// `x_i`.
    X(usize),
    /// `phi_iA`.
    Phi(usize, usize),
    /// `p_i` or `p_hat_A`.
    P(usize),
    /// Entry of the affine momentum.
    M(usize, usize),
    /// A function of the others that is integrated beside them.
    Carried(Expr),
}

impl Coordinate {
    /// Is it a component of a momentum?
    pub fn is_momentum(self) -> bool {
        matches!(self, Self::P(_) | Self::M(..))
    }
}

impl Momentum {
    /// The affine spin of a frame.
    pub fn of(frame: Frame) -> Self {
        match frame {
            Frame::Body => Momentum::Body,
            Frame::Space => Momentum::Space,
            Frame::Flat => Momentum::Canonical,
        }
    }

    /// What it is in a state.
    pub fn quantity(self) -> Quantity {
        match self {
            Momentum::Body => Quantity::ComovingAffineSpin,
            Momentum::Space => Quantity::AffineSpin,
            Momentum::Total => Quantity::TotalAffineMomentum,
            Momentum::Canonical => Quantity::CanonicalMomentum,
        }
    }

    /// The paper's symbol.
    pub fn symbol(self) -> &'static str {
        match self {
            Momentum::Body => "Sigma_hat",
            Momentum::Space => "Sigma",
            Momentum::Total => "I(O)",
            Momentum::Canonical => "Pi",
        }
    }

    /// The conjugate velocity `(dH/dM)^T`.
    pub fn velocity(self) -> Quantity {
        match self {
            Momentum::Body => Quantity::ComovingAffineVelocity,
            Momentum::Space | Momentum::Total => Quantity::AffineVelocity,
            Momentum::Canonical => Quantity::FlatVelocity,
        }
    }
}

impl Chart {
    /// The chart with the given momenta.
    pub fn new(arena: &mut Arena, dim: usize, momentum: Momentum, linear: Option<Linear>) -> Self {
        let (x, p) = match linear {
            None => (Vec::new(), Vec::new()),
            Some(linear) => {
                (arena.components(Quantity::Position, dim), arena.components(linear.quantity(), dim))
            }
        };
        let phi = Matrix::symbols(arena, Quantity::Placement, dim);
        let m = Matrix::symbols(arena, momentum.quantity(), dim);
        Self { dim, confined: None, momentum, linear, x, phi, p, m }
    }

    /// The same chart for a motion confined to a group: its affine momentum is projected.
    pub fn under(self, confined: Option<Constraint>) -> Self {
        Self { confined, ..self }
    }

    /// The symbols of its coordinates.
    pub fn symbols(&self) -> Vec<Expr> {
        self.coordinates().into_iter().map(|z| self.symbol(z)).collect()
    }

    /// The frame whose affine momentum it has.
    pub fn frame(&self) -> Frame {
        match self.momentum {
            Momentum::Body => Frame::Body,
            Momentum::Space | Momentum::Total => Frame::Space,
            Momentum::Canonical => Frame::Flat,
        }
    }

    /// Symbols of the affine velocity `(dH/dM)^T`.
    pub fn velocity(&self, arena: &mut Arena) -> Matrix {
        Matrix::symbols(arena, self.momentum.velocity(), self.dim)
    }

    /// `phi` in its entries.
    pub fn placement(&self) -> Square<Polynomial> {
        self.phi.atoms()
    }

    /// Entries of the affine momentum that are linear in others, by those.
    pub fn dependent(&self) -> Vec<(Expr, Polynomial)> {
        self.confined.map_or_else(Vec::new, |group| group.dependent(&self.m))
    }

    /// A polynomial in the entries of the affine momentum that determine the others.
    pub fn reduced(&self, polynomial: &Polynomial) -> Polynomial {
        polynomial.substitute(&listed(&self.dependent()))
    }

    /// The coordinates that determine the others, group after group.
    pub fn independent(&self) -> Vec<Coordinate> {
        let dependent = self.dependent();
        let mut all = self.coordinates();
        all.retain(|z| listed(&dependent)(self.symbol(*z)).is_none());
        all
    }

    /// The entries of the affine momentum among them.
    pub fn independent_momenta(&self) -> Vec<Coordinate> {
        let mut momenta = self.independent();
        momenta.retain(|z| matches!(z, Coordinate::M(..)));
        momenta
    }

    /// All coordinates, group after group.
    pub fn coordinates(&self) -> Vec<Coordinate> {
        let n = self.dim;
        let pairs = || pairs(n);
        let mut all: Vec<Coordinate> = (0..self.x.len()).map(Coordinate::X).collect();
        all.extend(pairs().map(|(i, a)| Coordinate::Phi(i, a)));
        all.extend((0..self.p.len()).map(Coordinate::P));
        all.extend(pairs().map(|(a, b)| Coordinate::M(a, b)));
        all
    }

    /// Symbol of a coordinate.
    pub fn symbol(&self, coordinate: Coordinate) -> Expr {
        match coordinate {
            Coordinate::X(i) => self.x[i],
            Coordinate::Phi(i, a) => self.phi.0[i][a],
            Coordinate::P(i) => self.p[i],
            Coordinate::M(a, b) => self.m.0[a][b],
            Coordinate::Carried(symbol) => symbol,
        }
    }
}
